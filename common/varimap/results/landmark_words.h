#pragma once

#include <string>
#include <utility>
#include <vector>

namespace varimap {

// How messages name landmarks.

/// "2", "2 and 3", "2, 3 and 9"; of more than ten names the first ten, "and 4 more". Not for an empty list.
std::string list_in_words(std::vector<std::string> names);

/// Pairs of landmarks whose partners look exchanged, which are indices, as users count them, from 1: "1 and
/// 3" for one pair, "1 with 3 and 2 with 4" for more. Not for an empty list.
std::string exchanged_in_words(const std::vector<std::pair<int, int>>& exchanged);

}  // namespace varimap
