#include "varimap/map_repair/bound_repair.h"

#include <utility>

#include "varimap/core/timing.h"
#include "varimap/map_repair/fault_guard.h"
#include "varimap/relaxation/local_relaxation.h"

namespace varimap {

namespace {

/// To look for faults takes five times as long as to sweep: it is done once every two presses. Chosen on half
/// of a list (18 pairs, bound 2): with one press each, and twice as many looks, the bound is kept on 99.47
/// instead of 99.33% of the area, which takes twice as long; with four presses each, on 99.2%. Of tight
/// bounds there are twice as many.
constexpr int looks = 10, presses_per_look = 2, sweeps_per_press = 4;
/// Vertices in looks, in all: five pairs of closed surfaces of 5,000 to 20,000 have 14,000 to 69,000. Without
/// a bound the torn walls of a skull take a third of the time of relaxation.
constexpr double most_visits = 80'000;

}  // namespace

BoundRepair::BoundRepair(SlidingMap& map, double bound, VertexData<bool> exempt, VertexData<bool> held)
    : map_(map),
      bound_(map, bound, std::move(exempt)),
      most_looks_((AreaBound::is_tight(bound) ? 2 : 1) * looks),
      held_(std::move(held)) {}

void BoundRepair::operator()(const FoldEnergy& energy) {
    const Timer timer("area bound");
    std::vector<int> pressed = bound_.press();
    if (pressed.empty()) return;
    FaultJudges judges(map_);
    FaultGuard guard(map_, judges);
    double visits = 0;
    for (int look = 0; look < most_looks_ && !pressed.empty(); ++look) {
        const std::vector<int> free = free_around(pressed);
        visits += double(free.size());
        if (visits > most_visits) return;
        guard(free, [&] { sweep(free, energy); });
        pressed = bound_.press_again(free);
    }
}

std::vector<int> BoundRepair::free_around(const std::vector<int>& vertices) const {
    const std::vector<int> near = vertices_of(map_.source(), map_.faces_around(vertices));
    std::vector<int> free = vertices_of(map_.source(), map_.faces_around(near));
    std::erase_if(free, [&](int v) { return held_[v] || !map_.has_image(v); });
    return free;
}

void BoundRepair::sweep(const std::vector<int>& free, const FoldEnergy& energy) {
    LocalRelaxation local(map_, 99);
    std::vector<int> shuffled = free;
    for (int press = 0; press < presses_per_look; ++press) {
        if (press > 0) bound_.press_again(free);
        for (int i = 0; i < sweeps_per_press; ++i) local.sweep(shuffled, energy);
    }
}

}  // namespace varimap
