#include "varimap/mesh_repair/handles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "varimap/core/error.h"
#include "varimap/core/index_set.h"
#include "varimap/core/parse_number.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_repair/holes.h"
#include "varimap/mesh_repair/private/short_cycles.h"

namespace varimap {
namespace {

/// Shorter paths are cut first, so that longer ones go round what is left: each limit is half the next.
constexpr int limits = 4;
/// Paths are looked for around vertices that are no farther than this share of the longest from any other.
constexpr double spacing = 1. / 5;
/// Most searches for paths of one length: a cut may open the way for another.
constexpr int most_passes = 10;

/// Cuts of one mesh along paths that have no vertex in common.
class Cutting {
  public:
    Cutting(const TriangleMesh& mesh, const Edges& edges);

    /// Cuts unless that would separate the surface.
    enum class Outcome { cut, touches, separates };
    Outcome cut(const Cycle& cycle);
    int cuts() const { return int(cycles_.size()); }
    /// The mesh with both rims of each cut closed.
    void apply(RepairedMesh& mesh) const;

  private:
    int half_edge_from(int from, int to) const;
    int opposite(int half_edge) const { return opposite_[std::size_t(half_edge)]; }
    bool separates(const std::vector<int>& half_edges);
    std::vector<int> fan_to_the_right(const Cycle& cycle, std::size_t i) const;

