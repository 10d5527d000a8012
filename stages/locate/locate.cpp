#include "stages/locate/locate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "stages/locate/region.h"
#include "stages/locate/search.h"
#include "stages/locate/sides.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/topology.h"
#include "varimap/multilevel/exchanged_landmarks.h"
#include "varimap/results/landmark_words.h"
#include "varimap/surface/input_locator.h"

namespace varimap {

namespace {

constexpr std::size_t grain = 256;  ///< points worth a task

/// Images on a whole's sketch carried to its surface, by way of the inputs.
PointMap on_surfaces(const PointMap& images, const Sides& sketch, const Sides& surface) {
    const MeshLocator on_sketch(sketch.part);
    const ClosestPoint closest(surface.whole.mesh);
    PointMap result(surface.part.on_input.size());
    parallel_for_each_index(result.size(), grain, [&](std::size_t v) {
        const StraightImage image =
            straight_image(on_sketch(surface.part.on_input[v]), images, sketch.part.mesh, sketch.whole.mesh);
        const Vec3 on_whole = image.place / sketch.whole.scale + sketch.whole.centre;
        const Vec3 place = (on_whole - surface.whole.centre) * surface.whole.scale;
        result[v] = closest(place, image.normal).point;
    });
    return result;
}

/// Images of the vertices of the part's file on the whole's.
PointMap on_files(const PointMap& images, const Sides& sides) {
    const InputLocator on_input(sides.whole);
    PointMap result(sides.part.on_mesh.size());
    parallel_for_each_index(result.size(), grain, [&](std::size_t v) {
        const SurfacePoint& at = sides.part.on_mesh[v];
        if (at.face < 0) return;
        const StraightImage image = straight_image(at, images, sides.part.mesh, sides.whole.mesh);
        result[v] = on_input(image.place, image.normal);
    });
    return to_file(std::move(result), sides.part, sides.whole);
}

/// Found on the sketches, placed on the surfaces.
FoundPlacement find_on_surfaces(const PairContext& sketches, const Sides& surface, double share,
                                const LocateParams& params) {
    const Sides sketch(sketches.A().surface, sketches.B().surface, sketches.landmarks(), params.part);
    FoundPlacement found = find_placement(Sketches(sketches, params.part), sketch, share, params);
    found.placement = pinned_placement(on_surfaces(found.placement.images, sketch, surface), surface, share,
                                       surface.reliefs(), params.placing);
    return found;
}

void warn_of_strain(double strain, PartSide part, bool has_landmarks) {
    if (strain > PartRegion::much_strain)
        warn(
            "the {} had to be strained to lie on the {} (by {:.2f}): is it a part of it{}? Look at the "
            "picture, {}; if it is all there but for holes, give --fill-holes all instead of --part",
            part == PartSide::source ? "source" : "target", part == PartSide::source ? "target" : "source",
            strain, has_landmarks ? ", and are the landmarks right" : "",
            has_landmarks ? "and give more landmarks" : "and give landmarks");
}

/// Names landmarks with which the part would be hardly strained if they were exchanged, as left and right:
/// placed by them alone, which the right ones lead to at once.
void warn_of_exchange(double strain, const PairContext& sketches, const Surface& A, const Surface& B,
                      const VertexPairs<MeshVertex>& landmarks, double share, LocateParams params) {
    const double scale = params.part == PartSide::source ? std::sqrt(share) : 1 / std::sqrt(share);
    if (sketches.landmarks().size() < landmarks.size()) return;  // their rows differ
    const Exchange exchange = likely_exchange(sketches, scale);
    if (exchange.empty()) return;
    const PairContext other(sketches.A(), sketches.B(), exchanged(sketches.landmarks(), exchange),
                            sketches.landmark_weight());
    const Sides surface(A, B, exchanged(landmarks, exchange), params.part);
    params.enough = std::numeric_limits<double>::infinity();
    const double otherwise =
        find_on_surfaces(other, surface, std::min(1.0, surface.size().share), params).placement.strain;
    log("landmarks {} exchanged: strain {:.4f}", exchanged_in_words(exchange), otherwise);
    if (otherwise < std::min(strain / 2, PartRegion::much_strain))
        warn(
            "landmarks {} look exchanged: with their partners exchanged the part is strained by {:.2f} "
            "only; are they left and right?",
            exchanged_in_words(exchange), otherwise);
}

/// That of the part, which is no larger than the whole.
double known_share(const PartSize& size, const Sides& surface, PartSide part) {
    log("the part has {:.1f}% of the whole's area; lengths of the whole are {:.3g} times its own",
        100 * size.share, size.scale);
    constexpr double larger = 1.1, tiny = 1e-3;
    const char* name = part == PartSide::source ? "source" : "target";
    if (!surface.landmarks_tell() && (size.share > larger || size.share < tiny))
        throw InputError(
            fmt::format("the {} has {:.2g} times the area of the other: is it really the part (--part), and "
                        "are both files in the same units? From three landmarks on (--landmarks) sizes may "
                        "differ",
                        name, size.share));
    if (size.share > larger)
        warn(
            "by its landmarks the {} has {:.2f} times the area of the other: is it really the part? See "
            "--part",
            name, size.share);
    return std::min(1.0, size.share);
}

/// By how much right places were better than the best ones elsewhere, and wrong ones:
/// stages/locate/README.md.
constexpr double little_lead = 0.1;

void warn_of_rivals(double lead, PartSide part) {
    if (lead < little_lead)
        warn(
            "the {} agrees with another place of the {} nearly as well (by {:.2f} less): look at the "
            "picture, and give landmarks, three tell",
            part == PartSide::source ? "source" : "target", part == PartSide::source ? "target" : "source",
            lead);
}

}  // namespace

Located locate(const PairContext& sketches, const Surface& A, const Surface& B,
               const VertexPairs<MeshVertex>& landmarks, const LocateParams& params) {
    const PartSide side = params.part;
    const Sides surface(A, B, landmarks, side);
    const PartSize size = surface.size();
    const double share = known_share(size, surface, side);
    const FoundPlacement found = find_on_surfaces(sketches, surface, share, params);
    const Placement& placement = found.placement;
    warn_of_rivals(found.lead, side);
    warn_of_strain(placement.strain, side, !landmarks.empty());
    if (surface.landmarks_tell() && placement.strain > params.enough)
        warn_of_exchange(placement.strain, sketches, A, B, landmarks, share, params);
    const TriangleMesh& whole = surface.whole.input;
    std::vector<int> region = region_of(placement, surface);
    const double area = area_of(whole, region) / surface_area(whole);
    return {{whole.face_count(), std::move(region), side == PartSide::source,
             on_files(placement.images, surface), placement.strain},
            area,
            size.scale,
            placement.strain,
            found.lead};
}

}  // namespace varimap
