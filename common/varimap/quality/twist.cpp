#include "varimap/quality/twist.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace varimap {

namespace {

// Chosen by hand on people and animals, with doubtful_twist (results/choice.h).
constexpr double least_area = 0.15, least_explained = 0.25;

Twist twist_of(const Tube& tube, const Rings& rings) {
    double area = 0, explained = 0, in_all = 0;
    for (std::size_t i = 0; i < tube.size(); ++i) {
        const Ring& ring = rings[tube[i]];
        area += ring.area;
        if (i == 0 || i + 1 == tube.size() || !(ring.weight > 0)) continue;
        explained += ring.along * ring.along / ring.weight;
        in_all += ring.along_squared;
    }
    if (area < least_area || explained < least_explained * in_all) return {};
    double sum = 0, least = 0, most = 0;
    for (const double turn : turns(tube, rings)) {
        sum += turn;
        least = std::min(least, sum);
        most = std::max(most, sum);
    }
    return {(most - least) * 180 / std::numbers::pi, rings[tube[tube.size() / 2]].vertex, area};
}

}  // namespace

TwistedTube most_twisted(const Rings& rings) {
    TwistedTube worst;
    for (Tube& tube : tubes(rings))
        if (const Twist twist = twist_of(tube, rings); twist.degrees > worst.twist.degrees)
            worst = {std::move(tube), twist};
    return worst;
}

Twist measure_twist(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target) {
    if (source.face_count() == 0) return {};
    return most_twisted(Rings(ImageMesh(map, source, target))).twist;
}

}  // namespace varimap
