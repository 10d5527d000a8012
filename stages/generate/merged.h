#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stages/generate/body.h"
#include "stages/generate/params.h"

namespace varimap::shapes {

/// Pairs whose target has grown together with itself: "handle", a ball onto one with a handle, larger by
/// `variation` (Fig. 17), and "contact", a person onto itself in a pose in which an arm has merged with the
/// chest (Fig. 16).
const std::vector<std::string>& merged_names();

/// Source and target, with the same limbs in the same order; none where there is no such pair.
std::optional<std::pair<Body, Body>> merged_pair(const std::string& name, const GenerateParams& params);

}  // namespace varimap::shapes
