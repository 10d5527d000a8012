#include "varimap/surface/input_locator.h"

#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/interpolation.h"

namespace varimap {

TriangleMesh normalised_input(const Surface& surface) {
    TriangleMesh mesh = surface.input;
    mesh.vertices = (mesh.vertices.rowwise() - surface.centre.transpose()) * surface.scale;
    return mesh;
}

SurfacePoint InputLocator::operator()(const SurfacePoint& on_mesh) const {
    if (!surface_.input_face.empty()) return to_input(surface_, on_mesh);
    return (*this)(position(surface_.mesh, on_mesh), face_normal(surface_.mesh, on_mesh.face));
}

SurfacePoint InputLocator::operator()(const Vec3& x, const Vec3& normal, int guess) const {
    return (*closest_)(x, normal, guess).point;
}

SurfacePoint MeshLocator::operator()(const SurfacePoint& on_input) const {
    Vec3 x = Vec3::Zero();
    for (const auto [vertex, weight] : WeightedCorners(surface_.input, on_input)) {
        const SurfacePoint& corner = surface_.on_mesh[std::size_t(vertex)];
        if (weight == 1) return corner;
        x += weight * position(surface_.mesh, corner);
    }
    return (*closest_)(x).point;
}

int nearest_in_file(const Surface& surface, int vertex) {
    return number_in_file(nearest_vertex(surface.input, surface.on_input[std::size_t(vertex)]), surface.link);
}

}  // namespace varimap
