#include "stages/domain/make_domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "varimap/core/error.h"
#include "varimap/core/index_set.h"
#include "varimap/core/parallel.h"
#include "varimap/geodesics/geodesic_coordinates.h"

namespace varimap {

namespace {

/// The points nearest to one, by distance and number.
std::vector<int> nearest(int point, const Points& points, int count) {
    const Eigen::VectorXd squared = (points.rowwise() - points.row(point)).rowwise().squaredNorm();
    std::vector<int> others = all_indices(points.rows());
    others.erase(others.begin() + point);
    count = std::min(count, int(others.size()));
    std::partial_sort(others.begin(), others.begin() + count, others.end(),
                      [&](int i, int k) { return std::pair(squared[i], i) < std::pair(squared[k], k); });
    others.resize(std::size_t(count));
    return others;
}

bool same_ends(const DomainEdge& e, const DomainEdge& f) {
    return e.a == f.a && e.b == f.b;
}

/// Joins every point to its nearest ones in space, besides the edges there are.
void join_neighbours(const Points& points, int count, std::vector<DomainEdge>& edges) {
    std::vector<std::vector<int>> lists(std::size_t(points.rows()));
    parallel_for_each_index(lists.size(), std::size_t(16),
                            [&](std::size_t i) { lists[i] = nearest(int(i), points, count); });
    for (int i = 0; i < int(lists.size()); ++i)
        for (const int k : lists[std::size_t(i)])
            edges.push_back({std::min(i, k), std::max(i, k), (points.row(i) - points.row(k)).norm(), 0});
    std::sort(edges.begin(), edges.end(), [](const DomainEdge& e, const DomainEdge& f) {
        return std::pair(e.a, e.b) < std::pair(f.a, f.b);
    });
    edges.erase(std::unique(edges.begin(), edges.end(), same_ends), edges.end());
}

void require_connected(int points, const std::vector<DomainEdge>& edges, const std::string& path,
                       const char* advice) {
    if (points > int(edges.size()) + 1)
        throw InputError(
            fmt::format("{}: {} edges cannot join {} points; {}", path, edges.size(), points, advice));
    const std::vector<int> part = components(points, edges);
    const auto other = std::find_if(part.begin(), part.end(), [](int p) { return p > 0; });
    if (other != part.end())
        throw InputError(
            fmt::format("{}: falls into {} parts: point {} (from 0) is not joined to point 0; {}", path,
                        1 + *std::max_element(part.begin(), part.end()), other - part.begin(), advice));
}

/// Half of the length of the edges at each point: its share of the curve.
Eigen::VectorXd masses_along(const std::vector<DomainEdge>& edges, int points) {
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(points);
    for (const DomainEdge& edge : edges) {
        mass[edge.a] += edge.length / 2;
        mass[edge.b] += edge.length / 2;
    }
    return mass / mass.sum();
}

/// Moves points to their centroid. Returns their root mean square distance from it.
double centre(Eigen::Ref<RowMatrix> points, const Eigen::VectorXd& mass) {
    const Eigen::RowVectorXd centroid = mass.transpose() * points;
    points.rowwise() -= centroid;
    return std::sqrt(mass.dot(points.rowwise().squaredNorm()));
}

/// To the size of a sphere of unit area. Conductances are those of wires: 1 / length.
void normalise(Domain& domain) {
    RowMatrix places = domain.mesh.vertices;
    const double in_space = centre(places, domain.mass);
    const double extent = domain.coordinates.size() > 0 ? centre(domain.coordinates, domain.mass) : in_space;
    const double scale = 1 / (std::sqrt(4 * std::numbers::pi) * extent);
    domain.mesh.vertices = scale * places;
    domain.coordinates *= scale;
    for (DomainEdge& edge : domain.edges) {
        edge.length *= scale;
        edge.conductance = 1 / edge.length;
    }
}

/// Edges with their lengths, of one piece.
std::vector<DomainEdge> joined(const DomainFile& file, const DomainParams& params, const std::string& path) {
    const bool ambient = params.distances == Distances::ambient;
    std::vector<DomainEdge> edges = file.edges;
    if (file.kind != DomainKind::points)
        require_connected(file.count, edges, path, "map each part by itself");
    if (file.kind == DomainKind::graph) {
        for (DomainEdge& edge : edges)
            edge.length = ambient ? (file.positions.row(edge.a) - file.positions.row(edge.b)).norm()
                          : !file.measured && params.weights == EdgeWeights::similarity ? 1 / edge.length
                                                                                        : edge.length;
    } else if (ambient || file.kind == DomainKind::points) {
        join_neighbours(file.positions, params.neighbours, edges);
        require_connected(file.count, edges, path, "more --neighbours may join them");
    }
    return edges;
}

void require_moderate(const Domain& domain, const std::string& path) {
    for (const DomainEdge& edge : domain.edges)
        if (!(edge.length >= 1 / largest_ratio && edge.length <= largest_ratio))
            throw InputError(fmt::format(
                "{}: the edge {} {} is {:.3g} times as long as all is large; lengths may differ by {:.0e}",
                path, edge.a, edge.b, edge.length, largest_ratio));
}

/// Where the file names no places: those of the first intrinsic coordinates.
Points shown_places(const RowMatrix& coordinates) {
    Points places = Points::Zero(coordinates.rows(), 3);
    const Eigen::Index shown = std::min<Eigen::Index>(3, coordinates.cols());
    places.leftCols(shown) = coordinates.leftCols(shown);
    return places;
}

}  // namespace

Domain make_domain(const DomainFile& file, const DomainParams& params, const std::string& path) {
    const bool has_places = file.positions.rows() > 0;
    if (params.distances == Distances::ambient && !has_places)
        throw UsageError("ambient distances of a graph need --positions of its points in space");
    Domain domain;
    domain.edges = joined(file, params, path);
    domain.mass = file.kind == DomainKind::polyline ? masses_along(file.edges, file.count)
                                                    : Eigen::VectorXd::Constant(file.count, 1.0 / file.count);
    domain.mesh.vertices = has_places ? file.positions : Points(Points::Zero(file.count, 3));
    if (params.distances == Distances::intrinsic) {
        domain.coordinates = geodesic_coordinates(GeodesicGraph(domain), params.dimensions);
        if (!has_places) domain.mesh.vertices = shown_places(domain.coordinates);
    }
    normalise(domain);
    require_moderate(domain, path);
    return domain;
}

}  // namespace varimap
