#include "stages/cycles/choice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "varimap/core/index_set.h"
#include "varimap/core/parallel.h"

namespace varimap {
namespace {

// Chosen on generated bipeds and quadrupeds.
constexpr double tolerance = .1;  // distance at which a map hardly agrees with the layout any more
constexpr double chance = .05;    // that a layout is right which none of a pair's maps agrees with
constexpr double clearly = 4;     // by that much (log) a layout is more probable that gives up a first map
/// Ways over third surfaces against which no pair is sure: so many that are certain, more that are less so.
constexpr double ways_against_sure = 2;
constexpr std::size_t most_loops = 60;       // for each pair; over the first surfaces
constexpr std::size_t most_neighbours = 20;  // over which a surface is tried to be laid out; the surest
constexpr std::size_t most_roots = 10;       // layouts
constexpr std::size_t stride = 3;            // of a thousand samples

using Images = std::vector<int>;

Images composed(const Images& first, const Images& then) {
    Images result(first.size());
    for (std::size_t v = 0; v < first.size(); ++v) result[v] = then[std::size_t(first[v])];
    return result;
}

/// Mean distance of the images of every third sample.
template <class ImageOf>
double distance(const Images& images, const ImageOf& other, const Points& target) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < images.size(); v += stride, ++count)
        sum += (target.row(images[v]) - target.row(other(v))).norm();
    return sum / double(count);
}

/// A pair as one of its two surfaces sees it.
struct Neighbour {
    std::size_t pair = 0;
    int surface = 0;        ///< the other one
    bool reversed = false;  ///< whether this one is the pair's target
};

/// Per surface, its pairs, the surest first.
std::vector<std::vector<Neighbour>> neighbours(std::size_t surfaces, const std::vector<PairOfMaps>& pairs) {
    std::vector<std::vector<Neighbour>> of(surfaces);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        of[std::size_t(pairs[p].source)].push_back({p, pairs[p].target, false});
        of[std::size_t(pairs[p].target)].push_back({p, pairs[p].source, true});
    }
    for (auto& list : of)
        std::stable_sort(list.begin(), list.end(), [&](const Neighbour& a, const Neighbour& b) {
            return pairs[a.pair].maps.front().probability > pairs[b.pair].maps.front().probability;
        });
    return of;
}

/// One map for every surface to the root and back; none for those that are not laid out yet.
class Layout {
  public:
    Layout(const Samples& samples, const std::vector<PairOfMaps>& pairs,
           const std::vector<std::vector<Neighbour>>& neighbours, int root)
        : samples_(samples), pairs_(pairs), neighbours_(neighbours), places_(samples.size()) {
        set_root(root);
        for (int next = nearest(); next >= 0; next = nearest()) place(next);
        for (int sweep = 0, moved = 1; moved > 0 && sweep < 10; ++sweep) {
            moved = 0;
            for (int s = 0; s < int(samples.size()); ++s) moved += s != root && place(s);
        }
    }

    double log_probability() const {
        double sum = 0;
        for (std::size_t p = 0; p < pairs_.size(); ++p) {
            const auto s = std::size_t(pairs_[p].source);
            sum += log_probability(p, places_[s], places_[std::size_t(pairs_[p].target)]);
        }
        return sum;
    }

    /// The number of a pair's map; that behind its last one: none of them, but what the layout says.
    std::size_t choice(std::size_t p) const {
        const PairOfMaps& pair = pairs_[p];
        const auto terms =
            probabilities(p, places_[std::size_t(pair.source)], places_[std::size_t(pair.target)]);
        const auto best = std::max_element(terms.begin(), terms.end());
        const auto number = std::size_t(best - terms.begin());
        return number > 0 && is_first_given_up(p, number) ? number : 0;
    }

    /// What the layout says of a pair.
    SampledMap laid_out(std::size_t p) const {
        const Place &source = places_[std::size_t(pairs_[p].source)],
                    &target = places_[std::size_t(pairs_[p].target)];
        return {composed(source.to_root, target.from_root), composed(target.to_root, source.from_root), 0};
    }

  private:
    struct Place {
        Images to_root, from_root;
        bool known() const { return !to_root.empty(); }
    };

    void set_root(int surface) {
        Place& place = places_[std::size_t(surface)];
        place.to_root = all_indices(samples_[std::size_t(surface)].rows());
        place.from_root = place.to_root;
    }

