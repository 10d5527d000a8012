#pragma once

#include <string>
#include <string_view>

namespace varimap {

/// A piece of a file as a message can show it: at most 40 characters, on one line, without what could steer a
/// terminal. Each byte that is not printable ASCII becomes '?'.
std::string printable(std::string_view text);

}  // namespace varimap
