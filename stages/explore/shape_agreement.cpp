#include "stages/explore/shape_agreement.h"

#include <cmath>

#include "varimap/mesh/topology.h"
#include "varimap/relaxation/relief_agreement.h"
#include "varimap/spectral/local_shape.h"

namespace varimap {

namespace {

/// Units of sqrt(area): of bumps that tell a chest from a back, a knee from a hock.
constexpr double relief_scales[] = {0.02, 0.04};

/// Weights need not sum to 1.
double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& weight) {
    const double total = weight.sum();
    const Eigen::ArrayXd x = a.array() - weight.dot(a) / total, y = b.array() - weight.dot(b) / total;
    const double product = (weight.array() * x * y).sum();
    const double scale = std::sqrt((weight.array() * x * x).sum() * (weight.array() * y * y).sum());
    return scale > 0 ? product / scale : 0;
}

/// Values of the target's vertices, row by row, at the images.
template <class Values>
Values pulled_back(const Values& values, const TriangleMesh& target, const PointMap& map) {
    Values result(Eigen::Index(map.size()), values.cols());
    for (std::size_t v = 0; v < map.size(); ++v) {
        auto row = result.row(Eigen::Index(v));
        row.setZero();
        for (int k = 0; k < 3; ++k) row += map[v].barycentric[k] * values.row(target.faces(map[v].face, k));
    }
    return result;
}

/// Of the surface at these points with these normals from one row to another; 0 between points that are one.
double normal_curvature(const Points& points, const Points& normals, int from, int to) {
    const Eigen::RowVector3d step = points.row(to) - points.row(from);
    const double squared = step.squaredNorm();
    return squared > 0 ? (normals.row(to) - normals.row(from)).dot(step) / squared : 0;
}

}  // namespace

ShapeAgreement::Side::Side(const Domain& surface)
    : mesh(surface.mesh), mass(surface.mass), smooth{smoothed(mesh, bending_scale), mesh.faces} {
    const double outward = looks_inward(surface) ? -1 : 1;
    normals = outward * vertex_normals(smooth);
    for (const double scale : relief_scales) relief.push_back(outward * varimap::relief(mesh, scale));
}

ShapeAgreement::ShapeAgreement(const Domain& A, const Domain& B) : A_(A), B_(B) {}

double ShapeAgreement::relief(const MapPair& maps) const {
    return (relief(maps.A_to_B, A_, B_) + relief(maps.B_to_A, B_, A_)) / 2;
}

double ShapeAgreement::bending(const MapPair& maps) const {
    return (bending(maps.A_to_B, A_, B_) + bending(maps.B_to_A, B_, A_)) / 2;
}

double ShapeAgreement::relief(const PointMap& map, const Side& source, const Side& target) {
    double sum = 0;
    for (std::size_t k = 0; k < source.relief.size(); ++k)
        sum += correlation(source.relief[k], pulled_back(target.relief[k], target.mesh, map), source.mass);
    return sum / double(source.relief.size());
}

double ShapeAgreement::bending(const PointMap& map, const Side& source, const Side& target) {
    const Points images = pulled_back(target.smooth.vertices, target.mesh, map),
                 normals = pulled_back(target.normals, target.mesh, map);
    const Edges edges = find_edges(source.mesh);
    Eigen::VectorXd here(edges.size()), there(edges.size()), weight(edges.size());
    for (int e = 0; e < edges.size(); ++e) {
        const auto [from, to] = edges.vertices[std::size_t(e)];
        here[e] = normal_curvature(source.smooth.vertices, source.normals, from, to);
        there[e] = normal_curvature(images, normals, from, to);
        weight[e] = source.mass[from] + source.mass[to];
    }
    return correlation(bounded_deviations(std::move(here)), bounded_deviations(std::move(there)), weight);
}

}  // namespace varimap
