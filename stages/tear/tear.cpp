#include "stages/tear/tear.h"

#include <algorithm>
#include <cmath>

#include "varimap/core/parallel.h"
#include "varimap/mesh/pulled_back.h"
#include "varimap/mesh/topology.h"
#include "varimap/verification/verification.h"

namespace varimap {

namespace {

TriangleMesh of_unit_area(TriangleMesh mesh) {
    mesh.vertices /= std::sqrt(surface_area(mesh));
    return mesh;
}

/// Per vertex: whether an end of a torn edge is nearer than `distance`.
std::vector<char> near_to(const std::vector<int>& torn, const TriangleMesh& mesh, double distance) {
    std::vector<char> near(std::size_t(mesh.vertex_count()), 0);
    parallel_for_each_index(mesh.vertex_count(), 256, [&](int v) {
        near[std::size_t(v)] = std::any_of(torn.begin(), torn.end(), [&](int t) {
            return (mesh.vertices.row(v) - mesh.vertices.row(t)).squaredNorm() < distance * distance;
        });
    });
    return near;
}

double area_percent(const TriangleMesh& mesh, const std::vector<char>& marked) {
    double area = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const auto has = [&](int c) { return marked[std::size_t(mesh.faces(f, c))] != 0; };
        if (has(0) || has(1) || has(2)) area += face_normal(mesh, f).norm() / 2;
    }
    return 100 * area;
}

}  // namespace

TearReport find_tear(const TriangleMesh& source_mesh, const TriangleMesh& target_mesh, const PointMap& there,
                     const PointMap& back, const TearOptions& options) {
    const TriangleMesh source = of_unit_area(source_mesh), target = of_unit_area(target_mesh);
    const Points images = pulled_back(target.vertices, target, there);
    TearReport report;
    const auto edges = find_edges(source).vertices;
    const auto stretch_of = [&](int a, int b) {
        return (images.row(a) - images.row(b)).norm() /
               (source.vertices.row(a) - source.vertices.row(b)).norm();
    };
    std::vector<int> torn;
    std::vector<char> is_torn(std::size_t(source.vertex_count()), 0);
    for (const auto& [a, b] : edges)
        if (stretch_of(a, b) > options.stretch) {
            ++report.torn_edges;
            for (const int end : {a, b})
                if (!is_torn[std::size_t(end)]) is_torn[std::size_t(end)] = 1, torn.push_back(end);
        }
    const std::vector<char> near = near_to(torn, source, options.distance);
    report.torn_area_percent = area_percent(source, is_torn);
    report.near_area_percent = area_percent(source, near);
    const auto is_near = [&](int v) { return near[std::size_t(v)] != 0; };
    for (const auto& [a, b] : edges)
        if (!is_near(a) && !is_near(b))
            report.largest_stretch = std::max(report.largest_stretch, stretch_of(a, b));
    for (const int f : verify_map(there, source, target).reversed_faces)
        report.reversed_elsewhere +=
            !is_near(source.faces(f, 0)) && !is_near(source.faces(f, 1)) && !is_near(source.faces(f, 2));
    const Points there_again = pulled_back(images, source, back);
    int elsewhere = 0, returned = 0;
    for (int v = 0; v < target.vertex_count(); ++v) {
        const auto corners = source.faces.row(back[std::size_t(v)].face);
        if (is_near(corners[0]) || is_near(corners[1]) || is_near(corners[2])) continue;
        ++elsewhere;
        returned += (there_again.row(v) - target.vertices.row(v)).norm() < options.distance;
    }
    report.returned_percent = elsewhere > 0 ? 100.0 * returned / elsewhere : 0;
    return report;
}

}  // namespace varimap
