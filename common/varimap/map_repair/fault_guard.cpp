#include "varimap/map_repair/fault_guard.h"

#include <algorithm>
#include <iterator>

namespace varimap {

namespace {

constexpr int most_rings = 8;

enum Fault : unsigned char { reversed_along_target = 1, reversed_by_normals = 2, cutting = 4 };

}  // namespace

FaultGuard::FaultGuard(SlidingMap& map, FaultJudges& judges)
    : map_(map),
      along_target_(judges.along_target),
      agreement_(judges.agreement),
      source_(map.source(), along_target_.source_edges()) {}

void FaultGuard::operator()(const std::vector<int>& free, const std::function<void()>& move) {
    const PointMap kept = map_.points_of(free);
    const std::vector<int> around = source_.widened(map_.faces_around(free), 1);
    const Faults before = faults_of(around);
    move();
    for (int rings = 0;; ++rings) {
        const std::vector<int> worse = worse_among(around, before);
        if (worse.empty()) return;
        if (rings > most_rings) break;
        const std::vector<int> near = vertices_of(map_.source(), source_.widened(worse, rings));
        for (std::size_t i = 0; i < free.size(); ++i)
            if (std::binary_search(near.begin(), near.end(), free[i])) map_.place(free[i], kept[i]);
    }
    map_.place(free, kept);
}

FaultGuard::Faults FaultGuard::faults_of(const std::vector<int>& faces) {
    Faults faults{FaceData<unsigned char>(map_.source().face_count(), 0),
                  VertexData<bool>(map_.source().vertex_count(), false)};
    for (const int f : faces)
        if (map_.is_mapped(f) && !(map_.image_triangle(f).D > 0)) faults.of_face[f] |= reversed_by_normals;
    for (const int f : faces_where(faces, [&](int f) { return along_target_.is_reversed(f); }))
        faults.of_face[f] |= reversed_along_target;
    for (const int f : agreement_.disagreeing_among(faces)) faults.of_face[f] |= cutting;
    for (const int v : vertices_of(map_.source(), faces))
        faults.is_branch_point[v] = along_target_.is_branch_point(v);
    return faults;
}

std::vector<int> FaultGuard::worse_among(const std::vector<int>& faces, const Faults& before) {
    const Faults now = faults_of(faces);
    const auto is_worse = [&](int f) {
        if ((now.of_face[f] & ~before.of_face[f]) != 0) return true;
        const auto corners = map_.source().faces.row(f);
        return std::any_of(corners.begin(), corners.end(),
                           [&](int v) { return now.is_branch_point[v] && !before.is_branch_point[v]; });
    };
    std::vector<int> worse;
    std::copy_if(faces.begin(), faces.end(), std::back_inserter(worse), is_worse);
    return worse;
}

}  // namespace varimap
