#include "varimap/surface/surface.h"

#include <algorithm>

#include "varimap/mesh/boundary.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/serialization.h"
#include "varimap/mesh/topology.h"
#include "varimap/surface/surface_check.h"

namespace varimap {

template <class Archive>
void serialize(Archive& archive, TriangleMesh& mesh) {
    archive(mesh.vertices, mesh.faces);
}

template <class Archive>
void serialize(Archive& archive, FileLink& link) {
    archive(link.file, link.vertex, link.fate, link.origin, link.face, link.turned);
}

template <class Archive>
void serialize(Archive& archive, Surface& surface) {
    archive(surface.mesh, surface.mass, surface.input, surface.input.space, surface.link, surface.on_mesh,
            surface.input_face, surface.on_input, surface.centre, surface.scale, surface.mirrored);
}

namespace {

void swap_last_corners(Faces& faces) {
    faces.col(1).swap(faces.col(2));
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
    require_complete(surface);
}

Surface with_reversed_orientation(Surface surface) {
    swap_last_corners(surface.mesh.faces);
    swap_last_corners(surface.input.faces);
    swap_last_corners(surface.on_input);
    swap_last_corners(surface.on_mesh);
    surface.mirrored = !surface.mirrored;
    return surface;
}

TriangleMesh input_as_read(const Surface& surface) {
    TriangleMesh mesh = surface.input;
    if (surface.mirrored) swap_last_corners(mesh.faces);
    return mesh;
}

PointMap to_file(PointMap map, const Surface& source, const Surface& target) {
    if (target.mirrored) swap_last_corners(map);
    return to_file(map, source.link, target.link, input_as_read(target));
}

PointMap from_file(const PointMap& map, const Surface& source, const Surface& target) {
    PointMap result = from_file(map, source.link, target.link);
    if (target.mirrored) swap_last_corners(result);
    return result;
}

const TriangleMesh& file_of(const Surface& surface) {
    return surface.link.is_identity() ? surface.input : surface.link.file;
}

bool is_cut_out(const Surface& surface) {
    const std::vector<VertexFate>& fate = surface.link.fate;
    return std::find(fate.begin(), fate.end(), VertexFate::outside_part) != fate.end();
}

bool one_is_inside_out(const Surface& A, const Surface& B) {
    if (!A.is_surface() || !B.is_surface() || A.mirrored || B.mirrored) return false;
    return orientation_sign(A.mesh) * orientation_sign(B.mesh) < 0;
}

Vec3 barycentric_on(const TriangleMesh& mesh, int face, const SurfacePoint& point) {
    const auto other = mesh.faces.row(face);
    Vec3 result = Vec3::Zero();
    for (const auto [vertex, weight] : WeightedCorners(mesh, point)) {
        const auto at = std::find(other.begin(), other.end(), vertex);
        if (at == other.end())
            return closest_barycentric(position(mesh, point), mesh.vertex(other[0]), mesh.vertex(other[1]),
                                       mesh.vertex(other[2]));
        result[at - other.begin()] += weight;
    }
    return result;
}

SurfacePoint to_input(const Surface& surface, const SurfacePoint& on_mesh) {
    SurfacePoint result{surface.input_face[on_mesh.face], Vec3::Zero()};
    for (const auto [vertex, weight] : WeightedCorners(surface.mesh, on_mesh))
        // A corner's own input face may be the one next door.
        result.barycentric += weight * barycentric_on(surface.input, result.face, surface.on_input[vertex]);
    result.barycentric = result.barycentric.cwiseMax(0).cwiseMin(1);
    return result;
}

bool has_added_faces(const Surface& surface) {
    return std::ranges::any_of(surface.link.face, [](int in_file) { return in_file < 0; });
}

TriangleMesh without_added_faces(const Surface& surface) {
    if (!has_added_faces(surface)) return surface.input;
    std::vector<int> left;
    for (int f = 0; f < int(surface.link.face.size()); ++f)
        if (surface.link.face[std::size_t(f)] >= 0) left.push_back(f);
    return {surface.input.vertices, surface.input.faces(left, Eigen::all), surface.input.space};
}

}  // namespace varimap
