#include "stages/cycles/choice.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "varimap/core/parallel.h"

namespace varimap {
namespace {

// Chosen by hand, not swept.
constexpr double far = .2;       // loops farther off than that are all the same
constexpr double unlikely = .2;  // and so are maps whose score is worse by that
constexpr double weight_of_loops = 2;
constexpr std::size_t most_loops = 60;  // for each pair; the nearest by number

/// Two pairs that lead over a third surface.
struct Detour {
    int first = 0, second = 0;  ///< pairs
    bool first_reversed = false, second_reversed = false;
};

const std::vector<int>& images(const PairOfMaps& pair, int map, bool reversed) {
    const SampledMap& chosen = pair.maps[std::size_t(map)];
    return reversed ? chosen.back : chosen.there;
}

class Collection {
  public:
    Collection(const Samples& samples, const std::vector<PairOfMaps>& pairs)
        : samples_(samples), pairs_(pairs) {
        for (int p = 0; p < int(pairs.size()); ++p) {
            between_[{pairs[std::size_t(p)].source, pairs[std::size_t(p)].target}] = {p, false};
            between_.try_emplace({pairs[std::size_t(p)].target, pairs[std::size_t(p)].source}, p, true);
        }
        detours_.resize(pairs.size());
        for (std::size_t p = 0; p < pairs.size(); ++p)
            for (int via = 0; via < int(samples.size()) && detours_[p].size() < most_loops; ++via)
                add_detour(int(p), via);
    }

    const std::vector<Detour>& detours(std::size_t pair) const { return detours_[pair]; }

    /// Mean distance on the target between the pair's map and the way over the third surface.
    double error(std::size_t pair, int map, const Detour& detour, const Choice& choice) const {
        const auto& direct = pairs_[pair].maps[std::size_t(map)].there;
        const auto& first = images(pairs_[std::size_t(detour.first)], choice[std::size_t(detour.first)],
                                   detour.first_reversed);
        const auto& second = images(pairs_[std::size_t(detour.second)], choice[std::size_t(detour.second)],
                                    detour.second_reversed);
        const Points& target = samples_[std::size_t(pairs_[pair].target)];
        double sum = 0;
        std::size_t count = 0;
        constexpr std::size_t step = 3;  // of a thousand samples
        for (std::size_t v = 0; v < direct.size(); v += step, ++count)
            sum += (target.row(direct[v]) - target.row(second[std::size_t(first[v])])).norm();
        return sum / double(count);
    }

    double cost(std::size_t pair, int map, const Choice& choice) const {
        const auto& maps = pairs_[pair].maps;
        double loops = 0;
        for (const Detour& detour : detours_[pair])
            loops += std::min(error(pair, map, detour, choice), far) / far;
        if (!detours_[pair].empty()) loops /= double(detours_[pair].size());
        const double worse = maps[std::size_t(map)].score - maps.front().score;
        return std::clamp(worse, 0., unlikely) / unlikely + weight_of_loops * loops;
    }

    double cost(const Choice& choice) const {
        double sum = 0;
        for (std::size_t p = 0; p < pairs_.size(); ++p) sum += cost(p, choice[p], choice);
        return sum;
    }

    /// One pair after the other takes the map that lowers the cost of all most, until none changes.
    Choice improved(Choice choice) const {
        for (int sweep = 0, changed = 1; changed > 0 && sweep < 20; ++sweep) {
            changed = 0;
            for (std::size_t p = 0; p < pairs_.size(); ++p) {
                const int best = best_map(p, choice);
                changed += best != choice[p];
                choice[p] = best;
            }
        }
        return choice;
    }

    /// Trusted pairs make a spanning tree; every other pair takes the map nearest to the way along it.
    Choice along_tree() const;

  private:
    void add_detour(int pair, int via) {
        const auto first = between_.find({pairs_[std::size_t(pair)].source, via});
        const auto second = between_.find({via, pairs_[std::size_t(pair)].target});
        if (first == between_.end() || second == between_.end()) return;
        const Detour detour{first->second.first, second->second.first, first->second.second,
                            second->second.second};
        if (detour.first != pair && detour.second != pair) detours_[std::size_t(pair)].push_back(detour);
    }

