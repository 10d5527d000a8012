#include "varimap/relaxation/fault_guard.h"

#include <algorithm>
#include <iterator>

namespace varimap {

namespace {

constexpr int most_rings = 8;

enum Fault : unsigned char { reversed = 1, cutting = 2, around_branch_point = 4 };

}  // namespace

FaultGuard::FaultGuard(SlidingMap& map)
    : map_(map),
      along_target_(map),
      agreement_(map, along_target_),
      source_(map.source(), along_target_.source_edges()) {}

void FaultGuard::operator()(const std::vector<int>& free, const std::function<void()>& move) {
    const PointMap kept = map_.points_of(free);
    const std::vector<int> around = widened(map_.faces_around(free));
    const Faults before = faults_of(around);
    move();
    for (int rings = 0; rings <= most_rings; ++rings) {
        const std::vector<int> worse = worse_among(around, before);
        if (worse.empty()) return;
        const std::vector<int> near = vertices_of(map_.source(), source_.widened(worse, rings));
        for (std::size_t i = 0; i < free.size(); ++i)
            if (std::binary_search(near.begin(), near.end(), free[i])) map_.place(free[i], kept[i]);
    }
    map_.place(free, kept);
}

FaultGuard::Faults FaultGuard::faults_of(const std::vector<int>& faces) {
    Faults faults(map_.source().face_count(), 0);
    for (const int f : faces_where(faces, [&](int f) { return along_target_.is_reversed(f); }))
        faults[f] |= reversed;
    for (const int f : agreement_.disagreeing_among(faces)) faults[f] |= cutting;
    for (const int v : vertices_of(map_.source(), faces))
        if (along_target_.is_branch_point(v))
            for (const int f : map_.faces_of_vertex()[v]) faults[f] |= around_branch_point;
    return faults;
}

std::vector<int> FaultGuard::worse_among(const std::vector<int>& faces, const Faults& before) {
    const Faults now = faults_of(faces);
    std::vector<int> worse;
    std::copy_if(faces.begin(), faces.end(), std::back_inserter(worse),
                 [&](int f) { return (now[f] & ~before[f]) != 0; });
    return worse;
}

}  // namespace varimap
