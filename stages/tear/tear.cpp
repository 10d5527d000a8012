#include "stages/tear/tear.h"

#include <algorithm>

#include "varimap/core/index_set.h"
#include "varimap/core/parallel.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh/unit_area.h"
#include "varimap/verification/verification.h"

namespace varimap {

namespace {

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

/// Of the faces f with is_marked(f).
template <class Predicate>
double area_percent(const TriangleMesh& mesh, const Predicate& is_marked) {
    double area = 0;
    for (int f = 0; f < mesh.face_count(); ++f)
        if (is_marked(f)) area += face_normal(mesh, f).norm() / 2;
    return 100 * area;
}

}  // namespace

TearReport find_tear(const TriangleMesh& source_mesh, const TriangleMesh& target_mesh, const PointMap& there,
                     const PointMap& back, const TearOptions& options) {
    const TriangleMesh source = unit_area(source_mesh), target = unit_area(target_mesh);
    const Points images = positions(target, there);
    TearReport report;
    const auto edges = find_edges(source).vertices;
    const auto stretch_of = [&](int a, int b) {
        return (images.row(a) - images.row(b)).norm() /
               (source.vertices.row(a) - source.vertices.row(b)).norm();
    };
    // An edge without length is torn where its ends' images lie apart.
    const auto is_torn = [&](int a, int b) { return stretch_of(a, b) > options.stretch; };
    std::vector<int> torn;
    for (const auto& [a, b] : edges)
        if (is_torn(a, b)) {
            ++report.torn_edges;
            torn.insert(torn.end(), {a, b});
        }
    make_set(torn);
    const std::vector<char> near = near_to(torn, source, options.distance);
    const auto is_near = [&](int v) { return near[std::size_t(v)] != 0; };
    const auto touches_near = [&](const auto& corners) {
        return is_near(corners[0]) || is_near(corners[1]) || is_near(corners[2]);
    };
    report.torn_area_percent = area_percent(source, [&](int f) {
        const auto c = source.faces.row(f);
        return is_torn(c[0], c[1]) || is_torn(c[1], c[2]) || is_torn(c[2], c[0]);
    });
    report.near_area_percent = area_percent(source, [&](int f) { return touches_near(source.faces.row(f)); });
    for (const auto& [a, b] : edges)
        if (!is_near(a) && !is_near(b))
            report.largest_stretch = std::max(report.largest_stretch, stretch_of(a, b));
    for (const int f : verify_map(there, source, target).reversed_faces)
        report.reversed_elsewhere += !touches_near(source.faces.row(f));
    const Points there_again = pulled_back(images, source, back);
    int elsewhere = 0, returned = 0;
    for (int v = 0; v < target.vertex_count(); ++v) {
        if (touches_near(source.faces.row(back[std::size_t(v)].face))) continue;
        ++elsewhere;
        returned += (there_again.row(v) - target.vertices.row(v)).norm() < options.distance;
    }
    report.returned_percent = elsewhere > 0 ? 100.0 * returned / elsewhere : 0;
    return report;
}

}  // namespace varimap