    /// The surface beside what is laid out whose pair with it is the surest; of others, a new root; -1: none
    /// with pairs is left.
    int nearest() {
        int found = -1;
        double most = -1;
        for (std::size_t s = 0; s < places_.size(); ++s) {
            if (places_[s].known() || neighbours_[s].empty()) continue;
            if (found < 0) found = int(s);
            for (const Neighbour& n : neighbours_[s]) {
                const double probability = pairs_[n.pair].maps.front().probability;
                if (!places_[std::size_t(n.surface)].known() || probability <= most) continue;
                most = probability;
                found = int(s);
            }
        }
        if (found >= 0 && most < 0) set_root(found);
        return found;
    }

    /// Lays a surface out over that neighbour by that map which fits all that is laid out best. Whether it
    /// moved.
    bool place(int surface) {
        const auto s = std::size_t(surface);
        struct Way {
            Neighbour over;
            std::size_t map;
        };
        std::vector<Way> ways;
        std::size_t tried = 0;
        for (const Neighbour& n : neighbours_[s]) {
            if (!places_[std::size_t(n.surface)].known() || tried == most_neighbours) continue;
            ++tried;
            for (std::size_t k = 0; k < pairs_[n.pair].maps.size(); ++k) ways.push_back({n, k});
        }
        if (ways.empty()) return false;
        std::vector<double> fit(ways.size());
        parallel_for_each_index(ways.size(), std::size_t(1), [&](std::size_t w) {
            fit[w] = log_probability(surface, place_over(ways[w].over, ways[w].map));
        });
        const auto best = std::size_t(std::max_element(fit.begin(), fit.end()) - fit.begin());
        if (places_[s].known() && fit[best] <= log_probability(surface, places_[s]) + 1e-9) return false;
        places_[s] = place_over(ways[best].over, ways[best].map);
        return true;
    }

    Place place_over(const Neighbour& over, std::size_t map) const {
        const SampledMap& step = pairs_[over.pair].maps[map];
        const Place& other = places_[std::size_t(over.surface)];
        const Images &onto = over.reversed ? step.back : step.there,
                     &from = over.reversed ? step.there : step.back;
        return {composed(onto, other.to_root), composed(other.from_root, from)};
    }

    /// Of all pairs of a surface, if that were its place.
    double log_probability(int surface, const Place& place) const {
        double sum = 0;
        for (const Neighbour& n : neighbours_[std::size_t(surface)]) {
            const Place& other = places_[std::size_t(n.surface)];
            if (!other.known()) continue;
            sum += n.reversed ? log_probability(n.pair, other, place) : log_probability(n.pair, place, other);
        }
        return sum;
    }
    double log_probability(std::size_t pair, const Place& source, const Place& target) const {
        const auto terms = probabilities(pair, source, target);
        return std::log(std::accumulate(terms.begin(), terms.end(), 0.));
    }

    /// One term for each map, and one for none of them.
    std::vector<double> probabilities(std::size_t p, const Place& source, const Place& target) const {
        const PairOfMaps& pair = pairs_[p];
        const Points& points = samples_[std::size_t(pair.target)];
        const auto laid_out = [&](std::size_t v) { return target.from_root[std::size_t(source.to_root[v])]; };
        std::vector<double> terms;
        double none = 1;
        for (const SampledMap& map : pair.maps) {
            const double d = distance(map.there, laid_out, points) / tolerance;
            terms.push_back(map.probability * std::exp(-d * d));
            none -= map.probability;
        }
        terms.push_back(chance * std::max(none, 1e-3));
        return terms;
    }

    bool is_first_given_up(std::size_t p, std::size_t number) const {
        const PairOfMaps& pair = pairs_[p];
        if (pair.sure && seen(p) < ways_against_sure) return false;
        return number < pair.maps.size() ? loss_with_first(p) >= clearly
                                         : seen(p) > pair.maps.front().probability;
    }

    /// How much less probable (log) the layout is with one of the pair's surfaces where the pair's first map
    /// has it.
    double loss_with_first(std::size_t p) const {
        const int source = pairs_[p].source, target = pairs_[p].target;
        const auto loss = [&](int surface, const Neighbour& over) {
            return log_probability(surface, places_[std::size_t(surface)]) -
                   log_probability(surface, place_over(over, 0));
        };
        return std::min(loss(source, {p, target, false}), loss(target, {p, source, true}));
    }

