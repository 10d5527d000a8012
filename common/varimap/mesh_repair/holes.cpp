#include "varimap/mesh_repair/holes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "varimap/core/error.h"
#include "varimap/core/parse_number.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_repair/private/face_price.h"

namespace varimap {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
/// Loops of so many edges are triangulated at once.
constexpr std::size_t at_once = 200;
/// What closes a slit has no larger share of the square of the loop's length: it is 2500 times longer than
/// wide.
constexpr double area_of_slits = 1e-4;

using Loop = BoundaryLoop;
using Triangle = std::array<int, 3>;

/// What it costs to close a loop of one mesh.
class HoleFilling {
  public:
    /// `price`: of a thin face, an area.
    HoleFilling(const TriangleMesh& mesh, const Adjacency& neighbours, double price)
        : mesh_(mesh), neighbours_(neighbours), price_(price) {}

    /// Empty where it cannot be closed.
    std::vector<Triangle> fill(Loop loop) {
        faces_.clear();
        if (loop.size() == 3 && is_face(loop)) return {};
        if (!cut_ears(loop) || !triangulate(loop)) return {};
        return faces_;
    }

  private:
    bool is_edge(int a, int b) const {
        return std::binary_search(neighbours_[a].begin(), neighbours_[a].end(), b);
    }
    /// Of a component that is one triangle.
    bool is_face(const Loop& loop) const {
        return neighbours_[loop[0]].size() == 2 && neighbours_[loop[1]].size() == 2 &&
               neighbours_[loop[2]].size() == 2;
    }
    double cost(int a, int b, int c) const {
        return price_of_face(mesh_.vertex(a), mesh_.vertex(b), mesh_.vertex(c), price_);
    }
    bool cut_ears(Loop& loop);
    bool triangulate(const Loop& loop);
    void collect(const Loop& loop, const std::vector<int>& apex, std::size_t i, std::size_t j);

