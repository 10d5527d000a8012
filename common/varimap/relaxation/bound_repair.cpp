#include "varimap/relaxation/bound_repair.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "varimap/core/index_set.h"
#include "varimap/core/timing.h"
#include "varimap/relaxation/local_relaxation.h"

namespace varimap {

namespace {

/// To look for faults takes five times as long as to sweep: it is done once every two presses. Chosen on half
/// of a list (18 pairs, bound 2): 20 looks instead of 10 keep the bound on 99.47 instead of 99.33% of the
/// area, and take twice as long; four presses each, 99.2%. Of tight bounds there are twice as many.
constexpr int looks = 10, presses_per_look = 2, sweeps_per_press = 4;
const FoldEnergy energy{1, 0.1};
/// Around new faults that are taken back at most, one more each time that some are left; then all is.
constexpr int most_rings = 8;

enum Fault : unsigned char { reversed = 1, cutting = 2, around_branch_point = 4 };

}  // namespace

BoundRepair::BoundRepair(SlidingMap& map, double bound, VertexData<bool> exempt, VertexData<bool> held)
    : map_(map),
      bound_(map, bound, std::move(exempt)),
      most_looks_((AreaBound::is_tight(bound) ? 2 : 1) * looks),
      held_(std::move(held)),
      along_target_(map),
      agreement_(map, along_target_),
      source_(map.source(), along_target_.source_edges()) {}

void BoundRepair::operator()() {
    const Timer timer("area bound");
    std::vector<int> pressed = bound_.press();
    for (int look = 0; look < most_looks_ && !pressed.empty(); ++look) {
        const std::vector<int> free = free_around(pressed);
        sweep(free);
        pressed = bound_.press_again(free);
    }
}

std::vector<int> BoundRepair::free_around(const std::vector<int>& vertices) {
    std::vector<int> free = vertices_of(map_.source(), source_.widened(map_.faces_around(vertices), 1));
    std::erase_if(free, [&](int v) { return held_[v] || !map_.has_image(v); });
    return free;
}

void BoundRepair::sweep(const std::vector<int>& free) {
    const PointMap kept = map_.points_of(free);
    const std::vector<int> around = source_.widened(map_.faces_around(free), 1);
    const Faults before = faults_of(around);
    LocalRelaxation local(map_, 99);
    std::vector<int> shuffled = free;
    for (int press = 0; press < presses_per_look; ++press) {
        if (press > 0) bound_.press_again(free);
        for (int i = 0; i < sweeps_per_press; ++i) local.sweep(shuffled, energy);
    }
    for (int rings = 0; rings <= most_rings; ++rings) {
        const std::vector<int> worse = worse_among(around, before);
        if (worse.empty()) return;
        const std::vector<int> near = vertices_of(map_.source(), source_.widened(worse, rings));
        for (std::size_t i = 0; i < free.size(); ++i)
            if (std::binary_search(near.begin(), near.end(), free[i])) map_.place(free[i], kept[i]);
    }
    map_.place(free, kept);
}

BoundRepair::Faults BoundRepair::faults_of(const std::vector<int>& faces) {
    Faults faults(map_.source().face_count(), 0);
    for (const int f : faces_where(faces, [&](int f) { return along_target_.is_reversed(f); }))
        faults[f] |= reversed;
    for (const int f : agreement_.disagreeing_among(faces)) faults[f] |= cutting;
    for (const int v : vertices_of(map_.source(), faces))
        if (along_target_.is_branch_point(v))
            for (const int f : map_.faces_of_vertex()[v]) faults[f] |= around_branch_point;
    return faults;
}

std::vector<int> BoundRepair::worse_among(const std::vector<int>& faces, const Faults& before) {
    const Faults now = faults_of(faces);
    std::vector<int> worse;
    std::copy_if(faces.begin(), faces.end(), std::back_inserter(worse),
                 [&](int f) { return (now[f] & ~before[f]) != 0; });
    return worse;
}

}  // namespace varimap
