#include "varimap/results/landmark_words.h"

#include <fmt/format.h>

namespace varimap {

std::string list_in_words(std::vector<std::string> names) {
    constexpr std::size_t most = 10;
    if (names.size() > most) {
        const std::size_t more = names.size() - most;
        names.resize(most);
        names.push_back(fmt::format("{} more", more));
    }
    const std::string last = names.back();
    names.pop_back();
    return names.empty() ? last : fmt::format("{} and {}", fmt::join(names, ", "), last);
}

std::string exchanged_in_words(const std::vector<std::pair<int, int>>& exchanged) {
    const char* joined = exchanged.size() == 1 ? "and" : "with";
    std::vector<std::string> names;
    for (const auto& [i, j] : exchanged) names.push_back(fmt::format("{} {} {}", i + 1, joined, j + 1));
    return list_in_words(std::move(names));
}

}  // namespace varimap