    const TriangleMesh& mesh_;
    const Adjacency& neighbours_;
    double price_;
    std::vector<Triangle> faces_;
};

/// The cheapest ears, until what is left is triangulated at once; false where each would need an edge that is
/// there already.
bool HoleFilling::cut_ears(Loop& loop) {
    const std::size_t n = loop.size();
    std::vector<std::size_t> before, behind;  // of what is left
    for (std::size_t i = 0; i < n; ++i) {
        before.push_back((i + n - 1) % n);
        behind.push_back((i + 1) % n);
    }
    std::vector<double> costs(n, never);
    std::set<std::pair<double, std::size_t>> ears;  // the first of equals comes first
    const auto update = [&](std::size_t i) {
        ears.erase({costs[i], i});
        const int a = loop[before[i]], c = loop[behind[i]];
        costs[i] = is_edge(a, c) ? never : cost(a, loop[i], c);
        if (costs[i] < never) ears.emplace(costs[i], i);
    };
    std::vector<char> is_cut(n, 0);
    if (n > at_once)
        for (std::size_t i = 0; i < n; ++i) update(i);
    for (std::size_t left = n; left > at_once; --left) {
        if (ears.empty()) return false;
        const std::size_t ear = ears.extract(ears.begin()).value().second, a = before[ear], c = behind[ear];
        faces_.push_back({loop[a], loop[ear], loop[c]});
        is_cut[ear] = 1;
        behind[a] = c;
        before[c] = a;
        update(a);
        update(c);
    }
    Loop rest;
    for (std::size_t i = 0; i < n; ++i)
        if (!is_cut[i]) rest.push_back(loop[i]);
    loop = std::move(rest);
    return true;
}

/// By least cost from i to j, over the corner between.
bool HoleFilling::triangulate(const Loop& loop) {
    const std::size_t n = loop.size();
    std::vector<double> best(n * n, 0);
    std::vector<int> apex(n * n, -1);
    for (std::size_t span = 2; span < n; ++span)
        for (std::size_t i = 0; i + span < n; ++i) {
            const std::size_t j = i + span;
            best[i * n + j] = never;
            if (span + 1 < n && is_edge(loop[i], loop[j])) continue;
            for (std::size_t k = i + 1; k < j; ++k) {
                const double below = best[i * n + k] + best[k * n + j];
                if (below >= best[i * n + j]) continue;
                const double now = below + cost(loop[i], loop[k], loop[j]);
                if (now < best[i * n + j]) best[i * n + j] = now, apex[i * n + j] = int(k);
            }
        }
    if (best[n - 1] == never) return false;
    collect(loop, apex, 0, n - 1);
    return true;
}

void HoleFilling::collect(const Loop& loop, const std::vector<int>& apex, std::size_t i, std::size_t j) {
    if (j < i + 2) return;
    const auto k = std::size_t(apex[i * loop.size() + j]);
    faces_.push_back({loop[i], loop[k], loop[j]});
    collect(loop, apex, i, k);
    collect(loop, apex, k, j);
}

void add(const std::vector<Triangle>& triangles, RepairedMesh& repaired) {
    Faces& faces = repaired.mesh.faces;
    const Eigen::Index before = faces.rows();
    faces.conservativeResize(before + Eigen::Index(triangles.size()), 3);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        faces.row(before + Eigen::Index(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
    repaired.link.face.resize(std::size_t(faces.rows()), -1);
    repaired.link.turned.resize(std::size_t(faces.rows()), 0);
}

void close(const std::vector<Triangle>& triangles, RepairedMesh& repaired) {
    if (triangles.empty()) return;
    if (repaired.link.is_identity()) repaired.link = link_to_itself(repaired.mesh);
    add(triangles, repaired);
}

double length_of(const TriangleMesh& mesh, const Loop& loop) {
    double length = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        length += (mesh.vertex(loop[(i + 1) % loop.size()]) - mesh.vertex(loop[i])).norm();
    return length;
}

/// No surface that the loop bounds has less.
double least_area(const TriangleMesh& mesh, const Loop& loop) {
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        area += (mesh.vertex(loop[i]) - mesh.vertex(loop[0]))
                    .cross(mesh.vertex(loop[i + 1]) - mesh.vertex(loop[0]));
    return area.norm() / 2;
}

double area_of(const TriangleMesh& mesh, const std::vector<Triangle>& faces) {
    double area = 0;
    for (const auto& [a, b, c] : faces)
        area += (mesh.vertex(b) - mesh.vertex(a)).cross(mesh.vertex(c) - mesh.vertex(a)).norm() / 2;
    return area;
}

}  // namespace

int longest_hole(const std::string& words) {
    if (words == "none" || words == "0") return 0;
    if (words == "all") return std::numeric_limits<int>::max();
    int edges = 0;
    if (!parse_number(words, edges) || edges < 3)
        throw UsageError("--fill-holes " + words +
                         ": give the number of edges of the longest hole, at least 3, or all, or none");
    return edges;
}

RepairedMesh slits_closed(RepairedMesh repaired) {
    const TriangleMesh& mesh = repaired.mesh;
    const std::vector<Loop> loops = boundary_loops(mesh, find_edges(mesh));
    if (loops.empty()) return repaired;
    const Adjacency neighbours = vertex_neighbours(mesh);
    HoleFilling filling(mesh, neighbours, 0);  // all of its faces are thin
    std::vector<Triangle> added;
    for (const Loop& loop : loops) {
        const double length = length_of(mesh, loop), most = area_of_slits * length * length;
        if (loop.size() > at_once || least_area(mesh, loop) > most) continue;
        const std::vector<Triangle> faces = filling.fill(loop);
        if (faces.empty() || area_of(mesh, faces) > most) continue;
        added.insert(added.end(), faces.begin(), faces.end());
        ++repaired.counts.closed_slits;
    }
    close(added, repaired);
    return repaired;
}

RepairedMesh holes_filled(RepairedMesh repaired, int edges) {
    if (edges < 3) return repaired;
    const std::vector<Loop> loops = boundary_loops(repaired.mesh, find_edges(repaired.mesh));
    if (loops.empty()) return repaired;
    std::vector<Loop> chosen;
    for (const Loop& loop : loops)
        if (int(loop.size()) <= edges) chosen.push_back(loop);
    const int before = repaired.mesh.face_count();
    for (const char closed : close_loops(repaired, chosen))
        ++(closed ? repaired.counts.filled_holes : repaired.counts.unfilled_holes);
    repaired.counts.filling_faces = repaired.mesh.face_count() - before;
    return repaired;
}

std::vector<char> close_loops(RepairedMesh& repaired, const std::vector<Loop>& loops) {
    const Adjacency neighbours = vertex_neighbours(repaired.mesh);
    HoleFilling filling(repaired.mesh, neighbours, surface_area(repaired.mesh));
    std::vector<Triangle> added;
    std::vector<char> closed;
    for (const Loop& loop : loops) {
        const std::vector<Triangle> faces = filling.fill(loop);
        added.insert(added.end(), faces.begin(), faces.end());
        closed.push_back(!faces.empty());
    }
    close(added, repaired);
    return closed;
}

}  // namespace varimap
