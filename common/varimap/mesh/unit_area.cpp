#include "varimap/mesh/unit_area.h"

#include <cmath>

#include "varimap/mesh/face_geometry.h"

namespace varimap {

TriangleMesh unit_area(const TriangleMesh& mesh) {
    TriangleMesh result = mesh;
    const Box box = bounding_box(mesh);
    result.vertices.rowwise() -= ((box.low + box.high) / 2).transpose();
    result.vertices /= std::sqrt(surface_area(result));
    return result;
}

bool is_degenerate(const TriangleMesh& mesh, int f) {
    const double longest = longest_edge(mesh, f);
    // Of coordinates of order 1: a height of less than shape * rounding is rounding.
    constexpr double shape = 1e-10, rounding = 1e-4;
    return !(face_normal(mesh, f).norm() > shape * longest * (longest + rounding));
}

}  // namespace varimap
