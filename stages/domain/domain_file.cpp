#include "stages/domain/domain_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "stages/domain/graph_file.h"
#include "stages/domain/point_rows.h"
#include "stages/domain/polyline_file.h"
#include "varimap/core/counted.h"
#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/core/index_set.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_files/mesh_file.h"

namespace varimap {

namespace {

DomainKind kind_by_ending(const std::string& path) {
    if (has_ending(path, ".mtx") || has_ending(path, ".edges")) return DomainKind::graph;
    return has_ending(path, ".obj") ? DomainKind::polyline : DomainKind::points;
}

void require_enough(int points, const std::string& path) {
    if (points < least_points)
        throw InputError(fmt::format("{}: {}; at least {} are needed", path,
                                     counted(points, "point", "points"), least_points));
}

void require_distinct(const Points& points, const std::string& path) {
    std::vector<int> order = all_indices(points.rows());
    const auto key = [&](int i) { return std::tuple(points(i, 0), points(i, 1), points(i, 2), i); };
    std::sort(order.begin(), order.end(), [&](int i, int k) { return key(i) < key(k); });
    for (std::size_t n = 1; n < order.size(); ++n)
        if (points.row(order[n]) == points.row(order[n - 1]))
            throw InputError(fmt::format("{}: points {} and {} (from 0) lie at the same place; leave one out",
                                         path, order[n - 1], order[n]));
}

void measure(DomainFile& file) {
    for (DomainEdge& edge : file.edges)
        edge.length = (file.positions.row(edge.a) - file.positions.row(edge.b)).norm();
    file.measured = true;
}

/// The edges of a mesh as wires.
DomainFile graph_from_mesh(const std::string& path) {
    const TriangleMesh mesh = read_mesh(path);
    require_plain_faces(mesh, path);
    DomainFile file{DomainKind::graph, mesh.vertex_count(), mesh.vertices, {}, false};
    for (const auto& [a, b] : find_edges(mesh).vertices) file.edges.push_back(edge_between(a, b));
    require_distinct(file.positions, path);
    measure(file);
    return file;
}

bool is_mesh(const std::string& path) {
    return has_ending(path, ".off") || has_ending(path, ".ply") || has_ending(path, ".stl") ||
           has_ending(path, ".obj");
}

/// Of a mesh, or of a point cloud in such a file.
Points vertices_of_mesh(const std::string& path) {
    const Points points = read_vertices(path);
    for (int v = 0; v < points.rows(); ++v)
        if (!points.row(v).allFinite())
            throw InputError(fmt::format("{}: point {} (from 0) is not finite", path, v));
    return points;
}

DomainFile read_as(const std::string& path, DomainKind kind) {
    if (kind == DomainKind::graph)
        return is_mesh(path)              ? graph_from_mesh(path)
               : has_ending(path, ".mtx") ? graph_from_matrix_market(path)
                                          : graph_from_rows(path);
    if (kind == DomainKind::polyline)
        return has_ending(path, ".obj") ? polyline_from_obj(path) : polyline_from_rows(path);
    const Points points = read_positions(path);
    return {DomainKind::points, int(points.rows()), points, {}, false};
}

}  // namespace

Points read_positions(const std::string& path) {
    Points points = is_mesh(path) ? vertices_of_mesh(path) : to_points(rows_of_points(path));
    require_distinct(points, path);
    return points;
}

DomainFile read_domain_file(const std::string& path, DomainKind kind) {
    DomainFile file = read_as(path, kind == DomainKind::automatic ? kind_by_ending(path) : kind);
    require_enough(file.count, path);
    if (file.kind == DomainKind::polyline) {
        require_distinct(file.positions, path);
        measure(file);
    }
    return file;
}

}  // namespace varimap
