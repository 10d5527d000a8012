#include "stages/explore/finished_pool.h"

#include <algorithm>
#include <utility>

#include "varimap/core/timing.h"

namespace varimap {

double ranking_score(const Candidate& candidate) {
    // By more than scores err. Chosen by hand on half of the known pairs; no choice of the other half depends
    // on it. With 1.5, 5 of 146 other choices change, and two right maps of animals are lost.
    constexpr double preference = 0.5;
    return candidate.score - (candidate.explored == 0 ? preference : 0) +
           (candidate.turned_about_axis ? preference : 0);
}

std::vector<Appraised> ordered(std::vector<Appraised> list, const PairContext& context) {
    const auto rank = [](const Candidate& c) { return std::pair(is_mirrored(c), ranking_score(c)); };
    std::stable_sort(list.begin(), list.end(), [&](const Appraised& a, const Appraised& b) {
        return rank(a.candidate) < rank(b.candidate);
    });
    list.front().candidate.moved_mass = list.front().candidate.turn = 0;
    for (std::size_t k = 1; k < list.size(); ++k)
        compare(list.front().map.maps, list[k].map.maps, context, list[k].candidate);
    return list;
}

std::vector<Candidate> ratings(const std::vector<Appraised>& list) {
    std::vector<Candidate> candidates;
    for (const Appraised& one : list) candidates.push_back(one.candidate);
    return candidates;
}

void FinishedPool::add_new_of(const std::vector<PooledMap>& pool) {
    const std::size_t seen = std::exchange(seen_of_pool_, pool.size());
    add(std::span(pool).subspan(std::min(seen, pool.size())));
}

void FinishedPool::add(std::span<const PooledMap> added) {
    if (added.empty()) return;
    const Timer timer("finishing");
    const std::size_t before = origins_.size();
    std::vector<MapStart> starts;
    for (const PooledMap& map : added) {
        starts.push_back(start_of(map));
        origins_.push_back(map.origin);
    }
    for (FinishedMap& map : finish(context_, appraisal_, starts, options_, maps_)) {
        map.start += int(before);
        measured_.push_back(origins_[std::size_t(map.start)]);
        appraisal_.measure(map, context_.landmarks(), measured_.back());
        maps_.push_back(std::move(map));
    }
}

std::vector<Appraised> FinishedPool::appraised() const {
    std::vector<Appraised> list;
    for (std::size_t n = 0; n < maps_.size(); ++n) list.push_back({maps_[n], measured_[n]});
    return ordered(std::move(list), context_);
}

}  // namespace varimap
