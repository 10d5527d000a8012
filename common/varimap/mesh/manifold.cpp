#include "varimap/mesh/manifold.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "varimap/core/error.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

/// Counts the elements with a defect and remembers the first.
struct Defect {
    int count = 0;
    int first = -1;
    void add(int element) {
        if (count++ == 0) first = element;
    }
};

void refuse_unknown_vertices(const TriangleMesh& mesh, const std::string& path) {
    Defect defect;
    for (int c = 0; c < 3 * mesh.face_count(); ++c)
        if (const int v = mesh.faces.data()[c]; v < 0 || v >= mesh.vertex_count()) defect.add(c);
    if (defect.count > 0)
        throw InputError(fmt::format(
            "{}: {} corners of faces name no vertex, the first is one of face {}: vertex {} of {}, counted "
            "from 0",
            path, defect.count, defect.first / 3, mesh.faces.data()[defect.first], mesh.vertex_count()));
}

void refuse_not_finite(const TriangleMesh& mesh, const std::string& path) {
    Defect defect;
    for (int f = 0; f < mesh.face_count(); ++f)
        if (!mesh.vertices(mesh.faces.row(f), Eigen::all).allFinite()) defect.add(f);
    if (defect.count > 0)
        throw InputError(fmt::format(
            "{}: {} faces have a corner with a coordinate that is not finite, the first is face {}", path,
            defect.count, defect.first));
}

void refuse_degenerate_faces(const TriangleMesh& mesh, const std::string& path) {
    Defect defect;
    for (int f = 0; f < mesh.face_count(); ++f)
        if (repeats_vertex(mesh.faces, f)) defect.add(f);
    if (defect.count > 0)
        throw InputError(fmt::format("{}: {} faces name a vertex twice, the first is face {}; remove them",
                                     path, defect.count, defect.first));
}

void refuse_crowded_edges(const Edges& edges, const std::string& path) {
    Defect defect;
    for (int e = 0; e < edges.size(); ++e)
        if (edges.half_edges[e].size() > 2) defect.add(e);
    if (defect.count == 0) return;
    const auto [a, b] = edges.vertices[defect.first];
    throw InputError(
        fmt::format("{}: {} edges belong to three or more faces, the first joins vertices {} and {}; "
                    "separate the sheets that meet there",
                    path, defect.count, a, b));
}

/// Two faces agree when they run through their common edge in opposite directions.
void refuse_inconsistent_orientation(const TriangleMesh& mesh, const Edges& edges, const std::string& path) {
    Defect defect;
    for (int e = 0; e < edges.size(); ++e) {
        const auto half_edges = edges.half_edges[e];
        const auto start = [&](int s) { return mesh.faces(s / 3, s % 3); };
        if (half_edges.size() == 2 && start(half_edges[0]) == start(half_edges[1])) defect.add(e);
    }
    if (defect.count == 0) return;
    const auto [a, b] = edges.vertices[defect.first];
    throw InputError(fmt::format(
        "{}: {} edges lie between faces of opposite orientation, the first joins vertices {} and {}; "
        "orient the faces consistently (a one-sided surface cannot be served)",
        path, defect.count, a, b));
}

/// Edges have one or two half-edges, and those run in opposite directions.
void refuse_pinched_vertices(const TriangleMesh& mesh, const Edges& edges, const std::string& path) {
    const VertexData<int> fans = count_fans(mesh, edges, FaceData<char>(mesh.face_count(), 1));
    Defect defect;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (fans[v] > 1) defect.add(v);
    if (defect.count > 0)
        throw InputError(
            fmt::format("{}: at {} vertices the faces form more than one fan, the first is vertex {}; "
                        "give each fan its own vertex",
                        path, defect.count, defect.first));
}

}  // namespace

void require_connected(const TriangleMesh& mesh, const std::string& path) {
    const ConnectedComponents components = connected_components(mesh);
    if (components.count < 2) return;
    const std::vector<int>& of_vertex = components.of_vertex;
    const auto second = std::find(of_vertex.begin(), of_vertex.end(), 1) - of_vertex.begin();
    throw InputError(
        fmt::format("{}: the surface has {} components, the second starts at vertex {}; keep one", path,
                    components.count, second));
}

/// Within these sizes no product of lengths that the method needs leaves the range of double precision.
void require_size(const TriangleMesh& mesh, const std::string& path) {
    constexpr double least = 1e-50, largest = 1e50;
    const auto [low, high] = bounding_box(mesh);
    const double size = (high - low).maxCoeff();
    if (size == 0) throw InputError(path + ": the surface has no area (its points are all the same)");
    if (!(least < size && size < largest))
        throw InputError(fmt::format("{}: the surface is {:.2g} long, outside {} to {}; scale it", path, size,
                                     least, largest));
    if (!(surface_area(mesh) > 0))
        throw InputError(path + ": the surface has no area (are its points all on one line?)");
}

void require_corners(const TriangleMesh& mesh, const std::string& path) {
    if (mesh.face_count() == 0) throw InputError(path + ": the mesh has no faces");
    refuse_unknown_vertices(mesh, path);
}

void require_plain_faces(const TriangleMesh& mesh, const std::string& path) {
    require_corners(mesh, path);
    refuse_not_finite(mesh, path);
    refuse_degenerate_faces(mesh, path);
}

void require_sheets(const TriangleMesh& mesh, const std::string& path) {
    require_plain_faces(mesh, path);
    const Edges edges = find_edges(mesh);
    refuse_crowded_edges(edges, path);
    refuse_inconsistent_orientation(mesh, edges, path);
    refuse_pinched_vertices(mesh, edges, path);
    require_size(mesh, path);
}

void require_manifold(const TriangleMesh& mesh, const std::string& path) {
    require_sheets(mesh, path);
    require_connected(mesh, path);
}

}  // namespace varimap
