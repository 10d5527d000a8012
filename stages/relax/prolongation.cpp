#include "stages/relax/prolongation.h"

#include <algorithm>

#include "varimap/core/parallel.h"
#include "varimap/core/timing.h"
#include "varimap/map_repair/chart_repair.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/subdivision.h"
#include "varimap/mesh/topology.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/relaxation/local_relaxation.h"
#include "varimap/relaxation/movable_vertices.h"
#include "varimap/untangling/rounds.h"

namespace varimap {

namespace {

/// The last level has at least this share of the input's vertices. Measured: where it has a quarter instead
/// of a half, twice as many triangles of the input are reversed at first.
constexpr double last_level = 0.5;
constexpr int sweeps = 1;
constexpr double fold_visits = 15;

/// On coarser levels discs of the target take long, and on a finer one those of the source. Measured on a
/// pair of 320,000 vertices: nowhere, on the last level but one, there and on the one before, on all leave
/// 94, 8, 12 and 7 faces reversed, in 42, 44, 51 and 78 s.
void map_folds_anew(SlidingMap& map, const VertexData<bool>& held) {
    AlongTarget along_target(map);
    NormalAgreement agreement(map, along_target);
    const PointMap unknown;
    ChartRepair(map, along_target, agreement, unknown)(held);
}

}  // namespace

Prolongation::Prolongation(const PointMap& images, const Surface& source, const Surface& target)
    : locate_(target),
      target_(normalised_input(target)),
      normals_(vertex_normals(target_)),
      level_(source.mesh),
      images_(images.size()),
      places_(source.on_mesh),
      input_vertices_(count_used_vertices(source.input)) {
    parallel_for_each_index(int(images.size()), 64,
                            [&](int v) { images_[std::size_t(v)] = locate_(images[std::size_t(v)]); });
}

PointMap Prolongation::images_of(const PointMap& points) const {
    const TriangleMesh image{positions(target_, images_), level_.faces},
        normals{pulled_back(normals_, target_, images_), level_.faces};
    PointMap result(points.size());
    parallel_for_each_index(int(points.size()), 64, [&](int i) {
        const SurfacePoint& at = points[std::size_t(i)];
        if (at.face < 0) return;
        const int v = vertex_of(level_, at), guess = images_[std::size_t(level_.faces(at.face, 0))].face;
        result[std::size_t(i)] =
            v >= 0 ? images_[std::size_t(v)] : locate_(position(image, at), position(normals, at), guess);
    });
    return result;
}

void Prolongation::relax_between(const VertexData<bool>& pinned, std::vector<SurfacePoint> landmarks,
                                 const UntanglingOptions& options) {
    const Timer timer("levels");
    relax(pinned, landmarks, options, false);
    while (!is_as_fine_as(last_level)) {
        refine();
        for (SurfacePoint& landmark : landmarks) landmark = on_subdivision(landmark);
        relax(pinned, landmarks, options,
              options.align_normals && !is_as_fine_as(last_level) && is_as_fine_as(last_level / 4));
    }
}

bool Prolongation::is_as_fine_as(double share_of_input) const {
    return level_.vertex_count() >= share_of_input * input_vertices_;
}

void Prolongation::refine() {
    Subdivision finer = subdivide(level_);
    const PointMap images = images_of(finer.midpoints);
    images_.insert(images_.end(), images.begin(), images.end());
    for (SurfacePoint& place : places_) place = on_subdivision(place);
    level_ = std::move(finer.mesh);
}

void Prolongation::relax(const VertexData<bool>& pinned, const std::vector<SurfacePoint>& landmarks,
                         const UntanglingOptions& options, bool folds_anew) {
    SlidingMap map(images_, level_, target_);
    VertexData<bool> held(level_.vertex_count());
    for (int v = 0; v < pinned.size(); ++v) held[v] = pinned[v];
    for (const SurfacePoint& landmark : landmarks) mark_corners(level_, landmark.face, held);
    std::vector<int> free = free_vertices(map, held, {});
    LocalRelaxation local(map, 99);
    for (int i = 0; i < sweeps; ++i)
        local.sweep(free, {options.area_weight, relaxation_rounds.back().regularisation});
    FoldRemoval{options.fold_sweeps, fold_visits}(map, held);
    if (folds_anew) map_folds_anew(map, held);
    images_ = map.points();
}

PointMap Prolongation::on_input() const {
    return images_of(places_);
}

}  // namespace varimap