    /// Probability that what the layout says of a pair is right, as far as the pair alone tells.
    double agreement(std::size_t p) const {
        const auto terms =
            probabilities(p, places_[std::size_t(pairs_[p].source)], places_[std::size_t(pairs_[p].target)]);
        return std::accumulate(terms.begin(), terms.end() - 1, 0.);
    }

    /// How many ways over third surfaces are right, in the mean, and agree with the layout.
    double seen(std::size_t p) const {
        std::map<int, std::size_t> first;
        for (const Neighbour& n : neighbours_[std::size_t(pairs_[p].source)]) first[n.surface] = n.pair;
        double sum = 0;
        for (const Neighbour& n : neighbours_[std::size_t(pairs_[p].target)])
            if (const auto found = first.find(n.surface); found != first.end())
                sum += agreement(found->second) * agreement(n.pair);
        return sum;
    }

    const Samples& samples_;
    const std::vector<PairOfMaps>& pairs_;
    const std::vector<std::vector<Neighbour>>& neighbours_;
    std::vector<Place> places_;
};

/// The surfaces whose pairs are the surest.
std::vector<int> roots(const std::vector<std::vector<Neighbour>>& neighbours,
                       const std::vector<PairOfMaps>& pairs) {
    std::vector<int> order = all_indices(std::ssize(neighbours));
    std::vector<double> sum(order.size());
    for (std::size_t s = 0; s < order.size(); ++s)
        for (const Neighbour& n : neighbours[s]) sum[s] += pairs[n.pair].maps.front().probability;
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return sum[std::size_t(a)] > sum[std::size_t(b)]; });
    order.resize(std::min(order.size(), most_roots));
    return order;
}

const Images& images(const PairOfMaps& pair, int map, bool reversed) {
    const SampledMap& chosen = pair.maps[std::size_t(map)];
    return reversed ? chosen.back : chosen.there;
}

}  // namespace

std::vector<std::size_t> kinds(const std::vector<SampledMap>& maps, const Points& target) {
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < maps.size(); ++k) {
        std::size_t first = 0;
        while (first < k &&
               (result[first] < first ||
                distance(
                    maps[k].there, [&](std::size_t v) { return maps[first].there[v]; }, target) >= closing))
            ++first;
        result.push_back(first);
    }
    return result;
}

std::vector<Loops> measure_loops(const Samples& samples, const std::vector<PairOfMaps>& pairs,
                                 const Choice& choice) {
    std::map<std::pair<int, int>, std::pair<std::size_t, bool>> between;  // pair, reversed
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        between[{pairs[p].source, pairs[p].target}] = {p, false};
        between.try_emplace({pairs[p].target, pairs[p].source}, p, true);
    }
    std::vector<Loops> result(pairs.size());
    parallel_for_each_index(pairs.size(), std::size_t(1), [&](std::size_t p) {
        const PairOfMaps& pair = pairs[p];
        Loops& loops = result[p];
        for (int via = 0; via < int(samples.size()) && std::size_t(loops.count) < most_loops; ++via) {
            const auto first = between.find({pair.source, via}), second = between.find({via, pair.target});
            if (first == between.end() || second == between.end()) continue;
            const auto [p1, reversed1] = first->second;
            const auto [p2, reversed2] = second->second;
            if (p1 == p || p2 == p) continue;
            const Images &there = images(pairs[p1], choice[p1], reversed1),
                         &on = images(pairs[p2], choice[p2], reversed2);
            const double error = distance(
                images(pair, choice[p], false), [&](std::size_t v) { return on[std::size_t(there[v])]; },
                samples[std::size_t(pair.target)]);
            ++loops.count;
            loops.closed += error < closing;
            loops.error += error;
        }
        if (loops.count > 0) loops.error /= loops.count;
    });
    return result;
}

Choice choose(const Samples& samples, std::vector<PairOfMaps>& pairs) {
    const auto list = neighbours(samples.size(), pairs);
    std::optional<Layout> best;
    for (const int root : roots(list, pairs)) {
        Layout layout(samples, pairs, list, root);
        if (!best || layout.log_probability() > best->log_probability()) best.emplace(std::move(layout));
    }
    Choice choice(pairs.size(), 0);
    std::vector<std::pair<std::size_t, SampledMap>> added;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        choice[p] = int(best->choice(p));
        if (std::size_t(choice[p]) == pairs[p].maps.size()) added.emplace_back(p, best->laid_out(p));
    }
    for (auto& [p, map] : added) pairs[p].maps.push_back(std::move(map));
    return choice;
}

}  // namespace varimap
