#pragma once

#include <string>

namespace varimap {

/// `text` without what a terminal would obey instead of showing: control characters (line breaks too), and
/// bytes that are no UTF-8, become \xNN. Names and words of files go through here before they are printed.
std::string printable(const std::string& text);

}  // namespace varimap
