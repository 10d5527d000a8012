#include "stages/explore/shape_agreement.h"

#include <algorithm>
#include <cmath>

#include "varimap/core/parallel.h"
#include "varimap/core/rotation.h"
#include "varimap/core/statistics.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/topology.h"
#include "varimap/relaxation/relief_agreement.h"
#include "varimap/spectral/local_shape.h"

namespace varimap {

namespace {

// Lengths are in units of sqrt(area).

/// Of bumps that tell a chest from a back, a knee from a hock.
constexpr double relief_scales[] = {0.02, 0.04};

// Of all pairs of .15, .25, .35, .45, .6 and .8 these divide right maps from wrong ones best; single radii
// from .35 to .45 do about as well.
constexpr double patch_radii[] = {0.25, 0.45};

/// From 60 to 150 it made no difference which maps come first.
constexpr std::size_t sample_count = 80;

/// Added to both of two distances, lest short ones, which the meshes' edges make uncertain, count.
constexpr double short_distance = 0.1;

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

/// A few vertices far from each other: a level's first samples are, whatever level it is.
std::vector<int> spread_vertices(const Hierarchy& hierarchy) {
    const std::vector<Level>& levels = hierarchy.levels;
    auto level = std::find_if(levels.begin(), levels.end(),
                              [](const Level& l) { return l.samples.size() >= sample_count; });
    if (level == levels.end()) --level;
    const std::vector<int>& samples = level->samples;
    return {samples.begin(), samples.begin() + std::ptrdiff_t(std::min(samples.size(), sample_count))};
}

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

ShapeAgreement::Side::Side(const SurfaceData& data, const GeodesicGraph& graph)
    : mesh(data.surface.mesh), mass(data.surface.mass), samples(spread_vertices(data.hierarchy)) {
    const double outward = looks_inward(data.surface) ? -1 : 1;
    normals = outward * vertex_normals(mesh);
    for (const double scale : relief_scales) relief.push_back(outward * varimap::relief(mesh, scale));
    const RowMatrix to_all = distances_from_each(graph, samples);
    distance = to_all.transpose();
    sample_mass = Eigen::VectorXd::Zero(Eigen::Index(samples.size()));
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        Eigen::Index nearest = 0;
        to_all.col(v).minCoeff(&nearest);
        sample_mass[nearest] += mass[v];
    }
    for (const double radius : patch_radii)
        for (std::size_t k = 0; k < samples.size(); ++k) {
            Patch patch{{}, sample_mass[Eigen::Index(k)]};
            for (int v = 0; v < mesh.vertex_count(); ++v)
                if (to_all(Eigen::Index(k), v) < radius) patch.vertices.push_back(v);
            patches.push_back(std::move(patch));
        }
}

ShapeAgreement::ShapeAgreement(const PairContext& context)
    : A_(context.A(), context.graph_A()),
      B_(context.B(), context.graph_B()),
      opposed_(looks_inward(context.A().surface) != looks_inward(context.B().surface)),
      sheets_(is_sheet(A_.mesh) && is_sheet(B_.mesh)) {}

double ShapeAgreement::relief(const MapPair& maps) const {
    return (relief(maps.A_to_B, A_, B_) + relief(maps.B_to_A, B_, A_)) / 2;
}

double ShapeAgreement::alignment(const MapPair& maps) const {
    return (alignment(maps.A_to_B, A_, B_) + alignment(maps.B_to_A, B_, A_)) / 2;
}

double ShapeAgreement::stretch(const MapPair& maps) const {
    // Between samples of A and the images of those of B, and between the images of the former and the latter:
    // distances from samples to everywhere are known.
    const RowMatrix here = pulled_back(A_.distance, A_.mesh, at(maps.B_to_A, B_.samples)),
                    there = pulled_back(B_.distance, B_.mesh, at(maps.A_to_B, A_.samples)).transpose();
    double sum = 0;
    for (Eigen::Index j = 0; j < here.rows(); ++j)
        for (Eigen::Index i = 0; i < here.cols(); ++i)
            sum += A_.sample_mass[i] * B_.sample_mass[j] * stretch_between(here(j, i), there(j, i));
    return sum / (A_.sample_mass.sum() * B_.sample_mass.sum());
}

double ShapeAgreement::relief(const PointMap& map, const Side& source, const Side& target) const {
    // About that of right maps of animals that differ; where one surface has none, it tells no map from
    // another.
    constexpr double without_relief = 0.75;
    const auto agreement = [&](const Eigen::VectorXd& here, const Eigen::VectorXd& there) {
        if (here.isZero() || there.isZero()) return without_relief;
        const double r = correlation(here, pulled_back(there, target.mesh, map), source.mass);
        return sheets_ ? std::max(r, agreement_of_bent_sheets) : r;
    };
    double sum = 0;
    for (std::size_t k = 0; k < source.relief.size(); ++k)
        sum += agreement(source.relief[k], target.relief[k]);
    return sum / double(source.relief.size());
}

double ShapeAgreement::alignment(const PointMap& map, const Side& source, const Side& target) const {
    const Points images = pulled_back(target.mesh.vertices, target.mesh, map),
                 normals = pulled_back(target.normals, target.mesh, map);
    // Of one patch, trace(R' M) of the best R.
    const auto aligned = [&](const Patch& patch) {
        double mass = 0;
        Vec3 centre = Vec3::Zero(), image_centre = Vec3::Zero();
        for (const int v : patch.vertices) {
            mass += source.mass[v];
            centre += source.mass[v] * source.mesh.vertex(v);
            image_centre += source.mass[v] * images.row(v).transpose();
        }
        centre /= mass, image_centre /= mass;
        Eigen::Matrix3d of_points = Eigen::Matrix3d::Zero(), of_normals = Eigen::Matrix3d::Zero();
        double spread = 0, image_spread = 0;
        for (const int v : patch.vertices) {
            const double share = source.mass[v] / mass;
            const Vec3 x = source.mesh.vertex(v) - centre, y = images.row(v).transpose() - image_centre;
            spread += share * x.squaredNorm();
            image_spread += share * y.squaredNorm();
            of_points += share * y * x.transpose();
            of_normals += share * normals.row(v).transpose() * source.normals.row(v);
        }
        if (const double scale = std::sqrt(spread * image_spread); scale > 0) of_normals += of_points / scale;
        return nearest_rotation(of_normals, opposed_).cwiseProduct(of_normals).sum() / 2;
    };
    std::vector<double> of_patch(source.patches.size());
    parallel_for_each_index(of_patch.size(), std::size_t(16),
                            [&](std::size_t k) { of_patch[k] = aligned(source.patches[k]); });
    double sum = 0, weight = 0;
    for (std::size_t k = 0; k < of_patch.size(); ++k) {
        sum += source.patches[k].weight * of_patch[k];
        weight += source.patches[k].weight;
    }
    return sum / weight;
}

}  // namespace varimap
