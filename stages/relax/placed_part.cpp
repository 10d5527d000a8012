#include "stages/relax/placed_part.h"

#include <algorithm>
#include <utility>

#include "varimap/core/log.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/quality/quality.h"
#include "varimap/sliding/inverse_map.h"
#include "varimap/surface/input_locator.h"

namespace varimap {

namespace {

/// Disorder of maps that are as good as they get. Of 20 parts of people and animals, cut at random, all maps
/// below it were right.
constexpr double in_order = 0.004;

/// `there`: from the part's mesh to the whole's. Vertices keep their images where none was placed around
/// them.
void lay_where_placed(PointMap& there, const PointMap& on_input, const Surface& part, const Surface& whole) {
    const MeshLocator on_mesh(whole);
    const ClosestPoint closest(whole.mesh);
    constexpr double half = 0.5;  // the rest of a face need not say where a point goes
    for (std::size_t v = 0; v < there.size(); ++v) {
        const SurfacePoint& at = part.on_input[v];
        if (at.face < 0) continue;
        const StraightImage image = straight_image(at, part.input, whole.mesh, [&](int corner) {
            const SurfacePoint& placed = on_input[std::size_t(corner)];
            return placed.face < 0 ? placed : on_mesh(placed);
        });
        if (image.share > half) there[v] = closest(image.place / image.share, image.normal).point;
    }
}

/// The images of `planned` where the region says nothing.
MapPair placed_maps(const PartRegion& region, const Surface& A, const Surface& B, const PairRecord& record,
                    const MapPair& planned) {
    const Surface &part = region.part_is_source ? A : B, &whole = region.part_is_source ? B : A;
    MapPair maps = planned;
    PointMap& there = region.part_is_source ? maps.A_to_B : maps.B_to_A;
    PointMap& back = region.part_is_source ? maps.B_to_A : maps.A_to_B;
    lay_where_placed(there, from_file(region.placed, part, whole), part, whole);
    back = laid_by_inverse(std::move(back), there, whole.mesh, part.mesh,
                           VertexData<bool>(whole.mesh.vertex_count(), true));
    pin_landmarks(maps, record, A, B);
    return maps;
}

/// What is wrong with a map: the mean way of the part's vertices there and back (measure_round_trip, in units
/// of sqrt(area of the part)), and the share of the area that is reversed in both directions, beyond that of
/// maps that do not tear.
double disorder(const SurfaceMap& map, bool part_is_source, const Surface& A, const Surface& B) {
    const PointMap A_to_B = from_file(map.A_to_B, A, B), B_to_A = from_file(map.B_to_A, B, A);
    const RoundTrip way = part_is_source ? measure_round_trip(A_to_B, B_to_A, A.input, B.input)
                                         : measure_round_trip(B_to_A, A_to_B, B.input, A.input);
    const double reversed_percent =
        map.untangling.A_to_B.flipped_area_percent_after + map.untangling.B_to_A.flipped_area_percent_after;
    constexpr double little_reversed = 2;
    return way.mean + std::max(0.0, reversed_percent - little_reversed) / 100;
}

}  // namespace

SurfaceMap relax_part(const Surface& A, const Surface& B, const PairRecord& record, const MapPair& planned,
                      const PartRegion& region, double area_bound, const RelaxParams& params) {
    require_places(region, file_of(region.part_is_source ? A : B), file_of(region.part_is_source ? B : A));
    SurfaceMap map = relax(A, B, record, planned, area_bound, params);
    const bool was_chosen = !record.candidates.empty();
    if (!params.untangling.enabled || region.is_strained() || was_chosen) return map;
    const double planned_disorder = disorder(map, region.part_is_source, A, B);
    if (planned_disorder < in_order) return map;
    log("from where the part was placed:");
    SurfaceMap other = relax(A, B, record, placed_maps(region, A, B, record, planned), area_bound, params);
    const double placed_disorder = disorder(other, region.part_is_source, A, B);
    log("way there and back and share reversed: {:.4f} from the plan, {:.4f} from there", planned_disorder,
        placed_disorder);
    if (placed_disorder < planned_disorder) return other;
    return map;
}

}  // namespace varimap
