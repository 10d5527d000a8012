#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace varimap {

/// "a, b, c"; of many the first twelve, "and 30 more".
inline std::string listed(const std::vector<std::string>& items) {
    constexpr std::size_t most = 12;
    const std::size_t shown = std::min(items.size(), most);
    std::string text;
    for (std::size_t i = 0; i < shown; ++i) text += (i > 0 ? ", " : "") + items[i];
    return items.size() > shown ? text + " and " + std::to_string(items.size() - shown) + " more" : text;
}

}  // namespace varimap
