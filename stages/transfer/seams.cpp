#include "stages/transfer/seams.h"

#include <array>
#include <map>

#include "varimap/core/parallel.h"
#include "varimap/mesh/topology.h"
#include "varimap/surface/surface.h"

namespace varimap {

namespace {

/// A tenth of a texel of a texture of a thousand: files round, and faces side by side see the coordinates of
/// their corners each from its own inside.
constexpr double same_uv = 1e-4;
constexpr double inset = 1e-3;          ///< of a face, so that its rim is looked at from its inside
constexpr double cut_tolerance = 1e-4;  ///< of a side's length
/// The same: nearer cuts are one, or at the corner. Slivers between them would be no faces to map anew.
constexpr double apart = 1e-3;
/// Of a side: with more it runs along a seam, on one side of it and the other by turns.
constexpr std::size_t most_cuts = 32;

bool is_same(const Vec2& a, const Vec2& b) {
    return (a - b).cwiseAbs().maxCoeff() <= same_uv;
}

/// A place of a face's inside or rim, seen from its inside.
struct Sample {
    int face = -1;  ///< of the atlas
    Vec2 uv = Vec2::Zero();
};

/// Where a side crosses a seam: its share of the way, and the texture coordinates on either side.
struct Cut {
    double at;
    Vec2 before, after;
};

/// What one face of the mesh finds on the atlas.
struct FaceTrace {
    bool mapped = false;
    std::array<Vec2, 3> corner;
    std::array<std::vector<Cut>, 3> cuts;  ///< per side, from corner c to c + 1
};

class Tracer {
  public:
    Tracer(const Correspondence& map, const PointCarrier& back, const Atlas& atlas)
        : map_(map), back_(back), atlas_(atlas) {}

    /// The atlas at barycentric coordinates of a face, as its inside continues there.
    Sample sample(int face, const Vec3& b) const {
        const Vec3 inner = (1 - inset) * b + Vec3::Constant(inset / 3);
        const SurfacePoint inside = back_({face, inner});
        if (inside.face < 0) return {};
        const SurfacePoint exact = back_({face, b});
        if (exact.face < 0) return {};
        return {inside.face, atlas_({inside.face, barycentric_on(map_.from, inside.face, exact)})};
    }
    /// Where the straight way from a to b crosses seams.
    std::vector<Cut> cuts(int face, const Vec3& a, const Vec3& b) const {
        const Sample first = sample(face, a), last = sample(face, b);
        std::vector<Cut> found;
        bisect(face, a, b, {0, first}, {1, last}, found);
        if (found.size() <= most_cuts) return found;
        if (atlas_.joined(first.face, last.face)) return {};
        return {{.5, first.uv, last.uv}};
    }
    FaceTrace trace(int face) const {
        FaceTrace result;
        result.mapped = back_({face, Vec3::Constant(1 / 3.)}).face >= 0;
        if (!result.mapped) return result;
        for (int c = 0; c < 3; ++c) {
            result.corner[std::size_t(c)] = sample(face, Vec3::Unit(c)).uv;
            result.cuts[std::size_t(c)] = cuts(face, Vec3::Unit(c), Vec3::Unit((c + 1) % 3));
        }
        return result;
    }

  private:
    using Stop = std::pair<double, Sample>;
    void bisect(int face, const Vec3& a, const Vec3& b, const Stop& from, const Stop& to,
                std::vector<Cut>& found) const {
        const auto& [t0, first] = from;
        const auto& [t1, last] = to;
        if (found.size() > most_cuts || atlas_.joined(first.face, last.face)) return;
        const double t = (t0 + t1) / 2;
        if (t1 - t0 < cut_tolerance) return found.push_back({t, first.uv, last.uv});
        const Stop middle{t, sample(face, (1 - t) * a + t * b)};
        bisect(face, a, b, from, middle, found);
        bisect(face, a, b, middle, to, found);
    }

    const Correspondence& map_;
    const PointCarrier& back_;
    const Atlas& atlas_;
};

/// A point of a face's rim.
struct RimPoint {
    int vertex;
    Vec2 uv;
    Vec3 barycentric;
};
/// What lies between two cuts, or all of the rim.
using Arc = std::vector<RimPoint>;

class Cutter {
  public:
    Cutter(const Correspondence& map, const PointCarrier& back, const ObjModel& model)
        : map_(map),
          model_(model),
          atlas_(map.from, model),
          tracer_(map, back, atlas_),
          traces_(std::size_t(map.to.face_count())),
          cut_vertices_(3 * traces_.size()) {}

