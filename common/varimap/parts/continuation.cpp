#include "varimap/parts/continuation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "varimap/relaxation/global_relaxation.h"
#include "varimap/relaxation/local_relaxation.h"

namespace varimap {

namespace {

constexpr int relaxed_rings = 4;  ///< behind the front
constexpr int sweeps_per_ring = 2;
/// What has been placed is relaxed as a whole whenever it has grown by this since.
constexpr double growth_between_relaxations = 1.25;
const FoldEnergy front_energy{1, 0.3};
const RobustEnergy robust_energy{front_energy, 1};

/// Where the target's tangent plane holds the corner opposite a placed side: the face is unfolded beside the
/// side's image, with its own lengths. False where the side has no length or no side of the target.
bool unfold(const SlidingMap& map, int f, int corner, double scale, Vec3& position) {
    const auto corners = map.source().faces.row(f);
    const int a = corners[(corner + 1) % 3], b = corners[(corner + 2) % 3];
    const Vec3 here = map.source().vertex(a), side = map.source().vertex(b) - here;
    const Vec3 offset = map.source().vertex(corners[corner]) - here;
    const double length = side.norm();
    Vec3 along = map.image(b) - map.image(a);
    const Vec3 up = map.normal(a) + map.normal(b);
    along -= along.dot(up) / up.squaredNorm() * up;
    if (!(length > 0) || !(along.norm() > 0) || !up.allFinite()) return false;
    along.normalize();
    const double parallel = offset.dot(side) / length, height = offset.cross(side).norm() / length;
    const Vec3 middle = (map.image(a) + map.image(b)) / 2;
    position = middle + scale * ((parallel - length / 2) * along + height * up.normalized().cross(along));
    return true;
}

struct Placement {
    int vertex;
    SurfacePoint point;
};

/// Image of a vertex with placed neighbours: the mean of where its faces put it, reached from the nearest of
/// their images. False where no face has two placed corners.
bool predict(const SlidingMap& map, int v, double scale, Placement& placement) {
    Vec3 sum = Vec3::Zero();
    int count = 0, nearest = -1;
    double least = 0;
    for (const int f : map.faces_of_vertex()[v]) {
        const auto corners = map.source().faces.row(f);
        const int corner = map.corner_of(f, v);
        const int a = corners[(corner + 1) % 3], b = corners[(corner + 2) % 3];
        Vec3 position;
        if (!map.has_image(a) || !map.has_image(b) || !unfold(map, f, corner, scale, position)) continue;
        sum += position;
        ++count;
        for (const int u : {a, b}) {
            const double d = (map.source().vertex(u) - map.source().vertex(v)).squaredNorm();
            if (nearest < 0 || d < least) least = d, nearest = u;
        }
    }
    if (count == 0) return false;
    const Vec3 step = sum / count - map.image(nearest);
    placement = {v, map.walk(map.point(nearest), step)};
    return true;
}

/// Vertices without an image that share a face with one that has, ascending.
std::vector<int> front_of(const SlidingMap& map, const std::vector<int>& missing) {
    std::vector<int> front;
    for (const int v : missing) {
        bool beside = false;
        for (const int f : map.faces_of_vertex()[v])
            for (int k = 0; k < 3; ++k) beside = beside || map.has_image(map.source().faces(f, k));
        if (beside) front.push_back(v);
    }
    return front;
}

/// The placed vertices of a continuation, ring by ring.
class Front {
  public:
    Front(SlidingMap& map, std::vector<int> missing, double scale)
        : map_(map),
          missing_(std::move(missing)),
          scale_(scale),
          held_(map.source().vertex_count(), true),
          relaxation_(map, 7) {}

    /// Places one more ring, as far as there is one, and relaxes; false where none is left or can be placed.
    bool advance() {
        if (missing_.empty() || !place_ring()) return false;
        std::vector<int> band = last_rings();
        for (int s = 0; s < sweeps_per_ring; ++s) relaxation_.sweep(band, front_energy);
        for (const int v : rings_.back()) held_[v] = false;
        placed_ += double(rings_.back().size());
        if (placed_ > growth_between_relaxations * relaxed_ || missing_.empty()) relax_all();
        return true;
    }
    const std::vector<int>& missing() const { return missing_; }

  private:
    bool place_ring() {
        std::vector<Placement> placements;
        Placement placement;
        for (const int v : front_of(map_, missing_))
            if (predict(map_, v, scale_, placement)) placements.push_back(placement);
        if (placements.empty()) return false;
        rings_.emplace_back();
        for (const Placement& p : placements) {
            map_.place(p.vertex, p.point);
            rings_.back().push_back(p.vertex);
        }
        std::erase_if(missing_, [&](int v) { return map_.has_image(v); });
        return true;
    }
    void relax_all() {
        GlobalRelaxation(map_, held_).step(robust_energy);
        relaxed_ = placed_;
    }
    std::vector<int> last_rings() const {
        std::vector<int> band;
        for (int r = std::max(0, int(rings_.size()) - relaxed_rings); r < int(rings_.size()); ++r)
            band.insert(band.end(), rings_[r].begin(), rings_[r].end());
        return band;
    }

    SlidingMap& map_;
    std::vector<int> missing_;
    double scale_;
    VertexData<bool> held_;  ///< all but what has been placed
    LocalRelaxation relaxation_;
    std::vector<std::vector<int>> rings_;
    double placed_ = 0, relaxed_ = 0;  ///< vertices; relaxed_: as a whole
};

}  // namespace

void continue_map(SlidingMap& map, const VertexData<bool>& open, double scale) {
    const PointMap before = map.points();
    std::vector<int> missing, scaled;
    for (int v = 0; v < open.size(); ++v)
        if (open[v] && map.has_image(v)) missing.push_back(v);
    for (const int v : missing) map.clear(v);
    for (int f = 0; f < map.source().face_count(); ++f)
        if (marked_corners(map.source(), f, open) > 0) scaled.push_back(f);
    map.scale_rest(scaled, scale * scale);
    Front front(map, missing, scale);
    while (front.advance()) {
    }
    map.scale_rest(scaled, 1 / (scale * scale));
    for (const int v : front.missing()) map.place(v, before[v]);
}

}  // namespace varimap
