#include "stages/locate/anchors.h"

#include <algorithm>
#include <cmath>

#include "stages/locate/starts.h"
#include "varimap/core/statistics.h"
#include "varimap/mesh/face_geometry.h"

namespace varimap {

namespace {

constexpr std::size_t anchor_count = 10;
constexpr double short_length = 0.01;  ///< added to lengths, which hardly count below that; sqrt(area)
constexpr double most_change = 1;
constexpr int smoothings = 3;

/// Per vertex the mean |log| of how much its edges' lengths change.
Eigen::VectorXd length_changes(const PointMap& images, const TriangleMesh& part, const TriangleMesh& whole,
                               double root) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(part.vertex_count()), count = sum;
    for (int f = 0; f < part.face_count(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int u = part.faces(f, k), v = part.faces(f, (k + 1) % 3);
            const double here = root * (part.vertex(u) - part.vertex(v)).norm(),
                         there = (position(whole, images[std::size_t(u)]) -
                                  position(whole, images[std::size_t(v)]))
                                     .norm();
            const double change =
                std::min(std::abs(std::log((there + short_length) / (here + short_length))), most_change);
            for (const int corner : {u, v}) sum[corner] += change, count[corner] += 1;
        }
    return sum.cwiseQuotient(count.cwiseMax(1));
}

/// Means over the corners of the faces around each vertex.
Eigen::VectorXd smoothed(const Eigen::VectorXd& values, const TriangleMesh& mesh) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(values.size()), count = sum;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.faces.row(f);
        const double of_face = (values[corners[0]] + values[corners[1]] + values[corners[2]]) / 3;
        for (const int v : corners) sum[v] += of_face, count[v] += 1;
    }
    return sum.cwiseQuotient(count.cwiseMax(1));
}

/// The vertex of least value, and others far from each other whose values are at most the median.
std::vector<int> anchors(const Eigen::VectorXd& values, const GeodesicGraph& graph) {
    const double limit = upper_median(values);
    int first = 0;
    values.minCoeff(&first);
    std::vector<int> chosen{first};
    Eigen::RowVectorXd distance = distances_from_each(graph, chosen).row(0);
    while (chosen.size() < anchor_count) {
        int farthest = -1;
        for (int v = 0; v < int(values.size()); ++v)
            if (values[v] <= limit && distance[v] > 0 && (farthest < 0 || distance[v] > distance[farthest]))
                farthest = v;
        if (farthest < 0) break;
        chosen.push_back(farthest);
        distance = distance.cwiseMin(distances_from_each(graph, {farthest}).row(0));
    }
    return chosen;
}

}  // namespace

PointMap images_by_anchors(const PointMap& placement, const Sketches& sketches, double share) {
    const TriangleMesh &part = sketches.part.mesh(), &whole = sketches.whole.mesh();
    const double root = std::sqrt(share);
    Eigen::VectorXd changes = length_changes(placement, part, whole, root);
    for (int i = 0; i < smoothings; ++i) changes = smoothed(changes, part);
    const std::vector<int> on_part = anchors(changes, sketches.part.graph);
    std::vector<int> on_whole;
    for (const int v : on_part) on_whole.push_back(nearest_vertex(whole, placement[std::size_t(v)]));
    return images_alike_far(root * distances_from_each(sketches.part.graph, on_part).transpose(),
                            distances_from_each(sketches.whole.graph, on_whole).transpose(), whole);
}

}  // namespace varimap
