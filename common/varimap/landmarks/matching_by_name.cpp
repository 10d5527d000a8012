#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "varimap/core/counted.h"
#include "varimap/core/error.h"
#include "varimap/core/listed.h"
#include "varimap/core/log.h"
#include "varimap/core/printable.h"
#include "varimap/landmarks/private/named.h"

namespace varimap {

namespace {

bool have_distinct_names(const std::vector<Named>& list) {
    std::set<std::string> names;
    for (const Named& named : list)
        if (named.name.empty() || !names.insert(named.name).second) return false;
    return true;
}

/// Names that one of two lists lacks, the first few of them.
std::string names_in_one(const std::vector<Named> (&lists)[2]) {
    std::map<std::string, int> count;
    for (const auto& list : lists)
        for (const Named& named : list) ++count[named.name];
    std::vector<std::string> names;
    for (const auto& [name, times] : count)
        if (times == 1) names.push_back(fmt::format("'{}'", excerpt(name)));
    return listed(names);
}

/// A name that stands twice must not shift the others' partners in silence.
void warn_of_other_names(const std::vector<std::pair<Named, Named>>& rows,
                         const std::vector<std::string>& files) {
    const auto other = std::find_if(rows.begin(), rows.end(), [](const std::pair<Named, Named>& row) {
        return !row.first.name.empty() && !row.second.name.empty() && row.first.name != row.second.name;
    });
    if (other != rows.end())
        warn(
            "{} and {} are matched row by row, since a name is missing or stands twice, but row {} is '{}' "
            "and '{}'",
            files[0], files[1], other - rows.begin() + 1, excerpt(other->first.name),
            excerpt(other->second.name));
}

/// The rows in front of which lines of the file hold none.
std::vector<size_t> rows_behind_gaps(const std::vector<Named>& list) {
    std::vector<size_t> rows;
    for (size_t i = 1; i < list.size(); ++i)
        if (list[i].line > list[i - 1].line + 1) rows.push_back(i);
    return rows;
}

/// An empty line may stand for a landmark that was not found: then rows behind it are no partners.
void require_same_gaps(const std::vector<Named> (&lists)[2], const std::vector<std::string>& files) {
    const std::vector<size_t> gaps[2]{rows_behind_gaps(lists[0]), rows_behind_gaps(lists[1])};
    if (gaps[0].empty() || gaps[1].empty() || gaps[0] == gaps[1]) return;
    const auto first = [&](int side) {
        return row_of(files[size_t(side)], lists[side][gaps[side][0]].line - 1).place;
    };
    throw InputError(fmt::format(
        "{} and {}: lines without a landmark stand at other places in the two lists, which are matched "
        "row by row; leave them out, and the partners of those that are missing",
        first(0), first(1)));
}

/// Of rows that match.
std::vector<std::pair<Named, Named>> matching_rows(const std::vector<Named> (&lists)[2],
                                                   const std::vector<std::string>& files) {
    std::vector<std::pair<Named, Named>> pairs;
    if (have_distinct_names(lists[0]) && have_distinct_names(lists[1])) {
        std::map<std::string, Named> target;
        for (const Named& named : lists[1]) target[named.name] = named;
        for (const Named& named : lists[0])
            if (const auto found = target.find(named.name); found != target.end())
                pairs.emplace_back(named, found->second);
        if (pairs.empty())
            throw InputError(fmt::format("{} and {} have no name in common", files[0], files[1]));
        if (pairs.size() < std::max(lists[0].size(), lists[1].size()))
            note("{} in both {} and {}; left out are {}", counted(std::ssize(pairs), "name is", "names are"),
                 files[0], files[1], names_in_one(lists));
        return pairs;
    }
    if (lists[0].size() != lists[1].size())
        throw InputError(fmt::format("{} names {} vertices but {} names {}; they are matched row by row",
                                     files[0], lists[0].size(), files[1], lists[1].size()));
    require_same_gaps(lists, files);
    for (size_t i = 0; i < lists[0].size(); ++i) pairs.emplace_back(lists[0][i], lists[1][i]);
    warn_of_other_names(pairs, files);
    return pairs;
}

}  // namespace

MatchedLists matched(const std::vector<Named> (&lists)[2], const std::vector<std::string>& files) {
    std::vector<std::pair<Named, Named>> rows = matching_rows(lists, files), pairs;
    const std::ptrdiff_t of_both_lists = std::ssize(lists[0]) + std::ssize(lists[1]) - std::ssize(rows);
    std::vector<std::string> missing;
    for (auto& pair : rows) {
        const auto& [source, target] = pair;
        if (source.vertex != no_vertex && target.vertex != no_vertex)
            pairs.push_back(std::move(pair));
        else
            missing.push_back(source.name.empty()
                                  ? fmt::format("{} {}", row_of(files[0], source.line).unit, source.line)
                                  : fmt::format("'{}'", excerpt(source.name)));
    }
    if (pairs.empty()) throw InputError(files[0] + ": no landmark is there on both surfaces");
    if (!missing.empty())
        note("{}: {} or switched off on one of the surfaces, and left out: {}", fmt::join(files, " and "),
             counted(std::ssize(missing), "landmark is missing", "landmarks are missing"), listed(missing));
    const int left_out = int(of_both_lists - std::ssize(pairs));
    return {std::move(pairs), left_out};
}

}  // namespace varimap