    int best_map(std::size_t pair, const Choice& choice) const {
        const auto maps = pairs_[pair].maps.size();
        std::vector<double> costs(maps);
        parallel_for_each_index(maps, std::size_t(1), [&](std::size_t m) {
            Choice tried = choice;
            tried[pair] = int(m);
            // Loops that use this pair are seen from all three of theirs.
            costs[m] = cost(pair, int(m), tried);
            for (const Detour& detour : detours_[pair])
                for (const int other : {detour.first, detour.second})
                    costs[m] += cost_of_loops_with(std::size_t(other), pair, tried);
        });
        const auto best = std::min_element(costs.begin(), costs.end());
        const auto kept = costs.begin() + choice[pair];
        return *best < *kept - 1e-9 ? int(best - costs.begin()) : choice[pair];
    }

    double cost_of_loops_with(std::size_t pair, std::size_t with, const Choice& choice) const {
        double sum = 0;
        for (const Detour& detour : detours_[pair])
            if (std::size_t(detour.first) == with || std::size_t(detour.second) == with)
                sum += std::min(error(pair, choice[pair], detour, choice), far) / far;
        return weight_of_loops * sum / double(std::max<std::size_t>(1, detours_[pair].size()));
    }

    const Samples& samples_;
    const std::vector<PairOfMaps>& pairs_;
    std::map<std::pair<int, int>, std::pair<int, bool>> between_;  ///< pair, reversed
    std::vector<std::vector<Detour>> detours_;
};

/// Sets of surfaces that the tree joins.
int root_of(std::vector<int>& parent, int surface) {
    while (parent[std::size_t(surface)] != surface) surface = parent[std::size_t(surface)];
    return surface;
}

Choice Collection::along_tree() const {
    std::vector<std::size_t> order(pairs_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return pairs_[a].trust > pairs_[b].trust; });
    std::vector<int> parent(samples_.size());
    std::iota(parent.begin(), parent.end(), 0);
    // Per surface, images of the samples of each surface of its tree; grown as trees are joined.
    std::vector<std::map<int, std::vector<int>>> reached(samples_.size());
    for (std::size_t s = 0; s < samples_.size(); ++s) {
        auto& self = reached[s][int(s)];
        self.resize(std::size_t(samples_[s].rows()));
        std::iota(self.begin(), self.end(), 0);
    }
    const auto after = [](const std::vector<int>& first, const std::vector<int>& then) {
        std::vector<int> composed;
        for (const int sample : first) composed.push_back(then[std::size_t(sample)]);
        return composed;
    };
    for (const std::size_t p : order) {
        const PairOfMaps& pair = pairs_[p];
        const int a = root_of(parent, pair.source), b = root_of(parent, pair.target);
        if (a == b) continue;
        const auto from = reached[std::size_t(pair.source)], onto = reached[std::size_t(pair.target)];
        for (const auto& [x, to_x] : from)
            for (const auto& [y, to_y] : onto) {
                reached[std::size_t(x)][y] =
                    after(after(reached[std::size_t(x)].at(pair.source), pair.maps.front().there), to_y);
                reached[std::size_t(y)][x] =
                    after(after(reached[std::size_t(y)].at(pair.target), pair.maps.front().back), to_x);
            }
        parent[std::size_t(a)] = b;
    }
    Choice choice(pairs_.size(), 0);
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        const auto& way = reached[std::size_t(pairs_[p].source)].at(pairs_[p].target);
        const Points& target = samples_[std::size_t(pairs_[p].target)];
        double nearest = -1;
        for (std::size_t m = 0; m < pairs_[p].maps.size(); ++m) {
            double off = 0;
            for (std::size_t v = 0; v < way.size(); ++v)
                off += (target.row(pairs_[p].maps[m].there[v]) - target.row(way[v])).norm();
            if (nearest >= 0 && off >= nearest) continue;
            nearest = off;
            choice[p] = int(m);
        }
    }
    return choice;
}

}  // namespace

std::vector<Loops> measure_loops(const Samples& samples, const std::vector<PairOfMaps>& pairs,
                                 const Choice& choice) {
    const Collection collection(samples, pairs);
    std::vector<Loops> result(pairs.size());
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        for (const Detour& detour : collection.detours(p)) {
            const double error = collection.error(p, choice[p], detour, choice);
            ++result[p].count;
            result[p].closed += error < closing;
            result[p].error += error;
        }
        if (result[p].count > 0) result[p].error /= result[p].count;
    }
    return result;
}

Choice choose(const Samples& samples, const std::vector<PairOfMaps>& pairs) {
    const Collection collection(samples, pairs);
    const Choice first(pairs.size(), 0);
    Choice best = collection.improved(first);
    Choice other = collection.improved(collection.along_tree());
    if (collection.cost(other) < collection.cost(best) - 1e-9) best = std::move(other);
    return collection.cost(best) < collection.cost(first) - 1e-9 ? best : first;
}

}  // namespace varimap
