#pragma once

#include <string>
#include <string_view>

namespace varimap {

/// `text` without what a terminal would obey instead of showing: control characters (line breaks too), and
/// bytes that are no UTF-8, become \xNN. Names and words of files go through here before they are printed.
std::string printable(std::string_view text);
/// A piece of a file as a message can show it: printable, of its first 40 bytes.
std::string excerpt(std::string_view text);

}  // namespace varimap
