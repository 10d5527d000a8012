#include "varimap/stage/nearest_name.h"

#include <algorithm>

namespace varimap {
namespace {

/// Optimal string alignment distance, row by row.
std::size_t letters_between(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
}

}  // namespace

std::string nearest_name(const std::string& name, const std::vector<std::string>& names) {
    constexpr std::size_t longest = 64;  // names are short; a longer one is none of them
    std::string nearest;
    std::size_t least = std::min(name.size(), longest) / 3 + 1;
    if (name.size() > longest) return nearest;
    for (const auto& candidate : names) {
        const std::size_t distance = letters_between(name, candidate);
        if (distance < least) least = distance, nearest = candidate;
    }
    return nearest;
}

}  // namespace varimap
