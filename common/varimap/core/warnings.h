#pragma once

#include <string>
#include <vector>

namespace varimap {

/// What this process warned of so far (log.h), in order.
std::vector<std::string> logged_warnings();

}  // namespace varimap
