#pragma once

#include <string>
#include <vector>

namespace varimap {

/// What this process noted and warned of so far (log.h), in order.
std::vector<std::string> logged_notes();
std::vector<std::string> logged_warnings();

}  // namespace varimap
