#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "varimap/artifact/artifact.h"

namespace varimap {

/// First line of every artifact; the number changes when the form of the header does.
inline constexpr std::string_view magic = "varimap artifact 1";
/// What follows the payload, so that a shortened or extended file is told from a whole one.
inline constexpr std::string_view end_mark = "\nend of varimap artifact\n";

/// Parses the header at the start of `bytes` and checks its own hash. Returns its length in bytes; nothing
/// where it is damaged or not complete.
std::optional<std::size_t> parse_header(std::string_view bytes, Header& header);

}  // namespace varimap
