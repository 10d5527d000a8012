#pragma once

#include <cmath>
#include <map>

#include "common/mesh/surface.h"

namespace varimap::testing {

/// The rectangle [0, width] x [0, height] in the plane z = 0, n x n squares cut into two triangles each.
inline TriangleMesh rectangle(int n, double width, double height) {
    TriangleMesh mesh{Points((n + 1) * (n + 1), 3), Faces(2 * n * n, 3)};
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) mesh.vertices.row(i * (n + 1) + j) << width * i / n, height * j / n, 0;
    for (int i = 0, f = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j, b = a + n + 1;
            mesh.faces.row(f++) << a, b, b + 1;
            mesh.faces.row(f++) << a, b + 1, a + 1;
        }
    return mesh;
}

/// The unit sphere: an octahedron, its edges cut into n, projected. Symmetric under change of each sign.
inline TriangleMesh sphere(int n) {
    std::map<std::array<int, 3>, int> index;
    std::vector<std::array<int, 3>> faces;
    const auto vertex = [&](std::array<int, 3> p) {
        return index.try_emplace(p, int(index.size())).first->second;
    };
    for (int octant = 0; octant < 8; ++octant) {
        const std::array<int, 3> sign{octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
        const bool mirrored = sign[0] * sign[1] * sign[2] < 0;
        const auto add = [&](std::array<int, 3> a, std::array<int, 3> b, std::array<int, 3> c) {
            for (auto* p : {&a, &b, &c})
                for (int k = 0; k < 3; ++k) (*p)[k] *= sign[k];
            if (mirrored) std::swap(b, c);
            faces.push_back({vertex(a), vertex(b), vertex(c)});
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                const int k = n - i - j;
                add({i, j, k}, {i + 1, j, k - 1}, {i, j + 1, k - 1});
                if (k > 1) add({i + 1, j, k - 1}, {i + 1, j + 1, k - 2}, {i, j + 1, k - 1});
            }
    }
    TriangleMesh mesh{Points(int(index.size()), 3), Faces(int(faces.size()), 3)};
    for (const auto& [p, v] : index) mesh.vertices.row(v) = Vec3(p[0], p[1], p[2]).normalized().transpose();
    for (std::size_t f = 0; f < faces.size(); ++f)
        mesh.faces.row(int(f)) << faces[f][0], faces[f][1], faces[f][2];
    return mesh;
}

/// Each vertex as a point on one of its faces.
inline PointMap at_vertices(const TriangleMesh& mesh) {
    PointMap map(std::size_t(mesh.vertex_count()));
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k) map[std::size_t(mesh.faces(f, k))] = {f, Vec3::Unit(k)};
    return map;
}

/// A surface whose mesh is its input.
inline Surface plain_surface(const TriangleMesh& mesh) {
    Surface surface;
    surface.mesh = surface.input = mesh;
    surface.mass = Eigen::VectorXd::Constant(mesh.vertex_count(), 1.0 / mesh.vertex_count());
    surface.on_input = at_vertices(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v) surface.vertex_of_input.push_back(v);
    for (int f = 0; f < mesh.face_count(); ++f) surface.input_face.push_back(f);
    return surface;
}

}  // namespace varimap::testing
