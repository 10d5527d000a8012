#include "varimap/mesh_repair/sheets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "varimap/mesh/disjoint_sets.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

constexpr double least_height = 1e-9;      ///< by the length of the face's other side
constexpr std::size_t most_compared = 64;  ///< faces at an edge; comparing them takes their cube

/// A face at an edge, by its half-edge there.
struct Flank {
    int half_edge;
    bool forward;  ///< it runs from the edge's lower vertex to its higher one
    double angle;  ///< about the edge, counter-clockwise seen from the higher vertex
    bool flat;     ///< without height over the edge: the angle means nothing
};

/// Of flat ones 0: others belong together before them.
double turn_between(const Flank& a, const Flank& b) {
    if (a.flat || b.flat) return 0;
    const double turn = std::abs(a.angle - b.angle);
    return std::min(turn, 2 * std::numbers::pi - turn);
}

class SheetFinder {
  public:
    explicit SheetFinder(const TriangleMesh& mesh)
        : mesh_(mesh),
          edges_(find_edges(mesh)),
          partner_(edges_.of_half_edge.size(), -1),
          turned_(std::size_t(mesh.face_count()), 0) {}
    Sheets find();

  private:
    int start(int half_edge) const { return mesh_.faces(half_edge / 3, half_edge % 3); }
    int partner(int half_edge) const { return partner_[std::size_t(half_edge)]; }
    bool is_turned(int half_edge) const { return turned_[std::size_t(half_edge / 3)]; }
    void find_partners();
    std::vector<Flank> flanks(int edge) const;
    void join_beside_wedges(const std::vector<Flank>& flanks);
    void join_opposite(const std::vector<Flank>& flanks);
    void join_flattest(std::vector<Flank> flanks);
    void join(int half_edge, int other);
    void part(int half_edge);
    bool agree(int half_edge, int other) const;
    void orient();
    std::vector<int> orient_from(int seed, std::vector<char>& seen);
    bool looks_inward(const std::vector<int>& faces) const;
    void join_corners();
    bool part_where_crowded();

    const TriangleMesh& mesh_;
    Edges edges_;
    std::vector<int> partner_;  ///< per half-edge: that of the face it hangs together with; -1: none
    std::vector<char> turned_;
    std::vector<int> corner_;  ///< per corner: the lowest of those that are one with it
    int cut_edges_ = 0, opened_edges_ = 0;
};

void SheetFinder::join(int half_edge, int other) {
    partner_[std::size_t(half_edge)] = other;
    partner_[std::size_t(other)] = half_edge;
}

void SheetFinder::part(int half_edge) {
    if (partner(half_edge) < 0) return;
    partner_[std::size_t(partner(half_edge))] = -1;
    partner_[std::size_t(half_edge)] = -1;
}

std::vector<Flank> SheetFinder::flanks(int edge) const {
    const auto [low, high] = edges_.vertices[std::size_t(edge)];
    const Vec3 origin = mesh_.vertex(low), axis = (mesh_.vertex(high) - origin).stableNormalized();
    const Vec3 x = axis.unitOrthogonal(), y = axis.cross(x);
    std::vector<Flank> result;
    for (const int half_edge : edges_.half_edges[edge]) {
        const Vec3 across = mesh_.vertex(start(next_half_edge(next_half_edge(half_edge)))) - origin;
        const double up = across.dot(y), out = across.dot(x), angle = std::atan2(up, out);
        const bool flat = std::hypot(up, out) <= least_height * across.norm();
        // About an edge without length there are no angles.
        result.push_back({half_edge, start(half_edge) == low, std::isfinite(angle) ? angle : 0, flat});
    }
    std::sort(result.begin(), result.end(), [](const Flank& a, const Flank& b) {
        return a.angle != b.angle ? a.angle < b.angle : a.half_edge < b.half_edge;
    });
    return result;
}

/// A face that runs forward has the inside before it, counter-clockwise; one that runs backward, behind it:
/// they belong together as brackets do, around the edge.
void SheetFinder::join_beside_wedges(const std::vector<Flank>& flanks) {
    std::vector<int> open, closing;
    for (const Flank& flank : flanks) {
        if (!flank.forward) {
            open.push_back(flank.half_edge);
        } else if (open.empty()) {
            closing.push_back(flank.half_edge);
        } else {
            join(open.back(), flank.half_edge);
            open.pop_back();
        }
    }
    for (const int half_edge : closing) {
        join(open.back(), half_edge);
        open.pop_back();
    }
}

/// Of so many faces each goes with the one that is half of them away: as flat as can be where they are even.
void SheetFinder::join_opposite(const std::vector<Flank>& flanks) {
    const std::size_t half = flanks.size() / 2;
    for (std::size_t i = 0; i < half; ++i) join(flanks[i].half_edge, flanks[i + half].half_edge);
}

void SheetFinder::join_flattest(std::vector<Flank> flanks) {
    if (flanks.size() > most_compared) return join_opposite(flanks);
    while (flanks.size() > 1) {
        std::size_t first = 0, second = 1;
        for (std::size_t i = 0; i < flanks.size(); ++i)
            for (std::size_t k = i + 1; k < flanks.size(); ++k)
                if (turn_between(flanks[i], flanks[k]) > turn_between(flanks[first], flanks[second]))
                    first = i, second = k;
        join(flanks[first].half_edge, flanks[second].half_edge);
        flanks.erase(flanks.begin() + std::ptrdiff_t(second));
        flanks.erase(flanks.begin() + std::ptrdiff_t(first));
    }
}

