#include "stages/explore/shape_agreement.h"

#include <algorithm>
#include <cmath>

#include "varimap/core/statistics.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/relaxation/relief_agreement.h"

namespace varimap {

namespace {

// Lengths are in units of sqrt(area).

/// Of bumps that tell a chest from a back, a knee from a hock.
const std::vector<double> relief_scales{0.02, 0.04};

// Of all pairs of .15, .25, .35, .45, .6 and .8 these divide right maps from wrong ones best; single radii
// from .35 to .45 do about as well.
constexpr double patch_radii[] = {0.25, 0.45};

/// From 60 to 150 it made no difference which maps come first.
constexpr std::size_t sample_count = 80;

/// Added to both of two distances, lest short ones, which the meshes' edges make uncertain, count.
constexpr double short_distance = 0.1;

PointMap at(const PointMap& map, const std::vector<int>& vertices) {
    PointMap images;
    for (const int v : vertices) images.push_back(map[std::size_t(v)]);
    return images;
}

double stretch_between(double here, double there) {
    const double change = std::abs(std::log((here + short_distance) / (there + short_distance)));
    return std::isfinite(change) ? std::min(change, most_stretch) : most_stretch;  // on different parts
}

}  // namespace

ShapeAgreement::Side::Side(const SurfaceData& data, const GeodesicGraph& graph, bool inward,
                           const SurfaceComponents& of_surface)
    : mesh(data.surface.mesh),
      mass(data.surface.mass),
      normals(outward_normals(mesh, inward)),
      samples(spread_vertices(data.hierarchy, sample_count)),
      components(of_surface),
      patches(mesh.vertices, normals, mass) {
    const double outward = inward ? -1 : 1;
    for (const Eigen::VectorXd& heights : reliefs(mesh, relief_scales)) relief.push_back(outward * heights);
    const RowMatrix to_all = distances_from_each(graph, samples);
    distance = to_all.transpose();
    sample_mass = Eigen::VectorXd::Zero(Eigen::Index(samples.size()));
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        Eigen::Index nearest = 0;
        to_all.col(v).minCoeff(&nearest);
        sample_mass[nearest] += mass[v];
    }
    for (const double radius : patch_radii) patches.add_patches(to_all, radius, sample_mass);
}

ShapeAgreement::ShapeAgreement(const PairContext& context, const PairHandedness& handedness,
                               const SurfaceComponents& components_A, const SurfaceComponents& components_B)
    : A_(context.A(), context.graph_A(), handedness.A_inward, components_A),
      B_(context.B(), context.graph_B(), handedness.B_inward, components_B),
      opposed_(handedness.are_opposite()),
      sheets_(is_sheet(A_.mesh) && is_sheet(B_.mesh)) {}

double ShapeAgreement::relief(const MapPair& maps) const {
    return (relief(maps.A_to_B, A_, B_) + relief(maps.B_to_A, B_, A_)) / 2;
}

double ShapeAgreement::alignment(const MapPair& maps) const {
    return (alignment(maps.A_to_B, A_, B_) + alignment(maps.B_to_A, B_, A_)) / 2;
}

bool ShapeAgreement::Side::are_on_different_components(int vertex, const SurfacePoint& point) const {
    const std::optional<int> one = components.of(vertex), other = components.of(nearest_vertex(mesh, point));
    return one && other && *one != *other;
}

double ShapeAgreement::Side::straight_distance(int vertex, const SurfacePoint& point) const {
    return (mesh.vertex(vertex) - position(mesh, point)).norm();
}

double ShapeAgreement::stretch(const MapPair& maps) const {
    // Between samples of A and the images of those of B, and between the images of the former and the latter:
    // distances from samples to everywhere are known.
    const PointMap on_A = at(maps.B_to_A, B_.samples), on_B = at(maps.A_to_B, A_.samples);
    const RowMatrix here = pulled_back(A_.distance, A_.mesh, on_A),
                    there = pulled_back(B_.distance, B_.mesh, on_B).transpose();
    const auto stretch_of = [&](Eigen::Index i, Eigen::Index j) {
        const int p = A_.samples[std::size_t(i)], q = B_.samples[std::size_t(j)];
        const SurfacePoint &image_of_p = on_B[std::size_t(i)], &image_of_q = on_A[std::size_t(j)];
        if (A_.are_on_different_components(p, image_of_q) && B_.are_on_different_components(q, image_of_p))
            return stretch_between(A_.straight_distance(p, image_of_q), B_.straight_distance(q, image_of_p));
        return stretch_between(here(j, i), there(j, i));
    };
    double sum = 0;
    for (Eigen::Index j = 0; j < here.rows(); ++j)
        for (Eigen::Index i = 0; i < here.cols(); ++i)
            sum += A_.sample_mass[i] * B_.sample_mass[j] * stretch_of(i, j);
    return sum / (A_.sample_mass.sum() * B_.sample_mass.sum());
}

double ShapeAgreement::relief(const PointMap& map, const Side& source, const Side& target) const {
    // About that of right maps of animals that differ; where one surface has none, it tells no map from
    // another.
    constexpr double without_relief = 0.75, least_relief = 1e-6;  // less is rounding, as of a file far from 0
    const auto agreement = [&](const Eigen::VectorXd& here, const Eigen::VectorXd& there) {
        if (here.isZero(least_relief) || there.isZero(least_relief)) return without_relief;
        const double r = correlation(here, pulled_back(there, target.mesh, map), source.mass);
        return sheets_ ? std::max(r, agreement_of_bent_sheets) : r;
    };
    double sum = 0;
    for (std::size_t k = 0; k < source.relief.size(); ++k)
        sum += agreement(source.relief[k], target.relief[k]);
    return sum / double(source.relief.size());
}

double ShapeAgreement::alignment(const PointMap& map, const Side& source, const Side& target) const {
    return source.patches(positions(target.mesh, map), pulled_back(target.normals, target.mesh, map),
                          opposed_);
}

}  // namespace varimap
