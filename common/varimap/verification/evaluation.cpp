#include "varimap/verification/evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "varimap/core/error.h"
#include "varimap/core/parallel.h"
#include "varimap/core/statistics.h"
#include "varimap/geodesics/geodesic.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

PointPairs pairs_of(const PointMap& map, const TriangleMesh& target, const std::vector<int>& source_points,
                    const std::vector<int>& target_points, const std::string& name) {
    if (source_points.size() != target_points.size())
        throw InputError(fmt::format("{} points on the source but {} on the target; they match row by row",
                                     source_points.size(), target_points.size()));
    const PointMap at_vertex = points_at_vertices(target);
    PointPairs pairs;
    for (size_t i = 0; i < source_points.size(); ++i) {
        const int s = source_points[i], t = target_points[i];
        if (s < 0 || size_t(s) >= map.size())
            throw InputError(fmt::format("row {} of the source's points: vertex {}, but {} has {} rows",
                                         i + 1, s, name, map.size()));
        if (t < -1 || t >= target.vertex_count())
            throw InputError(fmt::format("row {} of the target's points: vertex {}, but the mesh has {}",
                                         i + 1, t, target.vertex_count()));
        const SurfacePoint image = map[size_t(s)];
        if (image.face >= target.face_count())
            throw InputError(fmt::format("{} sends vertex {} to face {}, but the target has {} faces", name,
                                         s, image.face, target.face_count()));
        if (t >= 0 && at_vertex[size_t(t)].face < 0 && image.face >= 0)
            throw InputError(
                fmt::format("row {} of the target's points: vertex {} belongs to no face", i + 1, t));
        pairs.emplace_back(image, t < 0 ? SurfacePoint{} : at_vertex[size_t(t)]);
    }
    return pairs;
}

/// See MapErrors::smoothed_mean; of at most 2'000 of the pairs, evenly spread over their list.
std::optional<double> smoothed_mean(const PointPairs& pairs, const TriangleMesh& target, double unit) {
    constexpr std::size_t dense = 500, looked_at = 2000;
    constexpr int neighbours = 12;
    const auto count = Eigen::Index(pairs.size());
    if (pairs.size() < dense) return {};
    Points truth(count, 3), displacement(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto& [image, belongs] = pairs[std::size_t(i)];
        truth.row(i) = position(target, belongs).transpose();
        displacement.row(i) = position(target, image).transpose() - truth.row(i);
    }
    std::vector<double> lengths(std::min(pairs.size(), looked_at));
    parallel_for_each_index(lengths.size(), std::size_t(16), [&](std::size_t k) {
        const auto at = Eigen::Index(k * pairs.size() / lengths.size());
        const Eigen::VectorXd far = (truth.rowwise() - truth.row(at)).rowwise().squaredNorm();
        std::vector<Eigen::Index> nearest(pairs.size());
        std::iota(nearest.begin(), nearest.end(), Eigen::Index(0));
        std::partial_sort(
            nearest.begin(), nearest.begin() + neighbours, nearest.end(),
            [&](Eigen::Index a, Eigen::Index b) { return std::pair(far[a], a) < std::pair(far[b], b); });
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (int n = 0; n < neighbours; ++n) sum += displacement.row(nearest[std::size_t(n)]);
        lengths[k] = sum.norm() / neighbours / unit;
    });
    return std::accumulate(lengths.begin(), lengths.end(), 0.) / double(lengths.size());
}

}  // namespace

MapErrors map_errors(const PointMap& map, const TriangleMesh& target, const std::vector<int>& source_points,
                     const std::vector<int>& target_points, const std::string& name) {
    return point_errors(pairs_of(map, target, source_points, target_points, name), target, name);
}

MapErrors point_errors(const PointPairs& images_and_truths, const TriangleMesh& target,
                       const std::string& name) {
    PointPairs pairs;
    for (const auto& pair : images_and_truths)
        if (pair.first.face >= 0 && pair.second.face >= 0) pairs.push_back(pair);
    if (pairs.empty())
        throw InputError(
            name +
            " gives an image to none of the source's points that have a place on the target; are "
            "both of the meshes it was made from?");
    const double unit = std::sqrt(surface_area(target));
    if (!(unit > 0)) throw InputError("the target mesh has no area");
    const Geodesic distance(target);
    MapErrors result{std::vector<double>(pairs.size()), int(images_and_truths.size() - pairs.size()), 0,
                     smoothed_mean(pairs, target, unit)};
    parallel_for_each_index(pairs.size(), size_t(16), [&](size_t i) {
        result.errors[i] = distance(pairs[i].first, pairs[i].second) / unit;
    });
    for (size_t i = 0; i < pairs.size(); ++i) {
        if (std::isfinite(result.errors[i])) continue;
        result.errors[i] =
            (position(target, pairs[i].first) - position(target, pairs[i].second)).norm() / unit;
        ++result.apart;
    }
    return result;
}

double MapErrors::mean() const {
    return std::accumulate(errors.begin(), errors.end(), 0.) / double(errors.size());
}

double MapErrors::median() const {
    return mean_median(errors);
}

double MapErrors::maximum() const {
    return *std::max_element(errors.begin(), errors.end());
}

double MapErrors::share_within(double bound) const {
    const auto within = std::count_if(errors.begin(), errors.end(), [&](double e) { return e <= bound; });
    return double(within) / double(errors.size());
}

std::string curve_csv(const MapErrors& errors) {
    std::string csv = "error,share\n";
    for (int i = 0; i <= 100; ++i)
        csv += fmt::format("{:.4f},{:.6f}\n", i * .0025, errors.share_within(i * .0025));
    return csv;
}

}  // namespace varimap
