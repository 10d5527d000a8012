#include "varimap/sliding/along_target.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "varimap/core/index_set.h"
#include "varimap/mesh/face_geometry.h"

namespace varimap {

namespace {

/// Faces looked at for a path in any case. Those of torn triangles are looked for in vain again and again:
/// with 2000 relaxing a skull takes a fifth longer, and as many of its faces end reversed.
constexpr int least_farthest = 300;

}  // namespace

AlongTarget::AlongTarget(const SlidingMap& map)
    : map_(map),
      target_faces_(vertex_faces(map.target())),
      source_edges_(find_shared_edges(map.source())),
      target_edges_(find_shared_edges(map.target())),
      log_map_(map.target(), target_edges_),
      known_edges_(map, source_edges_->size()),
      known_faces_(map) {}

double AlongTarget::winding_number(int v) {
    double turns = 0;
    for (const int f : map_.faces_of_vertex()[v]) turns += lie(f).turns[std::size_t(map_.corner_of(f, v))];
    return turns / (2 * std::numbers::pi);
}

std::vector<int> AlongTarget::faulty_among(const std::vector<int>& faces) {
    std::vector<int> faulty = faces_where(faces, [&](int f) { return is_reversed(f); });
    for (const int v : vertices_of(map_.source(), faces)) {
        if (!is_branch_point(v)) continue;
        const auto star = map_.faces_of_vertex()[v];
        faulty.insert(faulty.end(), star.begin(), star.end());
    }
    make_set(faulty);
    return faulty;
}

std::vector<int> AlongTarget::faulty_faces() {
    return faulty_among(all_indices(map_.source().face_count()));
}

AlongTarget::Faults AlongTarget::faults_around(int v) {
    Faults faults;
    const auto star = map_.faces_of_vertex()[v];
    for (const int f : star) faults.reversed += is_reversed(f);
    for (const int u : vertices_of(map_.source(), star)) faults.branch_points += is_branch_point(u);
    return faults;
}

bool AlongTarget::lies_within_a_star(int f, const Vec3& normal) const {
    const TriangleMesh& target = map_.target();
    const auto c = map_.source().faces.row(f);
    const auto holds = [&](int corner, int vertex) {
        const auto face = target.faces.row(map_.point(c[corner]).face);
        return face[0] == vertex || face[1] == vertex || face[2] == vertex;
    };
    for (int k = 0; k < 3; ++k) {
        const int vertex = target.faces(map_.point(c[0]).face, k);
        if (!holds(1, vertex) || !holds(2, vertex)) continue;
        const auto star = target_faces_[vertex];
        if (std::all_of(star.begin(), star.end(),
                        [&](int g) { return normal.dot(face_normal(target, g)) > 0; }))
            return true;
    }
    return false;
}

const Lie& AlongTarget::lie(int f) {
    return known_faces_(f, [&](int g) { return look_at(g); });
}

/// At least those as near as the edge is long. Else edges that lie over many faces of the target, as those of
/// a part with two triangles a side do, would be taken for torn.
int AlongTarget::farthest(const std::array<int, 2>& ends) const {
    const double squared = (map_.source().vertex(ends[1]) - map_.source().vertex(ends[0])).squaredNorm();
    const double near = std::numbers::pi * squared * map_.target().face_count();  // of unit area
    return int(std::clamp<double>(near, least_farthest, LogMap::usual_farthest));
}

SeenSide AlongTarget::side(int f, int k) {
    const int e = source_edges_->of_half_edge[std::size_t(3 * f + k)];
    const std::array<int, 2>& ends = source_edges_->vertices[std::size_t(e)];
    const std::scoped_lock lock(edge_lock_[std::size_t(e) % locks]);
    SeenSide seen = known_edges_(
        e, ends, [&] { return log_map_(map_.point(ends[0]), map_.point(ends[1]), farthest(ends)); });
    if (map_.source().faces(f, k) != ends[0]) std::swap(seen.first, seen.second);
    return seen;
}

Lie AlongTarget::look_at(int f) {
    if (!map_.is_mapped(f)) return {1, {0, 0, 0}};
    if (!lies_within_a_star(f, map_.chord_normal(f))) return laid_out({side(f, 0), side(f, 1), side(f, 2)});
    Lie straight{1, {}};
    for (int k = 0; k < 3; ++k) {
        const auto [to_next, to_last] = map_.image_sides(f, k);
        straight.turns[std::size_t(k)] = angle_between(to_next, to_last);
    }
    return straight;
}

}  // namespace varimap
