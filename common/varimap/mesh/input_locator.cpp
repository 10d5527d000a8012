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

}  // namespace varimap