    TexturedMesh run() {
        parallel_for_each_index(map_.to.face_count(), 64,
                                [&](int f) { traces_[std::size_t(f)] = tracer_.trace(f); });
        for (const auto vertex : map_.to.vertices.rowwise()) vertices_.push_back(vertex.transpose());
        number_cuts();
        for (int f = 0; f < map_.to.face_count(); ++f) cut_face(f);
        return result();
    }

  private:
    std::vector<Cut>& cuts(int side) { return traces_[std::size_t(side / 3)].cuts[std::size_t(side % 3)]; }
    int begin_of(int side) const { return map_.to.faces(side / 3, side % 3); }

    void number_cuts();
    void make_cut_vertices(int side);
    void share_cuts(int side, int other);
    std::vector<Arc> arcs_of(int f);
    void cut_face(int f);
    void fan(const Arc& arc, std::size_t apex, int f);
    void star(const std::vector<Arc>& arcs, int f);
    void add_face(const RimPoint& a, const RimPoint& b, const RimPoint& c, int f);
    int uv_index(const RimPoint& point);
    TexturedMesh result() const;

    const Correspondence& map_;
    const ObjModel& model_;
    Atlas atlas_;
    Tracer tracer_;
    std::vector<FaceTrace> traces_;
    std::vector<std::vector<int>> cut_vertices_;  ///< per side 3 f + c: the vertices at its cuts
    std::vector<Vec3> vertices_;
    std::vector<Vec2> uv_;
    std::map<int, std::vector<int>> known_uv_;  ///< of the vertices
    std::vector<int> corners_, uv_corners_, materials_;
};

void Cutter::make_cut_vertices(int side) {
    const int c = side % 3;
    const Vec3 a = map_.to.vertex(map_.to.faces(side / 3, c));
    const Vec3 b = map_.to.vertex(map_.to.faces(side / 3, (c + 1) % 3));
    std::vector<int>& made = cut_vertices_[std::size_t(side)];
    double before = 0;
    int vertex = map_.to.faces(side / 3, c);
    for (const Cut& cut : cuts(side)) {
        if (1 - cut.at < apart) {
            vertex = map_.to.faces(side / 3, (c + 1) % 3);
        } else if (cut.at - before >= apart) {
            vertex = int(vertices_.size());
            vertices_.push_back((1 - cut.at) * a + cut.at * b);
            before = cut.at;
        }
        made.push_back(vertex);
    }
}

/// Both faces find nearly the same cuts, one in the opposite order: they take the mean.
void Cutter::share_cuts(int side, int other) {
    auto &mine = cuts(side), &theirs = cuts(other);
    const std::size_t n = mine.size();
    for (std::size_t i = 0; i < n; ++i) {
        mine[i].at = (mine[i].at + 1 - theirs[n - 1 - i].at) / 2;
        theirs[n - 1 - i].at = 1 - mine[i].at;
    }
    make_cut_vertices(side);
    cut_vertices_[std::size_t(other)].assign(cut_vertices_[std::size_t(side)].rbegin(),
                                             cut_vertices_[std::size_t(side)].rend());
}

void Cutter::number_cuts() {
    const Edges edges = find_edges(map_.to);
    for (int e = 0; e < edges.size(); ++e) {
        const auto sides = edges.half_edges[e];
        if (sides.size() == 2 && begin_of(sides[0]) != begin_of(sides[1]) &&
            cuts(sides[0]).size() == cuts(sides[1]).size())
            share_cuts(sides[0], sides[1]);
        else
            for (const int side : sides) make_cut_vertices(side);
    }
}

/// The rim from the first cut on, parted at the cuts; without cuts the rim.
std::vector<Arc> Cutter::arcs_of(int f) {
    const FaceTrace& trace = traces_[std::size_t(f)];
    std::vector<Arc> arcs(1);
    for (int c = 0; c < 3; ++c) {
        arcs.back().push_back({map_.to.faces(f, c), trace.corner[std::size_t(c)], Vec3::Unit(c)});
        const auto& side_cuts = trace.cuts[std::size_t(c)];
        for (std::size_t i = 0; i < side_cuts.size(); ++i) {
            const auto& [at, before, after] = side_cuts[i];
            const int vertex = cut_vertices_[std::size_t(3 * f + c)][i];
            const Vec3 b = (1 - at) * Vec3::Unit(c) + at * Vec3::Unit((c + 1) % 3);
            arcs.back().push_back({vertex, before, b});
            arcs.push_back({{vertex, after, b}});
        }
    }
    if (arcs.size() > 1) {  // the last arc goes on in the first
        arcs.back().insert(arcs.back().end(), arcs.front().begin(), arcs.front().end());
        arcs.erase(arcs.begin());
    }
    return arcs;
}

void Cutter::cut_face(int f) {
    const std::vector<Arc> arcs = arcs_of(f);
    if (arcs.size() > 2) return star(arcs, f);
    // One arc from a cut round to itself: the seam ends within the face, and the cut goes on to the corner
    // opposite, which is the third point.
    for (const Arc& arc : arcs) fan(arc, arcs.size() == 1 && arc.size() == 5 ? 2 : 0, f);
}

void Cutter::fan(const Arc& arc, std::size_t apex, int f) {
    for (std::size_t i = 0; i + 1 < arc.size(); ++i) {
        if (i == apex || i + 1 == apex) continue;
        add_face(arc[apex], arc[i], arc[i + 1], f);
    }
}

/// Seams meet within the face: every arc is joined to the centre, which has coordinates for each.
void Cutter::star(const std::vector<Arc>& arcs, int f) {
    const Vec3 middle = Vec3::Constant(1 / 3.);
    const int centre = int(vertices_.size());
    vertices_.push_back(position(map_.to, {f, middle}));
    for (const Arc& arc : arcs) {
        const Vec3 start =
            arc.size() > 2 ? arc[1].barycentric : Vec3((arc[0].barycentric + arc[1].barycentric) / 2);
        const auto on_the_way = tracer_.cuts(f, start, middle);
        const Vec2 uv = on_the_way.empty() ? tracer_.sample(f, middle).uv : on_the_way[0].before;
        for (std::size_t i = 0; i + 1 < arc.size(); ++i)
            add_face({centre, uv, middle}, arc[i], arc[i + 1], f);
    }
}

int Cutter::uv_index(const RimPoint& point) {
    std::vector<int>& known = known_uv_[point.vertex];
    for (const int index : known)
        if (is_same(uv_[std::size_t(index)], point.uv)) return index;
    known.push_back(int(uv_.size()));
    uv_.push_back(point.uv);
    return known.back();
}

void Cutter::add_face(const RimPoint& a, const RimPoint& b, const RimPoint& c, int f) {
    if (a.vertex == b.vertex || b.vertex == c.vertex || c.vertex == a.vertex) return;
    const bool mapped = traces_[std::size_t(f)].mapped;
    for (const RimPoint* point : {&a, &b, &c}) {
        corners_.push_back(point->vertex);
        uv_corners_.push_back(mapped ? uv_index(*point) : -1);
    }
    const int under =
        mapped ? tracer_.sample(f, (a.barycentric + b.barycentric + c.barycentric) / 3).face : -1;
    materials_.push_back(under < 0 ? -1 : atlas_.material(under));
}

TexturedMesh Cutter::result() const {
    TexturedMesh textured;
    textured.mesh.vertices.resize(Eigen::Index(vertices_.size()), 3);
    for (std::size_t v = 0; v < vertices_.size(); ++v)
        textured.mesh.vertices.row(Eigen::Index(v)) = vertices_[v].transpose();
    const Eigen::Index faces = Eigen::Index(materials_.size());
    textured.mesh.faces = Eigen::Map<const Faces>(corners_.data(), faces, 3);
    textured.model = {
        uv_, Eigen::Map<const Faces>(uv_corners_.data(), faces, 3), materials_, model_.materials, {}};
    return textured;
}

}  // namespace

Vec2 Atlas::operator()(const SurfacePoint& point) const {
    Vec2 uv = Vec2::Zero();
    for (int k = 0; k < 3; ++k)
        uv += point.barycentric[k] * model_.uv[std::size_t(model_.uv_of(point.face, k))];
    return uv;
}

bool Atlas::joined(int f, int g) const {
    if (f == g) return true;
    if (f < 0 || g < 0 || material(f) != material(g)) return false;
    bool touch = false;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int v = mesh_.faces(f, i), w = mesh_.faces(g, j);
            if (v != w && mesh_.vertices.row(v) != mesh_.vertices.row(w)) continue;
            touch = true;
            if (!is_same(model_.uv[std::size_t(model_.uv_of(f, i))],
                         model_.uv[std::size_t(model_.uv_of(g, j))]))
                return false;
        }
    return touch;
}

TexturedMesh cut_at_seams(const Correspondence& map, const PointCarrier& back, const ObjModel& model) {
    return Cutter(map, back, model).run();
}

}  // namespace varimap
