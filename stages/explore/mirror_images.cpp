#include "stages/explore/mirror_images.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "stages/explore/self_maps.h"
#include "varimap/core/log.h"
#include "varimap/core/timing.h"

namespace varimap {

namespace {

/// The basis and the levels do not depend on the orientation: descriptors look outward.
SurfaceData mirror_image(SurfaceData data) {
    data.surface = with_reversed_orientation(std::move(data.surface));
    return data;
}

/// Of maps that were explored, finished: the best of `most` first.
std::vector<Appraised> best_of(const std::vector<PooledMap>& explored, const PairContext& context,
                               FinishingOptions finishing, int most) {
    finishing.most = most;
    const Appraisal appraisal(context);
    FinishedPool finished(context, std::move(finishing), appraisal);
    finished.add(explored);
    return finished.appraised();
}

/// The best maps of a surface onto its own mirror image: images of the vertices, and the first one's score.
struct OwnMirrors {
    std::vector<VertexImages> images;
    double score = std::numeric_limits<double>::infinity();
};
OwnMirrors own_mirrors(const SurfaceData& data, const ExploreParams& params,
                       const FinishingOptions& finishing) {
    constexpr int most = 2;
    const PairContext context(data, mirror_image(data), {});
    OwnMirrors own;
    const std::vector<PooledMap> found = explored(context, self_map_options(params), params);
    for (const Appraised& one : best_of(found, context, finishing, most)) {
        log("onto its own mirror image: score {:.2f}", one.candidate.score);
        own.images.push_back(vertex_images(one.map.maps, context));
        own.score = std::min(own.score, one.candidate.score);
    }
    return own;
}

}  // namespace

PairContext with_mirror_image(const PairContext& context) {
    return {context.A(), mirror_image(context.B()), context.landmarks(), context.landmark_weight()};
}

bool is_own_mirror_image(const PairContext& context) {
    const Surface &A = context.A().surface, &B = context.B().surface;
    if (A.mirrored == B.mirrored) return false;
    const TriangleMesh of_A = input_as_read(A), of_B = input_as_read(B);
    const auto same = [](const auto& one, const auto& other) {
        return one.rows() == other.rows() && one == other;
    };
    return same(of_A.vertices, of_B.vertices) && same(of_A.faces, of_B.faces);
}

std::string mirror_advice(const PairContext& context) {
    const bool opposed = context.A().surface.mirrored != context.B().surface.mirrored;
    return opposed ? "leave --mirror out" : "give --mirror";
}

MirrorImages::MirrorImages(const PairContext& context, const ExplorationProgress& coarse,
                           const ExploreParams& params, const FinishingOptions& finishing, std::size_t most)
    : context_(context), params_(params), finishing_(finishing) {
    const Timer timer("mirror images");
    const PairContext mirror = with_mirror_image(context);
    ExplorationOptions options = params.exploration;
    // The first that sees orientation: one map is finished, whose rank among the others hardly matters.
    options.last_samples = params.ironing.minimum_samples;
    std::vector<PooledMap> found = explored(mirror, coarse, options, params);
    found.resize(std::min(most, found.size()));
    best_ = best_of(found, mirror, finishing, 1).front();
}

MirrorImages::MirroredBack MirrorImages::mirrored_back() const {
    const Timer timer("mirror images");
    // Both, although one score may decide: the map is composed with those of either surface.
    const OwnMirrors of_A = own_mirrors(context_.A(), params_, finishing_),
                     of_B = own_mirrors(context_.B(), params_, finishing_);
    std::vector<PooledMap> pool{{vertex_images(best_.map.maps, context_), best_.candidate}};
    compose(pool, 1, of_A.images, of_B.images, context_);
    pool.erase(pool.begin());
    for (PooledMap& map : pool) map.origin.mirrored_back = true;
    // Chosen on a bust and a jaw, which fit their own by more than 5 better, and hands of other proportions,
    // by up to 3.
    constexpr double far_better = 4;
    return {std::move(pool), std::max(of_A.score, of_B.score) < best().score - far_better};
}

}  // namespace varimap
