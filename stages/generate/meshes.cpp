#include "stages/generate/meshes.h"

#include <Eigen/Geometry>
#include <random>

#include "varimap/core/index_set.h"

namespace varimap::shapes {

TriangleMesh make_mesh(const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& faces) {
    TriangleMesh mesh;
    mesh.vertices.resize(points.size(), 3);
    for (std::size_t v = 0; v < points.size(); ++v) mesh.vertices.row(v) = points[v].transpose();
    mesh.faces.resize(faces.size(), 3);
    for (std::size_t f = 0; f < faces.size(); ++f) mesh.faces.row(f) << faces[f][0], faces[f][1], faces[f][2];
    return mesh;
}

TriangleMesh shuffled(const TriangleMesh& mesh, unsigned seed, std::vector<int>* old_vertex) {
    std::mt19937 random(seed);
    const auto permutation = [&](int n) {
        std::vector<int> order = all_indices(n);
        for (int i = n - 1; i > 0; --i) std::swap(order[i], order[random() % unsigned(i + 1)]);
        return order;
    };
    const std::vector<int> vertex = permutation(mesh.vertex_count()), face = permutation(mesh.face_count());
    std::vector<int> renumbered(mesh.vertex_count());
    TriangleMesh result = mesh;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        result.vertices.row(v) = mesh.vertices.row(vertex[v]);
        renumbered[vertex[v]] = v;
    }
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int c = 0; c < 3; ++c) result.faces(f, c) = renumbered[mesh.faces(face[f], c)];
    if (old_vertex) *old_vertex = vertex;
    return result;
}

TriangleMesh moved(TriangleMesh mesh, double scale, double angle, const Vec3& offset) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (int v = 0; v < mesh.vertex_count(); ++v)
        mesh.vertices.row(v) = (scale * (turn * mesh.vertex(v)) + offset).transpose();
    return mesh;
}

}  // namespace varimap::shapes
