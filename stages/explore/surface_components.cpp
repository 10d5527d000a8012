#include "stages/explore/surface_components.h"

#include <algorithm>
#include <cmath>

#include "varimap/core/rotation.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/topology.h"

namespace varimap {

// Numbers in this file were chosen by hand.

namespace {

/// Per vertex of the mesh, all 0 where nothing was joined; -1 on a bridge.
std::vector<int> component_of_each_vertex(const Surface& surface) {
    std::vector<int> of(std::size_t(surface.mesh.vertex_count()), 0);
    const std::vector<int>& file_face = surface.link.face;
    if (!has_added_faces(surface) || is_cut_out(surface)) return of;
    const std::vector<int> of_input = connected_components(without_added_faces(surface)).of_vertex;
    for (std::size_t v = 0; v < of.size(); ++v) {
        const SurfacePoint& at = surface.on_input[v];
        const bool is_added = file_face[std::size_t(at.face)] < 0 && at.barycentric.maxCoeff() < 1;
        of[v] = is_added ? -1 : of_input[std::size_t(nearest_vertex(surface.input, at))];
    }
    return of;
}

}  // namespace

SurfaceComponents::SurfaceComponents(const Surface& surface)
    : surface_(surface), of_(component_of_each_vertex(surface)) {
    const auto count = std::size_t(*std::max_element(of_.begin(), of_.end()) + 1);
    vertices_.resize(count);
    areas_.resize(count);
    for (int v = 0; v < mesh().vertex_count(); ++v) {
        if (of_[std::size_t(v)] < 0) continue;
        const auto component = std::size_t(of_[std::size_t(v)]);
        vertices_[component].push_back(v);
        areas_[component] += surface.mass[v];
    }
}

bool SurfaceComponents::are_several() const {
    constexpr double matters = 0.05;
    return std::count_if(areas_.begin(), areas_.end(), [](double area) { return area >= matters; }) > 1;
}

bool SurfaceComponents::can_be_laid(int component) const {
    constexpr std::size_t enough = 8;
    return vertices(component).size() >= enough && !faces(component).empty();
}

int SurfaceComponents::largest() const {
    return int(std::max_element(areas_.begin(), areas_.end()) - areas_.begin());
}

std::optional<int> SurfaceComponents::of(int vertex) const {
    const int component = of_[std::size_t(vertex)];
    return component < 0 ? std::nullopt : std::optional(component);
}

std::vector<int> SurfaceComponents::faces(int component) const {
    std::vector<int> own;
    for (int f = 0; f < mesh().face_count(); ++f) {
        const auto corners = mesh().faces.row(f);
        if (std::all_of(corners.begin(), corners.end(), [&](int v) { return holds(component, v); }))
            own.push_back(f);
    }
    return own;
}

bool SurfaceComponents::holds_any(int component, const std::vector<int>& of_vertices) const {
    return std::any_of(of_vertices.begin(), of_vertices.end(), [&](int v) { return holds(component, v); });
}

Vec3 SurfaceComponents::mean(int component, const Points& points) const {
    Vec3 sum = Vec3::Zero();
    for (const int v : vertices(component)) sum += surface_.mass[v] * points.row(v).transpose();
    return sum / area(component);
}

Eigen::Matrix3d SurfaceComponents::turn(int component, const Points& images, bool mirrored) const {
    const std::vector<int>& own = vertices(component);
    const Points here = mesh().vertices(own, Eigen::all), there = images(own, Eigen::all);
    return nearest_rotation(here, there, surface_.mass(own), mirrored);
}

std::optional<int> SurfaceComponents::partner(int component, const PointMap& map,
                                              const SurfaceComponents& to) const {
    constexpr double most = 0.7;
    std::vector<double> shares(to.areas_.size());
    for (const int v : vertices(component)) {
        const int image = to.of_[std::size_t(nearest_vertex(to.mesh(), map[std::size_t(v)]))];
        if (image >= 0) shares[std::size_t(image)] += surface_.mass[v];
    }
    const auto best = std::max_element(shares.begin(), shares.end());
    if (*best < most * area(component)) return {};
    return int(best - shares.begin());
}

ComponentLaying::ComponentLaying(const SurfaceComponents& from, const SurfaceComponents& to, bool opposed)
    : from_(from), to_(to), normals_(vertex_normals(from.mesh()) * (opposed ? -1 : 1)) {}

void ComponentLaying::lay(PointMap& map, int component, int onto, const Eigen::Matrix3d& turn) const {
    const std::vector<int> faces = to_.faces(onto);
    const TriangleMesh& mesh = to_.mesh();
    const ClosestPoint closest(TriangleMesh{mesh.vertices, mesh.faces(faces, Eigen::all)});
    const Vec3 here = from_.mean(component, from_.mesh().vertices), there = to_.mean(onto, mesh.vertices);
    const double scale = std::sqrt(to_.area(onto) / from_.area(component));
    for (const int v : from_.vertices(component)) {
        const Vec3 place = there + scale * (turn * (from_.mesh().vertex(v) - here));
        SurfacePoint& image = map[std::size_t(v)];
        image = closest(place, turn * normals_.row(v).transpose()).point;
        image.face = faces[std::size_t(image.face)];
    }
}

}  // namespace varimap
