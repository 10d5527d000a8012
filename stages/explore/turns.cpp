#include "stages/explore/turns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <utility>

#include "stages/explore/principal_axes.h"
#include "varimap/core/log.h"
#include "varimap/core/timing.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/interpolation.h"

namespace varimap {

namespace {

using Turn = Eigen::Matrix3d;

Points turned(const Points& points, const Turn& turn) {
    return points * turn.transpose();
}

PointMap closest_points(const ClosestPoint& closest, const Points& places) {
    PointMap map;
    for (Eigen::Index i = 0; i < places.rows(); ++i) map.push_back(closest(places.row(i).transpose()).point);
    return map;
}

/// Mean distance of some two hundred turned vertices from the surface. Units of sqrt(area).
double distance_from_itself(const Surface& surface, const ClosestPoint& closest, const Turn& turn) {
    const int count = surface.mesh.vertex_count(), stride = std::max(1, count / 200);
    double sum = 0, mass = 0;
    for (int v = 0; v < count; v += stride) {
        sum += surface.mass[v] * std::sqrt(closest(turn * surface.mesh.vertex(v)).squared_distance);
        mass += surface.mass[v];
    }
    return mass > 0 ? sum / mass : 0;
}

/// Turns about the principal axes that lay a surface nearly on itself.
std::vector<Turn> turns_onto_itself(const SurfaceComponents& components, const Surface& surface,
                                    const ClosestPoint& closest) {
    // Of people and animals the least are .019 to .04. A lamp whose foot tells how it stands has .016 to .03.
    const double near = components.are_several() ? 0.03 : 0.015;
    constexpr int angles = 24;
    std::vector<Turn> turns;
    const PrincipalAxes principal = principal_axes(surface);
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 1; k < angles; ++k) {
            const double angle = 2 * std::numbers::pi * k / angles;
            const Turn turn(Eigen::AngleAxisd(angle, principal.axes.col(axis).normalized()));
            if (distance_from_itself(surface, closest, turn) < near) turns.push_back(turn);
        }
    return turns;
}

/// A map and its inverse, composed with turns of its surfaces.
class TurnedMaps {
  public:
    TurnedMaps(const MapPair& maps, const PairContext& context, const Appraisal& appraisal)
        : A_(context.A().surface),
          B_(context.B().surface),
          components_A_(appraisal.components_A()),
          components_B_(appraisal.components_B()),
          A_on_B_(positions(B_.mesh, maps.A_to_B)),
          B_on_A_(positions(A_.mesh, maps.B_to_A)),
          on_A_(A_.mesh),
          on_B_(B_.mesh) {}

    std::vector<MapPair> all() const {
        std::vector<MapPair> result;
        for (const Turn& turn : turns_onto_itself(components_A_, A_, on_A_))
            result.push_back(after_turn_of_A(turn));
        for (const Turn& turn : turns_onto_itself(components_B_, B_, on_B_))
            result.push_back(before_turn_of_B(turn));
        return result;
    }

    std::vector<MapPair> by_halves() const {
        const PrincipalAxes principal = principal_axes(B_);
        std::vector<MapPair> result;
        for (int axis = 0; axis < 3; ++axis)
            result.push_back(before_turn_of_B(
                Turn(Eigen::AngleAxisd(std::numbers::pi, principal.axes.col(axis).normalized()))));
        return result;
    }

  private:
    MapPair after_turn_of_A(const Turn& turn) const {
        return {carried(A_, on_A_, turn, A_on_B_, on_B_),
                closest_points(on_A_, turned(B_on_A_, turn.transpose()))};
    }
    MapPair before_turn_of_B(const Turn& turn) const {
        return {closest_points(on_B_, turned(A_on_B_, turn)),
                carried(B_, on_B_, turn.transpose(), B_on_A_, on_A_)};
    }
    /// Where the map that has those images of the vertices takes the turned ones.
    static PointMap carried(const Surface& from, const ClosestPoint& on_from, const Turn& turn,
                            const Points& images, const ClosestPoint& on_to) {
        const PointMap places = closest_points(on_from, turned(from.mesh.vertices, turn));
        return closest_points(on_to, pulled_back(images, from.mesh, places));
    }

    const Surface &A_, &B_;
    const SurfaceComponents &components_A_, &components_B_;
    Points A_on_B_, B_on_A_;  ///< images of the vertices
    ClosestPoint on_A_, on_B_;
};

/// With their rough scores, the best first.
std::vector<std::pair<double, MapPair>> scored(std::vector<MapPair> all, const Appraisal& appraisal) {
    std::vector<std::pair<double, MapPair>> result;
    for (MapPair& maps : all) {
        const double score = rough_score(appraisal.cues(maps));
        result.emplace_back(score, std::move(maps));
    }
    std::ranges::stable_sort(result, {}, [](const auto& one) { return one.first; });
    return result;
}

/// Mean distance between the images of two maps, of both directions.
double apart(const MapPair& a, const MapPair& b, const PairContext& context) {
    const auto mean = [](const PointMap& one, const PointMap& other, const Surface& from, const Surface& to) {
        return from.mass.dot((positions(to.mesh, one) - positions(to.mesh, other)).rowwise().norm()) /
               from.mass.sum();
    };
    const Surface &A = context.A().surface, &B = context.B().surface;
    return (mean(a.A_to_B, b.A_to_B, A, B) + mean(a.B_to_A, b.B_to_A, B, A)) / 2;
}

}  // namespace

std::vector<PooledMap> turned_by_halves(const Appraised& map, const PairContext& context,
                                        const Appraisal& appraisal) {
    constexpr std::size_t most = 2;
    const Timer timer("turns by halves");
    std::vector<PooledMap> pool;
    for (const auto& [score, maps] :
         scored(TurnedMaps(map.map.maps, context, appraisal).by_halves(), appraisal)) {
        if (pool.size() == most) break;
        log("turned by a half: score {:.2f}", score);
        pool.push_back({vertex_images(maps, context), map.candidate});
        pool.back().origin.turned_by_half = true;
    }
    return pool;
}

std::vector<PooledMap> turned_about_axes(const Appraised& map, const PairContext& context,
                                         const Appraisal& appraisal) {
    constexpr double another = 0.04;  // mean distance of images, units of sqrt(area)
    constexpr int most = 3;
    const Timer timer("turns about axes");
    const auto turned = scored(TurnedMaps(map.map.maps, context, appraisal).all(), appraisal);
    if (turned.empty()) return {};
    const double as_it_was = rough_score(appraisal.cues(map.map.maps));
    std::vector<const MapPair*> kept{&map.map.maps};
    std::vector<PooledMap> pool;
    for (const auto& [score, maps] : turned) {
        const auto is_another = [&, &now = maps](const MapPair* other) {
            return apart(now, *other, context) > another;
        };
        if (!std::all_of(kept.begin(), kept.end(), is_another)) continue;
        log("turned about an axis: score {:.2f}, as it was {:.2f}", score, as_it_was);
        kept.push_back(&maps);
        pool.push_back({vertex_images(maps, context), map.candidate});
        pool.back().origin.turned_about_axis = true;
        if (int(pool.size()) == most) break;
    }
    return pool;
}

}  // namespace varimap
