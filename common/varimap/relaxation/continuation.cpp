#include "varimap/relaxation/continuation.h"

#include <cmath>

#include "varimap/relaxation/global_relaxation.h"
#include "varimap/relaxation/local_relaxation.h"

namespace varimap {

namespace {

constexpr int relaxed_rings = 4;  ///< behind the front
constexpr int sweeps_per_ring = 2;
constexpr std::size_t rings_per_step = 3;  ///< between relaxations of all that has been placed
constexpr double robustness = 1;
const FoldEnergy front_energy{1, 0.3};

/// Where the target's tangent plane holds the corner opposite a placed side: the face is laid down beside the
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
        const int corner = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
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
    placement = {v, map.walk(map.points()[std::size_t(nearest)], step)};
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

}  // namespace

void continue_map(SlidingMap& map, const std::vector<char>& open, double scale) {
    const PointMap before = map.points();
    std::vector<int> missing;
    for (int v = 0; v < int(open.size()); ++v)
        if (open[std::size_t(v)] && map.has_image(v)) missing.push_back(v);
    for (const int v : missing) map.clear(v);

    std::vector<int> scaled;
    for (int f = 0; f < map.source().face_count(); ++f)
        for (int k = 0; k < 3; ++k)
            if (open[std::size_t(map.source().faces(f, k))]) {
                scaled.push_back(f);
                break;
            }
    map.scale_rest(scaled, scale * scale);
    LocalRelaxation relaxation(map, 7);
    std::vector<std::vector<int>> rings;
    std::vector<char> held(open.size(), 1);  ///< all but what has been placed
    while (!missing.empty()) {
        std::vector<Placement> placements;
        Placement placement;
        for (const int v : front_of(map, missing))
            if (predict(map, v, scale, placement)) placements.push_back(placement);
        if (placements.empty()) break;
        rings.emplace_back();
        for (const Placement& p : placements) {
            map.place(p.vertex, p.point);
            rings.back().push_back(p.vertex);
        }
        std::erase_if(missing, [&](int v) { return map.has_image(v); });
        std::vector<int> band;
        for (std::size_t r = rings.size() > relaxed_rings ? rings.size() - relaxed_rings : 0;
             r < rings.size(); ++r)
            band.insert(band.end(), rings[r].begin(), rings[r].end());
        for (int s = 0; s < sweeps_per_ring; ++s) relaxation.sweep(band, front_energy, false);
        for (const int v : rings.back()) held[std::size_t(v)] = 0;
        if (rings.size() % rings_per_step == 0 || missing.empty()) {
            GlobalRelaxation global(map, held);
            global.step(front_energy, robustness);
        }
    }
    map.scale_rest(scaled, 1 / (scale * scale));
    for (const int v : missing) map.place(v, before[std::size_t(v)]);
}

}  // namespace varimap
