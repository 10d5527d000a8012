#include "stages/remesh/initial_map.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "varimap/core/statistics.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/unit_area.h"
#include "varimap/quality/quality.h"

namespace varimap {

namespace {

/// The median, so that single wrong images do not count.
double median_step(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target) {
    std::vector<double> steps;
    for (int f = 0; f < source.face_count(); ++f)
        for (int k = 0; k < 3; ++k) {
            const SurfacePoint &from = map[std::size_t(source.faces(f, k))],
                               &to = map[std::size_t(source.faces(f, (k + 1) % 3))];
            if (from.face < 0 || to.face < 0) continue;
            const double step = (position(target, from) - position(target, to)).norm();
            if (step > 0) steps.push_back(step);
        }
    return steps.empty() ? 0 : mean_median(std::move(steps));
}

}  // namespace

bool moved_far(const InitialMapQuality& moved) {
    // Medians are .007 to .013 where true maps of FAUST and TOSCA were given, .02 to .03 of SMAL's lions,
    // cows, foxes and wolves, .065 to .073 of its hippos and dogs.
    constexpr double far = 0.04, steps = 1.5;
    return moved.p50 > std::max(far, steps * moved.step);
}

InitialMapQuality measure_initial_map(const PointMap& initial, const PointMap& finished,
                                      const TriangleMesh& source, const TriangleMesh& target) {
    const TriangleMesh unit = unit_area(target);
    const VertexData<double> areas = vertex_areas(source);
    std::vector<double> distances, weights;
    double sum = 0, weight = 0;
    for (int v = 0; v < source.vertex_count(); ++v) {
        const SurfacePoint &from = initial[std::size_t(v)], &to = finished[std::size_t(v)];
        if (from.face < 0 || to.face < 0) continue;
        distances.push_back((position(unit, from) - position(unit, to)).norm());
        weights.push_back(areas[v]);
        sum += distances.back() * areas[v];
        weight += areas[v];
    }
    return {weight > 0 ? sum / weight : 0, weighted_quantile(distances, weights, 0.5),
            weighted_quantile(distances, weights, 0.95), median_step(initial, source, unit)};
}

}  // namespace varimap
