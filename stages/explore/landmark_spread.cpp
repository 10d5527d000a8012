#include "stages/explore/landmark_spread.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "varimap/core/rotation.h"
#include "varimap/geodesics/geodesic_graph.h"

namespace varimap {

namespace {

constexpr double far = 0.3;  // units of sqrt(area); chosen by hand on people

/// Landmarks x landmarks, along A.
RowMatrix distances_between_landmarks(const PairContext& context) {
    const std::vector<int>& landmarks = context.landmarks_A();
    return distances_from_each(context.graph_A(), landmarks)(Eigen::all, landmarks);
}

/// By how much the way from one end to the other is longer by the third, whichever that is.
double detour(double a, double b, double c) {
    return a + b + c - 2 * std::max({a, b, c});
}

Points centred(const Points& points) {
    return points.rowwise() - points.colwise().mean();
}

/// What the best similarity leaves between points and their partners, both about their centroids: the root of
/// the mean square, times that of their distances from it.
double misfit(const Points& from, const Points& to, bool mirrored) {
    const Eigen::Matrix3d turn = nearest_rotation(from, to, Eigen::VectorXd::Ones(from.rows()), mirrored);
    const double common = (from * turn.transpose()).cwiseProduct(to).sum();
    return std::sqrt(std::max(0.0, 1 - common * common / (from.squaredNorm() * to.squaredNorm())));
}

}  // namespace

int landmarks_apart(const PairContext& context) {
    const RowMatrix distance = distances_between_landmarks(context);
    std::vector<int> apart;
    for (int k = 0; k < int(distance.rows()); ++k)
        if (std::all_of(apart.begin(), apart.end(), [&](int other) { return distance(other, k) > far; }))
            apart.push_back(k);
    return int(apart.size());
}

bool landmarks_span(const PairContext& context) {
    // Chosen by hand. Of the ends of three tools and a point on the shaft the largest detour is .015 to .041;
    // of four landmarks on people and animals (115 pairs) .44 or more.
    constexpr double in_line = 0.1;
    const RowMatrix distance = distances_between_landmarks(context);
    const int count = int(distance.rows());
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < i; ++j)
            for (int k = 0; k < j; ++k) {
                const double a = distance(i, j), b = distance(j, k), c = distance(k, i);
                if (std::min({a, b, c}) > far && detour(a, b, c) > in_line) return true;
            }
    return false;
}

bool landmarks_look_mirrored(const PairContext& context, bool opposed) {
    // Of five left bones among right ones .14 to .47; of 34 right pairs .88 or more.
    constexpr double clearly = 0.7;
    if (context.landmarks().size() < 4) return false;
    const Points a = centred(context.A().surface.mesh.vertices(context.landmarks_A(), Eigen::all)),
                 b = centred(context.B().surface.mesh.vertices(context.landmarks_B(), Eigen::all));
    return misfit(a, b, !opposed) < clearly * misfit(a, b, opposed);
}

}  // namespace varimap
