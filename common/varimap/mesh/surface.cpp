#include "varimap/mesh/surface.h"

#include <algorithm>

#include "varimap/artifact/cereal_eigen.h"

namespace varimap {

template <class Archive>
void serialize(Archive& archive, TriangleMesh& mesh) {
    archive(mesh.vertices, mesh.faces);
}

template <class Archive>
void serialize(Archive& archive, SurfacePoint& point) {
    archive(point.face, point.barycentric);
}

template <class Archive>
void serialize(Archive& archive, Surface& surface) {
    archive(surface.mesh, surface.mass, surface.input, surface.vertex_of_input, surface.input_face,
            surface.on_input, surface.centre, surface.scale, surface.mirrored);
}

namespace {

void require_valid(bool valid) {
    if (!valid) throw ArtifactError("the parts of a surface contradict each other; rerun varimap-preprocess");
}

void require_below(const int* begin, std::size_t count, int least, int limit) {
    require_valid(std::all_of(begin, begin + count, [&](int i) { return least <= i && i < limit; }));
}

void swap_last_corners(PointMap& points) {
    for (SurfacePoint& point : points) std::swap(point.barycentric[1], point.barycentric[2]);
}

}  // namespace

std::string encode(const Surface& surface) {
    return cereal_encode(surface);
}

void decode(const std::string& payload, Surface& surface) {
    cereal_decode(payload, surface);
    const TriangleMesh &mesh = surface.mesh, &input = surface.input;
    require_valid(surface.mass.size() == mesh.vertex_count());
    require_valid(int(surface.vertex_of_input.size()) == input.vertex_count());
    require_valid(int(surface.input_face.size()) == mesh.face_count());
    require_valid(int(surface.on_input.size()) == mesh.vertex_count());
    require_below(mesh.faces.data(), mesh.faces.size(), 0, mesh.vertex_count());
    require_below(input.faces.data(), input.faces.size(), 0, input.vertex_count());
    require_below(surface.vertex_of_input.data(), surface.vertex_of_input.size(), -1, mesh.vertex_count());
    require_below(surface.input_face.data(), surface.input_face.size(), 0, input.face_count());
    for (const SurfacePoint& point : surface.on_input) require_below(&point.face, 1, 0, input.face_count());
}

Surface with_reversed_orientation(Surface surface) {
    surface.mesh.faces.col(1).swap(surface.mesh.faces.col(2));
    surface.input.faces.col(1).swap(surface.input.faces.col(2));
    swap_last_corners(surface.on_input);
    surface.mirrored = !surface.mirrored;
    return surface;
}

PointMap between_input_and_file(PointMap points, const Surface& surface) {
    if (surface.mirrored) swap_last_corners(points);
    return points;
}

SurfacePoint to_input(const Surface& surface, const SurfacePoint& on_mesh) {
    SurfacePoint result{surface.input_face[on_mesh.face], Vec3::Zero()};
    const auto target = surface.input.faces.row(result.face);
    for (int c = 0; c < 3; ++c) {
        // A corner's own input face may be the one next door; both name the same input vertices, and only
        // those that the faces share have a coordinate other than zero.
        const SurfacePoint& corner = surface.on_input[surface.mesh.faces(on_mesh.face, c)];
        const auto own = surface.input.faces.row(corner.face);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                if (own[i] == target[j])
                    result.barycentric[j] += on_mesh.barycentric[c] * corner.barycentric[i];
    }
    result.barycentric = result.barycentric.cwiseMax(0).cwiseMin(1);
    return result;
}

}  // namespace varimap
