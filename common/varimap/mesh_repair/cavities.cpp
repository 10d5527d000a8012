#include "varimap/mesh_repair/cavities.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "varimap/mesh/boundary.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/ray_mesh.h"

namespace varimap {
namespace {

/// A closed component, or nearly.
struct Body {
    int component;
    TriangleMesh mesh;
    double volume;  ///< negative where its faces look inward
    Eigen::AlignedBox3d box;
    std::unique_ptr<const RayMesh> rays{};  ///< built when first asked
};

/// Degenerate faces that were dropped leave pinholes. Most of their length (boundary_length).
constexpr double pinholes = .1;

/// By falling volume.
std::vector<Body> closed_components(const TriangleMesh& mesh, const ConnectedComponents& components,
                                    const std::vector<char>& candidates) {
    std::vector<Body> bodies;
    const std::vector<std::vector<int>> faces = components.faces();
    for (int c = 0; c < components.count; ++c) {
        if (!candidates[std::size_t(c)]) continue;
        const UsedVertices used =
            used_vertices(mesh.faces(faces[std::size_t(c)], Eigen::all), mesh.vertex_count());
        TriangleMesh part{mesh.vertices(used.vertex, Eigen::all), used.faces};
        if (boundary_length(part) > pinholes) continue;
        const Eigen::AlignedBox3d box(part.vertices.colwise().minCoeff().transpose(),
                                      part.vertices.colwise().maxCoeff().transpose());
        const double volume = signed_volume_when_closed(part);
        bodies.push_back({c, std::move(part), volume, box});
    }
    std::stable_sort(bodies.begin(), bodies.end(),
                     [](const Body& a, const Body& b) { return std::abs(a.volume) > std::abs(b.volume); });
    return bodies;
}

/// Whether a ray from there passes through the surface from its inside, first of all. Rays that meet edges
/// may miss, so that most of three decide.
bool is_inside(const Vec3& point, const Body& body) {
    static const std::array directions{Vec3(.36, .48, .8), Vec3(-.64, .6, -.48), Vec3(.28, -.936, -.21)};
    int leaving = 0;
    for (const Vec3& direction : directions) {
        const int face = body.rays->first_hit(point, direction).face;
        if (face >= 0) leaving += face_normal(body.mesh, face).dot(direction) * body.volume > 0;
    }
    return leaving >= 2;
}

/// Share of the area. Where limbs are thin, or surfaces noisy, a wall comes through the one around it: that
/// of a hollowed person at fingers and ears, with .5 to 4%.
constexpr double most_outside = .1;

bool is_inside(const Body& inner, Body& outer) {
    if (!outer.box.intersects(inner.box)) return false;
    if (!outer.rays) outer.rays = std::make_unique<const RayMesh>(outer.mesh);
    const Eigen::VectorXd share = voronoi_masses(inner.mesh);
    double outside = 0;
    for (int v = 0; v < inner.mesh.vertex_count() && outside <= most_outside; ++v)
        if (!is_inside(inner.mesh.vertex(v), outer)) outside += share[v];
    return outside <= most_outside;
}

/// Moved and scaled to where rays are precise.
TriangleMesh at_unit_size(const TriangleMesh& mesh) {
    const Eigen::RowVector3d low = mesh.vertices.colwise().minCoeff(),
                             high = mesh.vertices.colwise().maxCoeff();
    return {(mesh.vertices.rowwise() - (low + high) / 2) / (high - low).norm(), mesh.faces};
}

}  // namespace

std::vector<char> find_cavities(const TriangleMesh& mesh, const ConnectedComponents& components,
                                const std::vector<char>& candidates) {
    std::vector<char> cavities(candidates.size(), 0);
    if (std::count(candidates.begin(), candidates.end(), 1) < 2) return cavities;
    std::vector<Body> bodies = closed_components(at_unit_size(mesh), components, candidates);
    for (auto inner = bodies.begin(); inner != bodies.end(); ++inner) {
        const auto around =
            std::find_if(bodies.begin(), inner, [&](Body& outer) { return is_inside(*inner, outer); });
        if (around != inner && around->volume * inner->volume < 0)
            cavities[std::size_t(inner->component)] = 1;
    }
    return cavities;
}

}  // namespace varimap
