#include "varimap/sliding/branch_points.h"

namespace varimap {

namespace {

/// How often a side of a polygon crosses the positive first axis, counted from right to left.
int crossing(double ax, double ay, double bx, double by) {
    if ((ay < 0) == (by < 0)) return 0;
    const bool is_leftward = ay < 0;
    const double turn = ax * by - ay * bx;
    if (is_leftward) return turn > 0;
    return -(turn < 0);
}

}  // namespace

int winding_number(const SlidingMap& map, int v) {
    const auto faces = map.faces_of_vertex()[v];
    Vec3 axis = Vec3::Zero();
    for (const int f : faces)
        if (map.is_mapped(f)) axis += map.normal_sum(f);
    const Vec3 first = axis.unitOrthogonal(), second = axis.cross(first);
    int turns = 0;
    for (const int f : faces) {
        if (!map.is_mapped(f)) continue;
        const auto [a, b] = map.image_sides(f, map.corner_of(f, v));
        turns += crossing(first.dot(a), second.dot(a), first.dot(b), second.dot(b));
    }
    return turns;
}

std::vector<int> branch_points(const SlidingMap& map, const std::vector<int>& vertices) {
    std::vector<int> found;
    for (const int v : vertices)
        if (winding_number(map, v) > 1) found.push_back(v);
    return found;
}

void BranchGuard::watch(int v) {
    watched_ = vertices_of(map_.source(), map_.faces_of_vertex()[v]);
    vertex_ = v;
    start_ = map_.point(v);
    most_.reset();
}

bool BranchGuard::allows() {
    const std::size_t now = count();
    if (now == 0) return true;  // as nearly always
    if (!most_) {
        const SurfacePoint present = map_.point(vertex_);
        map_.place(vertex_, start_);
        most_ = count();
        map_.place(vertex_, present);
    }
    return now <= *most_;
}

}  // namespace varimap
