#include "varimap/mesh_repair/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "varimap/mesh/disjoint_sets.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

constexpr double share_of_edges = 0.01;

using Place = std::array<double, 3>;

/// -0 is 0.
Place place_of(const Vec3& x) {
    return {x[0] + 0.0, x[1] + 0.0, x[2] + 0.0};
}

/// Cells of a grid whose size is a power of two.
struct Cell {
    int level;
    Place corner;
    auto operator<=>(const Cell&) const = default;
};

Cell cell_of(const Vec3& x, int level) {
    return {level, place_of((x / std::ldexp(1., level)).array().floor())};
}

std::vector<Cell> cells_around(const Cell& cell) {
    std::vector<Cell> around;
    for (int i = 0; i < 27; ++i)
        around.push_back({cell.level,
                          {cell.corner[0] + i % 3 - 1, cell.corner[1] + i / 3 % 3 - 1,
                           cell.corner[2] + double(i / 9) - 1}});
    return around;
}

class Welding {
  public:
    explicit Welding(const TriangleMesh& mesh) : mesh_(mesh), sets_(mesh.vertex_count()) {}
    std::vector<int> run(double tolerance);

  private:
    std::vector<int> places() const;
    void join_copies();
    bool join_same_places();
    void join_near(double tolerance);
    TriangleMesh joined();
    std::vector<double> shortest_boundary_edges();

    const TriangleMesh& mesh_;
    DisjointSets sets_;
    bool has_copies_ = false;
};

/// Per vertex that a face uses: the lowest such vertex in the same place.
std::vector<int> Welding::places() const {
    std::map<Place, int> first;
    std::vector<int> place(std::size_t(mesh_.vertex_count()), -1);
    for (const int v : mesh_.faces.reshaped()) place[std::size_t(v)] = v;
    for (int v = 0; v < mesh_.vertex_count(); ++v)
        if (place[std::size_t(v)] >= 0)
            place[std::size_t(v)] = first.emplace(place_of(mesh_.vertex(v)), v).first->second;
    return place;
}

/// Of faces in the same place the one of the lowest component is what the others are copies of.
void Welding::join_copies() {
    const ConnectedComponents components = connected_components(mesh_);
    if (components.count < 2) return;
    const std::vector<int> place = places();
    const auto component_of = [&](int f) { return components.of_face[std::size_t(f)]; };
    std::map<std::array<int, 3>, std::vector<int>> at;
    for (int f = 0; f < mesh_.face_count(); ++f) {
        std::array<int, 3> corners;
        for (int k = 0; k < 3; ++k) corners[std::size_t(k)] = place[std::size_t(mesh_.faces(f, k))];
        std::sort(corners.begin(), corners.end());
        at[corners].push_back(f);
    }
    std::vector<char> is_copy(std::size_t(components.count), 1);
    for (auto& [corners, faces] : at) {
        std::stable_sort(faces.begin(), faces.end(),
                         [&](int f, int g) { return component_of(f) < component_of(g); });
        is_copy[std::size_t(component_of(faces[0]))] = 0;
    }
    has_copies_ = std::find(is_copy.begin(), is_copy.end(), 1) != is_copy.end();
    if (!has_copies_) return;
    for (const auto& [corners, faces] : at)
        for (const int f : faces)
            for (int k = 0; k < 3 && is_copy[std::size_t(component_of(f))]; ++k)
                for (const int original : mesh_.faces.row(faces[0]))
                    if (place[std::size_t(original)] == place[std::size_t(mesh_.faces(f, k))])
                        sets_.join(original, mesh_.faces(f, k));
}

/// The mesh as it is with what was joined so far, without the faces that are none any more, and of copies
/// without all but one: between these there is no boundary.
TriangleMesh Welding::joined() {
    TriangleMesh mesh{mesh_.vertices, mesh_.faces.unaryExpr([&](int v) { return sets_.lowest(v); })};
    std::set<std::array<int, 3>> known;
    std::vector<int> left;
    for (int f = 0; f < mesh.face_count(); ++f) {
        std::array<int, 3> corners{mesh.faces(f, 0), mesh.faces(f, 1), mesh.faces(f, 2)};
        std::sort(corners.begin(), corners.end());
        if (corners[0] == corners[1] || corners[1] == corners[2]) continue;
        if (!has_copies_ || known.insert(corners).second) left.push_back(f);
    }
    mesh.faces = mesh.faces(left, Eigen::all).eval();
    return mesh;
}

/// Per vertex that stands for itself and its like: the shortest of the boundary edges there; none: 0.
std::vector<double> Welding::shortest_boundary_edges() {
    const Edges edges = find_edges(joined());
    std::vector<double> shortest(std::size_t(mesh_.vertex_count()), 0);
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.half_edges[e].size() != 1) continue;
        const auto [a, b] = edges.vertices[std::size_t(e)];
        // Edges without length say nothing, and are no longer than any.
        const double length = std::max((mesh_.vertex(a) - mesh_.vertex(b)).norm(),
                                       std::numeric_limits<double>::min() / share_of_edges);
        for (const int v : {a, b}) {
            double& own = shortest[std::size_t(v)];
            own = own > 0 ? std::min(own, length) : length;
        }
    }
    return shortest;
}

/// False where there is no boundary.
bool Welding::join_same_places() {
    std::map<Place, int> first;
    const std::vector<double> shortest = shortest_boundary_edges();
    for (int v = 0; v < mesh_.vertex_count(); ++v)
        if (shortest[std::size_t(v)] > 0)
            sets_.join(first.emplace(place_of(mesh_.vertex(v)), v).first->second, v);
    return !first.empty();
}

/// Those that reach farther first: the cells of each level then hold vertices that reach about as far as they
/// are wide, and are few.
void Welding::join_near(double tolerance) {
    std::vector<double> reach = shortest_boundary_edges();
    std::vector<int> order;
    for (int v = 0; v < mesh_.vertex_count(); ++v) {
        double& own = reach[std::size_t(v)];
        if (own == 0) continue;
        own = tolerance > 0 ? tolerance : share_of_edges * own;
        order.push_back(v);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return reach[std::size_t(a)] > reach[std::size_t(b)]; });
    std::map<Cell, std::vector<int>> in_cell;
    std::set<int> levels;
    for (const int v : order) {
        const double own = reach[std::size_t(v)];
        const Vec3 x = mesh_.vertex(v);
        for (const int level : levels)
            for (const Cell& cell : cells_around(cell_of(x, level))) {
                const auto found = in_cell.find(cell);
                if (found == in_cell.end()) continue;
                for (const int other : found->second)
                    if ((x - mesh_.vertex(other)).norm() <= own) sets_.join(v, other);
            }
        const int level = std::ilogb(own) + 1;
        levels.insert(level);
        in_cell[cell_of(x, level)].push_back(v);
    }
}

std::vector<int> Welding::run(double tolerance) {
    join_copies();
    if (join_same_places()) join_near(tolerance);
    std::vector<int> result;
    for (int v = 0; v < mesh_.vertex_count(); ++v) result.push_back(sets_.lowest(v));
    return result;
}

}  // namespace

std::vector<int> welded_vertices(const TriangleMesh& mesh, double tolerance) {
    return Welding(mesh).run(tolerance);
}

}  // namespace varimap
