#include "varimap/geodesics/surface_walk.h"

#include <algorithm>
#include <limits>

#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

constexpr int most_faces = 10000;  ///< against walks that never end, as is twice all faces, and some
constexpr int most_slides = 16;    ///< turns at a boundary, where two sides could play ping-pong

}  // namespace

struct SurfaceWalk::State {
    SurfacePoint point;
    Vec3 step;
    int entry = -1;  ///< corner opposite the side the walk came in by (or slides along); never left through
    int slides = 0;
};

SurfaceWalk::SurfaceWalk(const TriangleMesh& mesh)
    : mesh_(mesh), opposite_(opposite_half_edges(find_edges(mesh))) {}

SurfacePoint SurfaceWalk::operator()(const SurfacePoint& start, const Vec3& step) const {
    State state{start, step};
    const int most = std::min(most_faces, 2 * mesh_.face_count() + 100);
    for (int face = 0; face < most && advance(state); ++face) {
    }
    return state.point;
}

/// Walks to the end of the step or of the face; false where the walk ends.
bool SurfaceWalk::advance(State& state) const {
    Vec3& b = state.point.barycentric;
    const auto corners = mesh_.faces.row(state.point.face);
    const Vec3 normal = face_normal(mesh_, state.point.face);
    const double squared = normal.squaredNorm();
    if (!(squared > 0)) return false;
    Vec3 rate;
    for (int i = 0; i < 3; ++i) {
        const Vec3 opposite = mesh_.vertex(corners[(i + 2) % 3]) - mesh_.vertex(corners[(i + 1) % 3]);
        rate[i] = normal.cross(opposite).dot(state.step) / squared;
    }
    double share = 1;
    int exit = -1;
    for (int i = 0; i < 3; ++i)
        if (i != state.entry && rate[i] < 0 && b[i] < -rate[i] * share) {
            share = b[i] / -rate[i];
            exit = i;
        }
    b = (b + share * rate).cwiseMax(0);
    if (exit >= 0) b[exit] = 0;
    b /= b.sum();
    if (exit < 0) return false;
    state.step *= 1 - share;
    cross(state, exit);
    return state.slides <= most_slides;
}

/// Goes on in the face beyond the side opposite `corner`, or along that side if there is none.
void SurfaceWalk::cross(State& state, int corner) const {
    const int from = (corner + 1) % 3, to = (corner + 2) % 3;
    const auto corners = mesh_.faces.row(state.point.face);
    const Vec3 edge = mesh_.vertex(corners[to]) - mesh_.vertex(corners[from]);
    const double length = edge.norm();
    if (!(length > 0)) {
        state.slides = most_slides + 1;
        return;
    }
    const Vec3 along = edge / length;
    const double parallel = state.step.dot(along);
    const int other = opposite_[std::size_t(3 * state.point.face + from)];
    if (other < 0) {
        state.step = parallel * along;
        state.entry = corner;
        ++state.slides;
        return;
    }
    const Vec3 outward = along.cross(face_normal(mesh_, state.point.face)).normalized();
    const Vec3 inward = along.cross(face_normal(mesh_, other / 3)).normalized();
    state.step = parallel * along + state.step.dot(outward) * inward;
    const Vec3 b = state.point.barycentric;
    state.point.face = other / 3;
    state.point.barycentric[other % 3] = b[to];
    state.point.barycentric[(other + 1) % 3] = b[from];
    state.point.barycentric[(other + 2) % 3] = 0;
    state.entry = (other + 2) % 3;
}

}  // namespace varimap
