#include "varimap/relaxation/boundary_agreement.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "varimap/mesh/closest_point.h"

namespace varimap {

namespace {

constexpr double most_longer = 2;
constexpr double radius = 0.05;  ///< of the constraints, in sqrt(area), as of those of the inverse

/// Per loop the point of it that is closest to x.
std::vector<Vec3> closest_on_loops(const Vec3& x, const TriangleMesh& mesh, const Boundary& boundary) {
    std::vector<Vec3> closest(std::size_t(boundary.loops));
    std::vector<double> least(closest.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < boundary.edges.size(); ++i) {
        const auto [a, b] = boundary.edges[i];
        const Vec3 from = mesh.vertex(a), to = mesh.vertex(b);
        const Vec3 point = from + closest_on_segment(x, from, to) * (to - from);
        const auto loop = std::size_t(boundary.loop[i]);
        if (const double d = (point - x).squaredNorm(); d < least[loop]) {
            least[loop] = d;
            closest[loop] = point;
        }
    }
    return closest;
}

/// The vertices of a boundary, ascending, with half of the lengths of their two edges of it.
struct Vertices {
    std::vector<int> vertex, loop;
    std::vector<double> length;

    Vertices(const TriangleMesh& mesh, const Boundary& boundary) {
        VertexData<double> lengths(mesh.vertex_count(), 0);
        VertexData<int> loops(mesh.vertex_count(), -1);
        for (std::size_t i = 0; i < boundary.edges.size(); ++i) {
            const auto [a, b] = boundary.edges[i];
            for (const int v : {a, b}) {
                lengths[v] += (mesh.vertex(a) - mesh.vertex(b)).norm() / 2;
                loops[v] = boundary.loop[i];
            }
        }
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            if (loops[v] < 0) continue;
            vertex.push_back(v);
            loop.push_back(loops[v]);
            length.push_back(lengths[v]);
        }
    }
};

/// Per loop of the source and of the target: the mean distance of the images of the one from the other.
Eigen::MatrixXd mean_distances(const SlidingMap& map, const Boundary& source, const Vertices& vertices,
                               const Boundary& target) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(source.loops, target.loops);
    Eigen::VectorXd lengths = Eigen::VectorXd::Zero(source.loops);
    for (std::size_t i = 0; i < vertices.vertex.size(); ++i) {
        const int v = vertices.vertex[i];
        if (!map.has_image(v)) continue;
        const std::vector<Vec3> closest = closest_on_loops(map.image(v), map.target(), target);
        for (int j = 0; j < target.loops; ++j)
            sums(vertices.loop[i], j) += vertices.length[i] * (closest[std::size_t(j)] - map.image(v)).norm();
        lengths[vertices.loop[i]] += vertices.length[i];
    }
    return sums.array().colwise() / lengths.array();
}

}  // namespace

BoundaryAgreement::BoundaryAgreement(const SlidingMap& map)
    : map_(map), target_(find_boundary(map.target())) {
    const Boundary source = find_boundary(map.source());
    if (source.loops == 0 || target_.loops == 0) return;
    const Vertices vertices(map.source(), source);
    const Eigen::MatrixXd distance = mean_distances(map, source, vertices, target_);
    const std::vector<double> there = loop_lengths(map.source(), source),
                              here = loop_lengths(map.target(), target_);
    std::vector<int> partner(std::size_t(source.loops), -1);
    for (int i = 0; i < source.loops; ++i) {
        Eigen::Index j = 0, back = 0;
        const double least = distance.row(i).minCoeff(&j);
        distance.col(j).minCoeff(&back);
        const double a = there[std::size_t(i)], b = here[std::size_t(j)];
        if (back == i && 2 * std::numbers::pi * least < a && std::max(a, b) <= most_longer * std::min(a, b))
            partner[std::size_t(i)] = int(j);
    }
    const PointMap points = points_at_vertices(map.source());
    for (std::size_t i = 0; i < vertices.vertex.size(); ++i)
        if (const int loop = partner[std::size_t(vertices.loop[i])]; loop >= 0)
            drawn_.push_back({points[std::size_t(vertices.vertex[i])], vertices.length[i], loop});
}

std::vector<SoftConstraint> BoundaryAgreement::constraints(double weight) const {
    std::vector<SoftConstraint> constraints;
    for (const Drawn& drawn : drawn_) {
        if (!map_.is_mapped(drawn.vertex.face)) continue;
        const Vec3& image = map_.image(vertex_of(map_.source(), drawn.vertex));
        const Vec3 to = closest_on_loops(image, map_.target(), target_)[std::size_t(drawn.loop)];
        constraints.push_back({drawn.vertex, to, weight * drawn.length, radius});
    }
    return constraints;
}

}  // namespace varimap
