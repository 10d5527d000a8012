#include "varimap/mesh/input_locator.h"

#include "varimap/mesh/closest_point.h"

namespace varimap {

struct InputLocator::State {
    const Surface& surface;
    ClosestPoint closest;
};

TriangleMesh normalised_input(const Surface& surface) {
    TriangleMesh mesh = surface.input;
    mesh.vertices = (mesh.vertices.rowwise() - surface.centre.transpose()) * surface.scale;
    return mesh;
}

InputLocator::InputLocator(const Surface& surface)
    : state_(std::make_unique<State>(State{surface, ClosestPoint(normalised_input(surface))})) {}
InputLocator::~InputLocator() = default;

SurfacePoint InputLocator::operator()(const SurfacePoint& on_mesh) const {
    const Surface& surface = state_->surface;
    if (!surface.input_face.empty()) return to_input(surface, on_mesh);
    return (*this)(position(surface.mesh, on_mesh), face_normal(surface.mesh, on_mesh.face));
}

SurfacePoint InputLocator::operator()(const Vec3& x, const Vec3& normal) const {
    return state_->closest(x, normal).point;
}

SurfacePoint MeshLocator::operator()(const SurfacePoint& on_input) const {
    Vec3 x = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
        const SurfacePoint& corner = surface_.on_mesh[std::size_t(surface_.input.faces(on_input.face, k))];
        if (on_input.barycentric[k] == 1) return corner;
        x += on_input.barycentric[k] * position(surface_.mesh, corner);
    }
    return closest_(x).point;
}

}  // namespace varimap