    const TriangleMesh& mesh_;
    Adjacency faces_;
    std::vector<int> opposite_;  ///< opposite_half_edges; -1 also at cuts
    std::vector<char> taken_;    ///< vertices on cuts and on the boundary
    std::vector<int> reached_from_;
    std::vector<Cycle> cycles_;
};

Cutting::Cutting(const TriangleMesh& mesh, const Edges& edges)
    : mesh_(mesh),
      faces_(vertex_faces(mesh)),
      opposite_(opposite_half_edges(edges)),
      taken_(std::size_t(mesh.vertex_count()), 0),
      reached_from_(std::size_t(mesh.face_count()), 0) {
    for (int e = 0; e < edges.size(); ++e)
        if (edges.half_edges[e].size() != 2)
            for (const int v : edges.vertices[std::size_t(e)]) taken_[std::size_t(v)] = 1;
}

/// The half-edge that runs from one vertex to the other.
int Cutting::half_edge_from(int from, int to) const {
    for (const int f : faces_[from])
        for (int c = 0; c < 3; ++c)
            if (mesh_.faces(f, c) == from && mesh_.faces(f, (c + 1) % 3) == to) return 3 * f + c;
    return -1;
}

/// Whether the faces on both sides of a closed path, given by the half-edges to its left, do not meet
/// elsewhere. Grows both regions in turn, so that the smaller one ends the search.
bool Cutting::separates(const std::vector<int>& half_edges) {
    std::array<std::vector<int>, 2> region;
    for (const int half_edge : half_edges) {
        region[0].push_back(half_edge / 3);
        region[1].push_back(opposite(half_edge) / 3);
        opposite_[std::size_t(opposite(half_edge))] = -1;
    }
    std::vector<int> beyond;
    for (const int half_edge : half_edges)
        beyond.push_back(std::exchange(opposite_[std::size_t(half_edge)], -1));
    bool met = false;
    for (int k = 0; k < 2; ++k)
        for (const int f : region[std::size_t(k)]) {
            met = met || reached_from_[std::size_t(f)] == 2 - k;
            reached_from_[std::size_t(f)] = k + 1;
        }
    std::array<std::size_t, 2> next{0, 0};
    for (int k = 0; !met && next[std::size_t(k)] < region[std::size_t(k)].size(); k = 1 - k) {
        const int f = region[std::size_t(k)][next[std::size_t(k)]++];
        for (int half_edge = 3 * f; half_edge < 3 * f + 3 && !met; ++half_edge) {
            if (opposite(half_edge) < 0) continue;
            int& from = reached_from_[std::size_t(opposite(half_edge) / 3)];
            met = from == 2 - k;
            if (from != 0) continue;
            from = k + 1;
            region[std::size_t(k)].push_back(opposite(half_edge) / 3);
        }
    }
    for (const auto& faces : region)
        for (const int f : faces) reached_from_[std::size_t(f)] = 0;
    for (std::size_t i = 0; i < half_edges.size(); ++i) {
        opposite_[std::size_t(half_edges[i])] = beyond[i];
        opposite_[std::size_t(beyond[i])] = half_edges[i];
    }
    return !met;
}

Cutting::Outcome Cutting::cut(const Cycle& cycle) {
    const auto& vertices = cycle.vertices;
    if (std::any_of(vertices.begin(), vertices.end(), [&](int v) { return taken_[std::size_t(v)] != 0; }))
        return Outcome::touches;
    std::vector<int> half_edges;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        half_edges.push_back(half_edge_from(vertices[i], vertices[(i + 1) % vertices.size()]));
    if (separates(half_edges)) return Outcome::separates;
    for (const int half_edge : half_edges) {
        opposite_[std::size_t(opposite(half_edge))] = -1;
        opposite_[std::size_t(half_edge)] = -1;
    }
    for (const int v : vertices) taken_[std::size_t(v)] = 1;
    cycles_.push_back(cycle);
    return Outcome::cut;
}

/// The faces around a vertex of a path, to the right of it.
std::vector<int> Cutting::fan_to_the_right(const Cycle& cycle, std::size_t i) const {
    const std::size_t n = cycle.vertices.size();
    const int v = cycle.vertices[i];
    std::vector<int> fan;
    for (int half_edge = half_edge_from(cycle.vertices[(i + 1) % n], v); half_edge >= 0;) {
        fan.push_back(half_edge / 3);
        half_edge = opposite(next_half_edge(half_edge));  // -1 at the cut
    }
    return fan;
}

void Cutting::apply(RepairedMesh& repaired) const {
    if (repaired.link.is_identity()) repaired.link = link_to_itself(repaired.mesh);
    FileLink& link = repaired.link;
    Faces faces = mesh_.faces;
    std::vector<int> origin;
    std::vector<BoundaryLoop> rims;
    for (const Cycle& cycle : cycles_) {
        rims.emplace_back(cycle.vertices.rbegin(), cycle.vertices.rend());
        BoundaryLoop right;
        for (std::size_t i = 0; i < cycle.vertices.size(); ++i) {
            const int v = cycle.vertices[i], copy = mesh_.vertex_count() + int(origin.size());
            origin.push_back(v);
            right.push_back(copy);
            link.origin.push_back(link.origin[std::size_t(v)]);
            link.fate[std::size_t(link.origin.back())] = VertexFate::split;
            for (const int f : fan_to_the_right(cycle, i))
                for (int& corner : faces.row(f))
                    if (corner == v) corner = copy;
        }
        rims.push_back(std::move(right));
    }
    Points vertices(mesh_.vertex_count() + Eigen::Index(origin.size()), 3);
    vertices << mesh_.vertices, mesh_.vertices(origin, Eigen::all);
    repaired.mesh.vertices = std::move(vertices);
    repaired.mesh.faces = std::move(faces);
    repaired.counts.cut_handles += cuts();
    const std::vector<char> closed = close_loops(repaired, rims);
    repaired.counts.unfilled_holes += int(std::count(closed.begin(), closed.end(), 0));
}

/// Candidates around some vertices, the shortest first.
std::vector<Cycle> short_cycles(const TriangleMesh& mesh, const Edges& edges, const std::vector<int>& around,
                                Length longest, double unit) {
    ShortCycles search(mesh, edges, unit);
    const auto step = Length(spacing * double(longest));
    std::vector<char> covered(std::size_t(mesh.vertex_count()), 0);
    std::vector<Cycle> cycles;
    for (const int v : around) {
        if (covered[std::size_t(v)]) continue;
        const std::vector<Cycle> found = search.around(v, longest / 2 + step, longest);
        cycles.insert(cycles.end(), found.begin(), found.end());
        for (const auto& [w, distance] : search.reached())
            if (distance <= step) covered[std::size_t(w)] = 1;
    }
    std::sort(cycles.begin(), cycles.end());
    return cycles;
}

/// Cuts paths of the mesh around some vertices. Returns the vertices of those that touch a cut or the
/// boundary, around which others may be left.
std::vector<int> cut_around(const std::vector<int>& vertices, RepairedMesh& mesh, Length longest,
                            double unit) {
    const TriangleMesh before = mesh.mesh;
    const Edges edges = find_edges(before);
    Cutting cutting(before, edges);
    std::vector<int> left;
    for (const Cycle& cycle : short_cycles(before, edges, vertices, longest, unit))
        if (cutting.cut(cycle) == Cutting::Outcome::touches)
            left.insert(left.end(), cycle.vertices.begin(), cycle.vertices.end());
    if (cutting.cuts() == 0) return {};
    cutting.apply(mesh);
    make_set(left);
    return left;
}

void cut_all(RepairedMesh& mesh, Length longest, double unit) {
    std::vector<int> around = all_indices(mesh.mesh.vertex_count());
    for (int pass = 0; pass < most_passes && !around.empty(); ++pass)
        around = cut_around(around, mesh, longest, unit);
}

}  // namespace

double longest_handle(const std::string& words, const TriangleMesh& mesh) {
    // The length did well on mouse skulls, which have about 300 handles.
    constexpr double short_ones = 0.05;
    if (words == "none") return 0;
    if (words == "auto") return summarise_topology(mesh).genus > most_handles ? short_ones : 0;
    double length = -1;
    if (!parse_number(words, length) || !(length >= 0 && length <= 1))
        throw UsageError(
            "--cut-handles " + words +
            ": give the length of the longest path, at most 1 (in units of sqrt(area)), or auto, or none");
    return length;
}

RepairedMesh handles_cut(RepairedMesh mesh, double length) {
    if (!(length > 0)) return mesh;
    const double unit = std::sqrt(surface_area(mesh.mesh));
    for (int i = limits - 1; i >= 0; --i) cut_all(mesh, Length(1e6 * std::ldexp(length, -i)), unit);
    return mesh;
}

}  // namespace varimap
