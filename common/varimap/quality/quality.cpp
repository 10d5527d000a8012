#include "varimap/quality/quality.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "varimap/core/index_set.h"
#include "varimap/core/parallel.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh/unit_area.h"
#include "varimap/quality/image_mesh.h"

namespace varimap {

namespace {

/// Columns of the Jacobian J of the map from the plane of a source triangle (its first edge along the first
/// axis) to the image triangle in R^3.
Eigen::Matrix<double, 3, 2> jacobian(const Vec3& e1, const Vec3& e2, const Vec3& d1, const Vec3& d2) {
    const double length = e1.norm();
    const double along = e1.dot(e2) / length;
    const double height = e1.cross(e2).norm() / length;
    Eigen::Matrix<double, 3, 2> J;
    J.col(0) = d1 / length;
    J.col(1) = (d2 - along * J.col(0)) / height;
    return J;
}

/// sigma_1 / sigma_2 = sigma_1^2 / det, with det = sigma_1 sigma_2.
double singular_value_ratio(const Eigen::Matrix<double, 3, 2>& J, double determinant) {
    const double a = J.col(0).squaredNorm(), b = J.col(1).squaredNorm(), c = J.col(0).dot(J.col(1));
    const double largest = (a + b + std::hypot(a - b, 2 * c)) / 2;
    return largest < conformal_distortion_cap * determinant ? std::max(1.0, largest / determinant)
                                                            : conformal_distortion_cap;
}

TriangleDistortion measure_triangle(const ImageMesh& images, int f) {
    TriangleDistortion result;
    if (!images.is_mapped(f) || is_degenerate(images.source, f)) return result;
    const auto corners = images.source.faces.row(f);
    const auto edge = [&](const TriangleMesh& mesh, int k) {
        return Vec3(mesh.vertex(corners[k]) - mesh.vertex(corners[0]));
    };
    result.area = face_normal(images.source, f).norm() / 2;
    const auto J = jacobian(edge(images.source, 1), edge(images.source, 2), edge(images.image, 1),
                            edge(images.image, 2));
    result.squared_norm = J.squaredNorm();
    result.collapsed = is_degenerate(images.image, f);
    result.flipped = result.collapsed || images.facing(f) <= 0;
    result.area_ratio = result.collapsed ? 0 : face_normal(images.image, f).norm() / (2 * result.area);
    result.conformal =
        result.collapsed ? conformal_distortion_cap : singular_value_ratio(J, result.area_ratio);
    return result;
}

/// Values in ascending order with the weight up to and including each.
std::vector<std::pair<double, double>> cumulated(const std::vector<double>& values,
                                                 const std::vector<double>& weights) {
    std::vector<std::pair<double, double>> sorted(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) sorted[i] = {values[i], weights[i]};
    std::sort(sorted.begin(), sorted.end());
    double sum = 0;
    for (auto& [value, weight] : sorted) weight = sum += weight;
    return sorted;
}

double at_share(const std::vector<std::pair<double, double>>& sorted, double share) {
    if (sorted.empty()) return 0;
    const double weight = share * sorted.back().second;
    const auto found = std::partition_point(sorted.begin(), sorted.end(),
                                            [&](const auto& entry) { return entry.second < weight; });
    return found == sorted.end() ? sorted.back().first : found->first;
}

}  // namespace

double weighted_quantile(const std::vector<double>& values, const std::vector<double>& weights,
                         double share) {
    return at_share(cumulated(values, weights), share);
}

Quantiles weighted_quantiles(const std::vector<double>& values, const std::vector<double>& weights) {
    const auto sorted = cumulated(values, weights);
    return {at_share(sorted, 0.01), at_share(sorted, 0.05), at_share(sorted, 0.5), at_share(sorted, 0.95),
            at_share(sorted, 0.99)};
}

FaceData<TriangleDistortion> measure_triangles(const PointMap& map, const TriangleMesh& source,
                                               const TriangleMesh& target) {
    const ImageMesh images(map, source, target);
    FaceData<TriangleDistortion> triangles(source.face_count());
    parallel_for_each_index<int>(source.face_count(), 1024,
                                 [&](int f) { triangles[f] = measure_triangle(images, f); });
    return triangles;
}

Distortion measure_distortion(const FaceData<TriangleDistortion>& triangles) {
    Distortion total;
    std::vector<double> areas, ratios, conformals;
    double area = 0, flipped_area = 0;
    for (const auto& triangle : triangles) {
        if (triangle.area == 0) continue;
        areas.push_back(triangle.area);
        ratios.push_back(triangle.area_ratio);
        conformals.push_back(triangle.conformal);
        area += triangle.area;
        if (triangle.flipped) flipped_area += triangle.area;
        total.flipped_count += triangle.flipped;
        total.collapsed_count += triangle.collapsed;
        total.dirichlet_energy += triangle.area * triangle.squared_norm / 2;
    }
    total.flipped_area_percent = area > 0 ? 100 * flipped_area / area : 0;
    total.area_ratio = weighted_quantiles(ratios, areas);
    total.conformal_distortion = weighted_quantiles(conformals, areas);
    return total;
}

Distortion measure_distortion(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target) {
    return measure_distortion(measure_triangles(map, source, target));
}

double share_within_area_bound(const FaceData<TriangleDistortion>& triangles, const TriangleMesh& source,
                               double bound) {
    VertexData<double> area(source.vertex_count(), 0), image(source.vertex_count(), 0);
    for (int f = 0; f < source.face_count(); ++f)
        for (int k = 0; k < 3; ++k) {
            area[source.faces(f, k)] += triangles[f].area;
            image[source.faces(f, k)] += triangles[f].area * triangles[f].area_ratio;
        }
    constexpr double rounding = 1 + 1e-9, least_bound = 1.05;
    const double factor = std::max(bound, least_bound) * rounding;
    double within = 0, all = 0;
    for (int v = 0; v < source.vertex_count(); ++v) {
        all += area[v];
        if (image[v] <= area[v] * factor && image[v] * factor >= area[v]) within += area[v];
    }
    return all > 0 ? within / all : 0;
}

RoundTrip measure_round_trip(const PointMap& A_to_B, const PointMap& B_to_A, const TriangleMesh& A,
                             const TriangleMesh& B) {
    const TriangleMesh unit = unit_area(A);
    const ImageMesh back(B_to_A, B, A);
    const VertexData<double> weights = vertex_areas(unit);
    std::vector<double> distances, used;
    double sum = 0, weight = 0;
    for (int v = 0; v < A.vertex_count(); ++v) {
        const SurfacePoint& there = A_to_B[v];
        if (there.face < 0 || !back.is_mapped(there.face)) continue;
        distances.push_back((position(back.image, there) - unit.vertex(v)).norm());
        used.push_back(weights[v]);
        sum += distances.back() * used.back();
        weight += used.back();
    }
    return {weight > 0 ? sum / weight : 0, weighted_quantile(distances, used, 0.95)};
}

namespace {

/// Those that share a face with a corner which the point lies at, but those corners; ascending.
std::vector<int> vertices_around(const SurfacePoint& point, const TriangleMesh& mesh,
                                 const Adjacency& faces_of_vertex) {
    std::vector<int> at, around;
    for (const auto [vertex, weight] : WeightedCorners(mesh, point)) at.push_back(vertex);
    for (const int v : at)
        for (const int f : faces_of_vertex[v])
            for (int k = 0; k < 3; ++k) around.push_back(mesh.faces(f, k));
    make_set(around);
    std::erase_if(around, [&](int v) { return std::find(at.begin(), at.end(), v) != at.end(); });
    return around;
}

}  // namespace

std::vector<double> landmark_residuals(const PointMap& map, const PointPairs& landmarks,
                                       const TriangleMesh& source, const TriangleMesh& target) {
    const double length = std::sqrt(surface_area(target));
    std::vector<double> residuals;
    for (const auto& [from, to] : landmarks) {
        const StraightImage image = straight_image(from, map, source, target);
        const Vec3 place = image.is_whole ? image.place : Vec3(image.place / image.share);
        residuals.push_back(image.share > 0 ? (place - position(target, to)).norm() / length : 0);
    }
    return residuals;
}

std::vector<LandmarkSurroundings> landmark_surroundings(const PointMap& map, const PointPairs& landmarks,
                                                        const TriangleMesh& source,
                                                        const TriangleMesh& target) {
    const double length_there = std::sqrt(surface_area(target)), length = std::sqrt(surface_area(source));
    const Adjacency faces_of_vertex = vertex_faces(source);
    std::vector<LandmarkSurroundings> result;
    for (const auto& [from, to] : landmarks) {
        Vec3 mean = Vec3::Zero();
        double radius = 0;
        int count = 0;
        for (const int v : vertices_around(from, source, faces_of_vertex)) {
            if (map[v].face < 0) continue;
            mean += position(target, map[v]);
            radius += (source.vertex(v) - position(source, from)).norm();
            ++count;
        }
        if (count == 0)
            result.emplace_back();
        else
            result.push_back({(mean / count - position(target, to)).norm() / length_there,
                              radius / count / length, mean / count});
    }
    return result;
}

std::vector<std::pair<int, int>> exchanged_landmarks(const std::vector<LandmarkSurroundings>& surroundings,
                                                     const PointPairs& landmarks,
                                                     const TriangleMesh& target) {
    const double length = std::sqrt(surface_area(target));
    std::vector<int> off;
    for (int k = 0; k < int(surroundings.size()); ++k)
        if (surroundings[k].distance > surroundings[k].radius) off.push_back(k);
    // From where the surroundings of i are taken to the partner of j.
    const auto distance = [&](int i, int j) {
        return (surroundings[i].image - position(target, landmarks[j].second)).norm() / length;
    };
    const auto nearest_other = [&](int i) {
        int nearest = -1;
        for (const int j : off)
            if (j != i && (nearest < 0 || distance(i, j) < distance(i, nearest))) nearest = j;
        return nearest;
    };
    std::vector<int> nearest(surroundings.size(), -1);
    for (const int i : off) nearest[i] = nearest_other(i);
    std::vector<std::pair<int, int>> exchanged;
    for (const int i : off) {
        const int j = nearest[i];
        if (j <= i || nearest[j] != i) continue;
        if (distance(i, j) < surroundings[i].distance / 2 && distance(j, i) < surroundings[j].distance / 2)
            exchanged.emplace_back(i, j);
    }
    return exchanged;
}

}  // namespace varimap