void SheetFinder::find_partners() {
    for (int e = 0; e < edges_.size(); ++e) {
        const auto half_edges = edges_.half_edges[e];
        if (half_edges.size() == 2) join(half_edges[0], half_edges[1]);
        if (half_edges.size() < 3) continue;
        ++cut_edges_;
        const std::vector<Flank> around = flanks(e);
        const auto forward =
            std::count_if(around.begin(), around.end(), [](const Flank& f) { return f.forward; });
        if (2 * std::size_t(forward) == around.size())
            join_beside_wedges(around);
        else
            join_flattest(around);
    }
}

/// Whether two faces run through their common edge in opposite directions.
bool SheetFinder::agree(int half_edge, int other) const {
    return (start(half_edge) == start(other)) == (is_turned(half_edge) != is_turned(other));
}

/// Turns the faces that hang together with the seed as it is; those where that cannot be are parted.
std::vector<int> SheetFinder::orient_from(int seed, std::vector<char>& seen) {
    std::vector<int> faces{seed};
    seen[std::size_t(seed)] = 1;
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (int half_edge = 3 * faces[i]; half_edge < 3 * faces[i] + 3; ++half_edge) {
            const int other = partner(half_edge);
            if (other < 0) continue;
            if (!seen[std::size_t(other / 3)]) {
                seen[std::size_t(other / 3)] = 1;
                turned_[std::size_t(other / 3)] = !agree(half_edge, other);
                faces.push_back(other / 3);
            } else if (!agree(half_edge, other)) {
                part(half_edge);
                ++opened_edges_;
            }
        }
    return faces;
}

/// Of faces as they are turned: where closed, by the sign of the volume; else by most of the area as given.
bool SheetFinder::looks_inward(const std::vector<int>& faces) const {
    const Vec3 origin = mesh_.vertex(mesh_.faces(faces[0], 0));
    double volume = 0, turned = 0, area = 0;
    bool closed = true;
    for (const int f : faces) {
        const Vec3 normal = face_normal(mesh_, f);
        const bool is_turned = turned_[std::size_t(f)];
        volume += (is_turned ? -1 : 1) * (mesh_.vertex(mesh_.faces(f, 0)) - origin).dot(normal);
        area += normal.norm();
        if (is_turned) turned += normal.norm();
        for (int half_edge = 3 * f; half_edge < 3 * f + 3; ++half_edge)
            closed = closed && partner(half_edge) >= 0;
    }
    return closed && volume != 0 ? volume < 0 : turned > area / 2;
}

/// What is oriented alike stays as it is, inside out too.
void SheetFinder::orient() {
    std::vector<char> seen(turned_.size(), 0);
    for (int f = 0; f < mesh_.face_count(); ++f) {
        if (seen[std::size_t(f)]) continue;
        const std::vector<int> faces = orient_from(f, seen);
        const bool mixed = std::any_of(faces.begin(), faces.end(),
                                       [&](int face) { return turned_[std::size_t(face)] != 0; });
        if (!mixed || !looks_inward(faces)) continue;
        for (const int face : faces) turned_[std::size_t(face)] = !turned_[std::size_t(face)];
    }
}

void SheetFinder::join_corners() {
    DisjointSets sets(int(partner_.size()));
    for (int half_edge = 0; half_edge < int(partner_.size()); ++half_edge) {
        const int other = partner(half_edge);
        if (other < half_edge) continue;
        const bool along = start(half_edge) == start(other);
        sets.join(half_edge, along ? other : next_half_edge(other));
        sets.join(next_half_edge(half_edge), along ? next_half_edge(other) : other);
    }
    corner_.resize(partner_.size());
    for (int c = 0; c < int(corner_.size()); ++c) corner_[std::size_t(c)] = sets.lowest(c);
}

/// An edge cut at one end only is whole again. There all of its faces are parted; where they were, from all
/// others.
bool SheetFinder::part_where_crowded() {
    const TriangleMesh sheets{{}, Faces::Map(corner_.data(), mesh_.face_count(), 3)};
    const Edges edges = find_edges(sheets);
    bool parted = false;
    for (int e = 0; e < edges.size(); ++e) {
        const auto half_edges = edges.half_edges[e];
        const auto is_joined = [&](int half_edge) { return partner(half_edge) >= 0; };
        if (half_edges.size() < 2 || (half_edges.size() == 2 && agree(half_edges[0], half_edges[1])))
            continue;
        if (std::any_of(half_edges.begin(), half_edges.end(), is_joined))
            for (const int half_edge : half_edges) part(half_edge);
        else
            for (const int half_edge : half_edges)
                for (int k = 0; k < 3; ++k) part(half_edge - half_edge % 3 + k);
        parted = true;
    }
    return parted;
}

Sheets SheetFinder::find() {
    find_partners();
    orient();
    do join_corners();
    while (part_where_crowded());
    Sheets sheets;
    std::vector<int> number(corner_.size(), -1), roots;
    for (int c = 0; c < int(corner_.size()); ++c)
        if (corner_[std::size_t(c)] == c) roots.push_back(c);
    std::stable_sort(roots.begin(), roots.end(), [&](int a, int b) { return start(a) < start(b); });
    for (const int root : roots) {
        number[std::size_t(root)] = int(sheets.origin.size());
        sheets.origin.push_back(start(root));
    }
    for (int& corner : corner_) corner = number[std::size_t(corner)];
    sheets.faces = Faces::Map(corner_.data(), mesh_.face_count(), 3);
    sheets.turned = turned_;
    sheets.cut_edges = cut_edges_;
    sheets.opened_edges = opened_edges_;
    return sheets;
}

}  // namespace

Sheets find_sheets(const TriangleMesh& mesh) {
    return SheetFinder(mesh).find();
}

}  // namespace varimap
