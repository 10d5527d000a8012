#include "varimap/mesh/subdivision.h"

#include "varimap/mesh/topology.h"

namespace varimap {

Subdivision subdivide(const TriangleMesh& mesh) {
    const Edges edges = find_edges(mesh);
    const int before = mesh.vertex_count();
    Subdivision result;
    Points& vertices = result.mesh.vertices;
    vertices.resize(before + edges.size(), 3);
    vertices.topRows(before) = mesh.vertices;
    for (int e = 0; e < edges.size(); ++e) {
        const int half_edge = edges.half_edges[e][0], corner = half_edge % 3;
        result.midpoints.push_back({half_edge / 3, (Vec3::Unit(corner) + Vec3::Unit((corner + 1) % 3)) / 2});
        vertices.row(before + e) = position(mesh, result.midpoints.back()).transpose();
    }
    Faces& faces = result.mesh.faces;
    faces.resize(4 * mesh.face_count(), 3);
    for (int f = 0; f < mesh.face_count(); ++f) {
        const auto midpoint = [&](int k) { return before + edges.of_half_edge[std::size_t(3 * f + k)]; };
        for (int k = 0; k < 3; ++k)
            faces.row(4 * f + k) << mesh.faces(f, k), midpoint(k), midpoint((k + 2) % 3);
        faces.row(4 * f + 3) << midpoint(1), midpoint(2), midpoint(0);
    }
    return result;
}

// The first three of four faces begin at the corners; in the last, each corner lies opposite the corner of
// its number.
SurfacePoint on_subdivision(const SurfacePoint& point) {
    if (point.face < 0) return point;
    const Vec3& b = point.barycentric;
    for (int k = 0; k < 3; ++k)
        if (b[k] >= .5)
            return {4 * point.face + k, Vec3(2 * b[k] - 1, 2 * b[(k + 1) % 3], 2 * b[(k + 2) % 3])};
    return {4 * point.face + 3, Vec3::Ones() - 2 * b};
}

}  // namespace varimap
