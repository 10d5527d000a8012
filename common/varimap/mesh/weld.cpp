#include "varimap/mesh/weld.h"

#include <array>
#include <cmath>
#include <map>

#include "varimap/mesh/private/disjoint_sets.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

using Cell = std::array<double, 3>;

std::vector<int> boundary_vertices(const TriangleMesh& mesh) {
    const Edges edges = find_edges(mesh);
    std::vector<char> on_boundary(std::size_t(mesh.vertex_count()), 0);
    for (int e = 0; e < edges.size(); ++e)
        if (edges.sides[e].size() == 1)
            for (const int v : edges.vertices[std::size_t(e)]) on_boundary[std::size_t(v)] = 1;
    std::vector<int> result;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (on_boundary[std::size_t(v)]) result.push_back(v);
    return result;
}

/// Cells of the tolerance's size, or the place itself. -0 is 0.
Cell cell_of(const Vec3& x, double size) {
    Cell cell;
    for (int k = 0; k < 3; ++k) cell[std::size_t(k)] = (size > 0 ? std::floor(x[k] / size) : x[k]) + 0.0;
    return cell;
}

std::vector<Cell> cells_around(const Cell& cell, bool only_itself) {
    if (only_itself) return {cell};
    std::vector<Cell> around;
    for (int i = 0; i < 27; ++i)
        around.push_back({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + double(i / 9) - 1});
    return around;
}

}  // namespace

std::vector<int> weld_boundaries(const TriangleMesh& mesh, double tolerance) {
    DisjointSets sets(mesh.vertex_count());
    std::map<Cell, std::vector<int>> in_cell;
    for (const int v : boundary_vertices(mesh)) {
        const Cell cell = cell_of(mesh.vertex(v), tolerance);
        for (const Cell& near : cells_around(cell, tolerance == 0)) {
            const auto found = in_cell.find(near);
            if (found == in_cell.end()) continue;
            for (const int other : found->second)
                if ((mesh.vertex(v) - mesh.vertex(other)).norm() <= tolerance) sets.join(v, other);
        }
        in_cell[cell].push_back(v);
    }
    std::vector<int> result;
    for (int v = 0; v < mesh.vertex_count(); ++v) result.push_back(sets.lowest(v));
    return result;
}

}  // namespace varimap
