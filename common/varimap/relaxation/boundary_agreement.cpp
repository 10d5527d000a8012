#include "varimap/relaxation/boundary_agreement.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "varimap/mesh/closest_point.h"

namespace varimap {

namespace {

constexpr double most_longer = 2;
constexpr double radius = 0.05;  ///< of the constraints, in sqrt(area), as of those of the inverse

/// The point of a loop, given by its edges, that is closest to x.
Vec3 closest_on_loop(const Vec3& x, const TriangleMesh& mesh, const std::vector<std::array<int, 2>>& loop) {
    Vec3 closest = x;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : loop) {
        const Vec3 from = mesh.vertex(a), to = mesh.vertex(b);
        const Vec3 point = from + closest_on_segment(x, from, to) * (to - from);
        if (const double d = (point - x).squaredNorm(); d < least) least = d, closest = point;
    }
    return closest;
}

std::vector<std::vector<std::array<int, 2>>> edges_of_loops(const Boundary& boundary) {
    std::vector<std::vector<std::array<int, 2>>> edges(std::size_t(boundary.loops));
    for (std::size_t i = 0; i < boundary.edges.size(); ++i)
        edges[std::size_t(boundary.loop[i])].push_back(boundary.edges[i]);
    return edges;
}

}  // namespace

std::vector<BoundaryAgreement::Vertex> BoundaryAgreement::vertices_of(const TriangleMesh& mesh,
                                                                      const Boundary& boundary) {
    std::vector<Vertex> vertices;
    if (boundary.loops == 0) return vertices;
    VertexData<double> lengths(mesh.vertex_count(), 0);
    VertexData<int> loops(mesh.vertex_count(), -1);
    for (std::size_t i = 0; i < boundary.edges.size(); ++i) {
        const auto [a, b] = boundary.edges[i];
        for (const int v : {a, b}) {
            lengths[v] += (mesh.vertex(a) - mesh.vertex(b)).norm() / 2;
            loops[v] = boundary.loop[i];
        }
    }
    const PointMap points = points_at_vertices(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (loops[v] >= 0) vertices.push_back({v, loops[v], lengths[v], points[std::size_t(v)]});
    return vertices;
}

/// Per loop of the source and of the target: the mean distance of the images of the one from the other;
/// infinite where there are none.
Eigen::MatrixXd BoundaryAgreement::mean_distances() const {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(source_.loops, target_.loops);
    Eigen::VectorXd lengths = Eigen::VectorXd::Zero(source_.loops);
    for (const Vertex& on : vertices_) {
        if (!map_.has_image(on.vertex)) continue;
        const Vec3& image = map_.image(on.vertex);
        for (int j = 0; j < target_.loops; ++j)
            sums(on.loop, j) +=
                on.length *
                (closest_on_loop(image, map_.target(), target_loops_[std::size_t(j)]) - image).norm();
        lengths[on.loop] += on.length;
    }
    for (int i = 0; i < source_.loops; ++i)
        if (lengths[i] > 0)
            sums.row(i) /= lengths[i];
        else
            sums.row(i).setConstant(std::numeric_limits<double>::infinity());
    return sums;
}

BoundaryAgreement::BoundaryAgreement(const SlidingMap& map)
    : map_(map),
      source_(find_boundary(map.source())),
      target_(find_boundary(map.target())),
      target_loops_(edges_of_loops(target_)),
      vertices_(vertices_of(map.source(), source_)),
      partner_(std::size_t(source_.loops), -1) {}

void BoundaryAgreement::match() {
    std::fill(partner_.begin(), partner_.end(), -1);
    if (source_.loops == 0 || target_.loops == 0) return;
    const Eigen::MatrixXd distance = mean_distances();
    const std::vector<double> there = loop_lengths(map_.source(), source_),
                              here = loop_lengths(map_.target(), target_);
    for (int i = 0; i < source_.loops; ++i) {
        Eigen::Index j = 0, back = 0;
        const double least = distance.row(i).minCoeff(&j);
        distance.col(j).minCoeff(&back);
        const double a = there[std::size_t(i)], b = here[std::size_t(j)];
        if (back == i && 2 * std::numbers::pi * least < a && std::max(a, b) <= most_longer * std::min(a, b))
            partner_[std::size_t(i)] = int(j);
    }
}

std::vector<SoftConstraint> BoundaryAgreement::constraints(double weight) const {
    std::vector<SoftConstraint> constraints;
    for (const Vertex& on : vertices_) {
        const int loop = partner_[std::size_t(on.loop)];
        if (loop < 0 || !map_.is_mapped(on.point.face)) continue;
        const Vec3 closest =
            closest_on_loop(map_.image(on.vertex), map_.target(), target_loops_[std::size_t(loop)]);
        constraints.push_back({on.point, closest, weight * on.length, radius});
    }
    return constraints;
}

}  // namespace varimap
