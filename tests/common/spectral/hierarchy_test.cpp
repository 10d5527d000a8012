#include "varimap/spectral/hierarchy.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "fixtures/shapes.h"
#include "fixtures/surface_data.h"
#include "varimap/core/error.h"
#include "varimap/spectral/neighbourhoods.h"
#include "varimap/spectral/spectral_check.h"

namespace varimap {
namespace {

using shapes::surface_data;
using shapes::unit_surface;

SurfaceData small_figure() {
    return surface_data(unit_surface(shapes::figure(.15)), 60);
}

/// W of Eq. (7) between one vertex and all.
Eigen::VectorXd weights_to(const RowMatrix& embedding, int vertex) {
    const Eigen::VectorXd kernel = embedding * embedding.row(vertex).transpose();
    const Eigen::VectorXd diagonal = embedding.rowwise().squaredNorm();
    return 2 * kernel.array() / (diagonal.array() + diagonal[vertex]);
}

void expect_cells_and_masses(const Level& level, const Surface& surface) {
    const int samples = int(level.samples.size());
    ASSERT_EQ(int(level.cell.size()), surface.mesh.vertex_count());
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(samples);
    for (int v = 0; v < surface.mesh.vertex_count(); ++v) {
        ASSERT_GE(level.cell[v], 0);
        ASSERT_LT(level.cell[v], samples);
        mass[level.cell[v]] += surface.mass[v];
    }
    for (int k = 0; k < samples; ++k) EXPECT_EQ(level.cell[level.samples[k]], k);
    EXPECT_EQ(int(std::set<int>(level.samples.begin(), level.samples.end()).size()), samples);
    EXPECT_NEAR(level.mass.sum(), 1, 1e-12);
    EXPECT_GT(level.mass.minCoeff(), 0);
    EXPECT_LT((level.mass - mass).cwiseAbs().maxCoeff(), 1e-15);
}

void expect_weights(const Level& level) {
    ASSERT_EQ(level.weights.rows(), level.weights.cols());
    ASSERT_EQ(level.weights.rows(), Eigen::Index(level.samples.size()));
    for (int k = 0; k < level.weights.rows(); ++k) {
        EXPECT_NEAR(level.weights.coeff(k, k), 1, 1e-12);
        for (SparseMatrix::InnerIterator it(level.weights, k); it; ++it) {
            EXPECT_LE(it.value(), 1 + 1e-12);
            EXPECT_GE(it.value(), .5 - 1e-8);
        }
    }
}

/// Every vertex has W > tau to a sample: that of its cell, or (cells are connected) another one.
void expect_diffusion_cover(const Level& level, const RowMatrix& embedding) {
    Eigen::VectorXd best = Eigen::VectorXd::Zero(embedding.rows());
    for (int s : level.samples) best = best.cwiseMax(weights_to(embedding, s));
    EXPECT_GE(best.minCoeff(), .9 - 1e-9);
}

void expect_equation_seven(const Level& level, const RowMatrix& embedding) {
    const RowMatrix points = embedding(level.samples, Eigen::all);
    for (int k = 0; k < points.rows(); ++k) {
        const Eigen::VectorXd expected = weights_to(points, k);
        for (int i = 0; i < points.rows(); ++i)
            if (std::abs(expected[i] - .5) > 1e-9) {
                EXPECT_NEAR(level.weights.coeff(k, i), expected[i] > .5 ? expected[i] : 0, 1e-9);
            }
    }
    EXPECT_LT((RowMatrix(level.weights) - RowMatrix(level.weights).transpose()).cwiseAbs().maxCoeff(), 1e-12);
}

/// Every vertex has W > tau to a sample, with sigma of the level and distances along the surface.
void expect_euclidean_cover(const Level& level, const GeodesicGraph& graph) {
    const double radius = level.scale * std::sqrt(-2 * std::log(.9));
    std::vector<char> covered(level.cell.size(), 0);
    GeodesicBall ball(graph);
    for (int s : level.samples)
        ball.grow(s, [&](int v, double d) {
            if (d <= radius * (1 + 1e-9)) covered[std::size_t(v)] = 1;
            return d <= radius;
        });
    EXPECT_EQ(std::count(covered.begin(), covered.end(), 0), 0);
}

void expect_nested(const Hierarchy& hierarchy) {
    for (std::size_t l = 1; l < hierarchy.levels.size(); ++l) {
        const auto &coarse = hierarchy.levels[l - 1].samples, &fine = hierarchy.levels[l].samples;
        const std::set<int> all(fine.begin(), fine.end());
        EXPECT_TRUE(std::all_of(coarse.begin(), coarse.end(), [&](int s) { return all.count(s) == 1; }))
            << "level " << l;
        EXPECT_LE(coarse.size(), fine.size());
    }
}

TEST(Hierarchy, DiffusionLevelsFollowTheirRules) {
    const SurfaceData data = small_figure();
    const Hierarchy& h = data.hierarchy;
    const int count = h.diffusion_levels();
    ASSERT_GE(count, 5);
    EXPECT_LT(h.levels[0].samples.size(), 12u);
    EXPECT_GT(h.levels[std::size_t(count) - 1].samples.size(), 100u);
    for (int l = 0; l < count; ++l) {
        SCOPED_TRACE("level " + std::to_string(l));
        const Level& level = h.levels[std::size_t(l)];
        EXPECT_EQ(level.kind, LevelKind::diffusion);
        EXPECT_NEAR(level.scale, std::log(10.) / data.basis.eigenvalues[1] / std::pow(2, l), 1e-12);
        expect_cells_and_masses(level, data.surface);
        expect_weights(level);
        const RowMatrix embedding = diffusion_embedding(data.basis, level.scale);
        expect_diffusion_cover(level, embedding);
        expect_equation_seven(level, embedding);
    }
    expect_nested(h);
}

TEST(Hierarchy, EuclideanLevelsFollowTheirRules) {
    const SurfaceData data = small_figure();
    const Hierarchy& h = data.hierarchy;
    const auto first = std::size_t(h.diffusion_levels()), last = h.levels.size() - 1;
    const GeodesicGraph graph(data.surface.mesh);
    ASSERT_GE(last, first + 1);
    for (std::size_t l = first; l <= last; ++l) {
        SCOPED_TRACE("level " + std::to_string(l));
        const Level& level = h.levels[l];
        EXPECT_EQ(level.kind, LevelKind::euclidean);
        expect_cells_and_masses(level, data.surface);
        expect_weights(level);
        if (l + 1 < last) expect_euclidean_cover(level, graph);
    }
    EXPECT_EQ(h.sampled_euclidean_levels(), int(last - first));
    const int vertices = data.surface.mesh.vertex_count();
    EXPECT_FALSE(h.levels[last - 1].full);
    EXPECT_GE(h.levels[last - 1].samples.size(), std::size_t(.35 * vertices));
    EXPECT_LE(h.levels[last - 1].samples.size(), std::size_t(.5 * vertices));
    EXPECT_TRUE(h.levels[last].full);
    EXPECT_EQ(int(h.levels[last].samples.size()), vertices);
    EXPECT_EQ(h.levels[last].mass, data.surface.mass);
    const double neighbours = double(h.levels[last].weights.nonZeros()) / vertices;
    EXPECT_LE(neighbours, 12);  // fewer where normals disagree
    EXPECT_GT(neighbours, .8 * 12);
}

TEST(Hierarchy, HasASampledEuclideanLevelWhateverTheShare) {
    const Surface surface = unit_surface(shapes::ellipsoid(1));
    EigenSolverOptions eigen;
    eigen.count = 16;
    HierarchyOptions options;
    options.sampled_share = 0;
    const Hierarchy h = build_hierarchy(surface, compute_eigenbasis(surface, eigen), options);
    EXPECT_GE(h.sampled_euclidean_levels(), 1);
    const Level& sampled = h.levels[h.levels.size() - 2];
    EXPECT_EQ(sampled.kind, LevelKind::euclidean);
    EXPECT_FALSE(sampled.full);
    expect_nested(h);
}

TEST(Hierarchy, EuclideanWeightsDoNotBridgeThinParts) {
    // A sheet a hundredth thick: the other side is nearer in space than any neighbour.
    const SurfaceData data = surface_data(unit_surface(shapes::ellipsoid(4, {1, 1, .01})), 30);
    const Level& level = data.hierarchy.levels.back();
    const Points normals = vertex_normals(data.surface.mesh);
    for (int k = 0; k < level.weights.rows(); ++k)
        for (SparseMatrix::InnerIterator it(level.weights, k); it; ++it)
            EXPECT_TRUE(it.col() == k || normals.row(k).dot(normals.row(it.col())) > 0);
}

TEST(Hierarchy, HasTwoHalvesOfASphereInBalance) {
    const SurfaceData data = surface_data(unit_surface(shapes::ellipsoid(3)), 49);
    for (const Level& level : data.hierarchy.levels) {
        if (level.samples.size() < 20) continue;
        Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
        for (std::size_t k = 0; k < level.samples.size(); ++k)
            centre += level.mass[Eigen::Index(k)] * data.surface.mesh.vertices.row(level.samples[k]);
        EXPECT_LT(centre.norm(), .05);  // the sphere's radius is 0.28
    }
}

TEST(Hierarchy, IgnoresSignsAndBasesOfEigenfunctions) {
    // The sphere's eigenvalues are multiple: any rotation within an eigenspace is as good a basis.
    const Surface surface = unit_surface(shapes::ellipsoid(3));
    EigenSolverOptions options;
    options.count = 16;
    const Basis basis = compute_eigenbasis(surface, options);
    ASSERT_EQ(basis.eigenvalues.size(), 16);
    Basis turned = basis;
    const Eigen::MatrixXd random =
        Eigen::MatrixXd::NullaryExpr(3, 3, [](auto i, auto j) { return std::sin(1. + 3 * i + 7 * j); });
    turned.functions.middleCols(1, 3) *=
        Eigen::MatrixXd(Eigen::HouseholderQR<Eigen::MatrixXd>(random).householderQ());
    turned.functions.middleCols(4, 5) *= -1;
    const Hierarchy a = build_hierarchy(surface, basis, {}), b = build_hierarchy(surface, turned, {});
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t l = 0; l < a.levels.size(); ++l) {
        EXPECT_EQ(a.levels[l].samples, b.levels[l].samples);
        EXPECT_EQ(a.levels[l].cell, b.levels[l].cell);
        EXPECT_LT(RowMatrix(a.levels[l].weights - b.levels[l].weights).cwiseAbs().maxCoeff(), 1e-9);
    }
}

TEST(Hierarchy, DoesNotDependOnPlaceAndScale) {
    const TriangleMesh mesh = shapes::tube(40, 20, true);
    const SurfaceData a = surface_data(unit_surface(mesh), 40),
                      b = surface_data(unit_surface(shapes::moved(mesh, 17, 1.1, {3, 1, -8})), 40);
    ASSERT_EQ(a.hierarchy.levels.size(), b.hierarchy.levels.size());
    for (std::size_t l = 0; l < a.hierarchy.levels.size(); ++l)
        EXPECT_EQ(a.hierarchy.levels[l].samples, b.hierarchy.levels[l].samples) << "level " << l;
}

TEST(Hierarchy, IsTheSameForAnotherOrderOfVertices) {
    const TriangleMesh mesh = shapes::figure(.15);
    std::vector<int> old_vertex;
    const SurfaceData a = small_figure(),
                      b = surface_data(unit_surface(shapes::shuffled(mesh, 3, &old_vertex)), 60);
    ASSERT_EQ(a.hierarchy.levels.size(), b.hierarchy.levels.size());
    for (std::size_t l = 0; l + 2 < a.hierarchy.levels.size(); ++l) {
        std::vector<int> samples = b.hierarchy.levels[l].samples;
        for (int& s : samples) s = old_vertex[std::size_t(s)];
        EXPECT_EQ(a.hierarchy.levels[l].samples, samples) << "level " << l;
    }
}

TEST(Hierarchy, IsTheSameToTheLastBitForAnyThreads) {
    const Surface surface = unit_surface(shapes::tube(60, 30, true));
    const Basis basis = compute_eigenbasis(surface, {});
    const auto bytes = [&](int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
        return encode(build_hierarchy(surface, basis, {}));
    };
    const std::string one = bytes(1);
    EXPECT_EQ(one, bytes(2));
    Hierarchy read;
    decode(one, read);
    EXPECT_EQ(encode(read), one);
}

/// What no varimap-hierarchy writes, and what once crashed or confused the stages that read it.
TEST(Hierarchy, ForgedPartsAreRefused) {
    const SurfaceData good = small_figure();
    const std::pair<const char*, std::function<void(Hierarchy&)>> forgeries[] = {
        {"no level with every vertex", [](Hierarchy& h) { h.levels.resize(h.levels.size() - 2); }},
        {"a full level of the wrong kind",
         [](Hierarchy& h) {
             for (Level& level : h.levels) level.kind = LevelKind::diffusion;
         }},
        {"a sample in another's cell",
         [](Hierarchy& h) { std::swap(h.levels[2].samples[0], h.levels[2].samples[1]); }},
        {"a descriptor that Sinkhorn's iteration chokes on",
         [](Hierarchy& h) { h.shape.descriptors(3, 1) = 1e155; }},
        {"bending without end", [](Hierarchy& h) { h.shape.bending[3] = 1e100; }},
        {"endless neighbours", [](Hierarchy& h) { h.options.minimum_neighbours = 1 << 30; }}};
    Hierarchy copy;
    EXPECT_NO_THROW(decode(encode(good.hierarchy), copy));
    for (const auto& [what, forge] : forgeries) {
        Hierarchy forged = good.hierarchy;
        forge(forged);
        EXPECT_THROW(decode(encode(forged), copy), ArtifactError) << what;
    }
}

TEST(Hierarchy, BelongsToTheSurfaceAndTheBasis) {
    const SurfaceData good = small_figure();
    EXPECT_NO_THROW(require_fit(good));
    SurfaceData other = good;
    other.basis.functions.conservativeResize(other.basis.functions.rows() - 1, Eigen::NoChange);
    EXPECT_THROW(require_fit(other), ArtifactError);
    other = good;
    other.surface = unit_surface(shapes::tube(20, 16, true));
    EXPECT_THROW(require_fit(other), ArtifactError);
    other = good;
    std::swap(other.surface.mass[0], other.surface.mass[1]);  // cells are sums of other masses
    EXPECT_THROW(require_fit(other), ArtifactError);
}

TEST(Hierarchy, DescribesTheLocalShapeOfEveryVertex) {
    const SurfaceData data = small_figure();
    const LocalShape shape = local_shape(data.surface, data.basis);
    EXPECT_EQ(data.hierarchy.shape.descriptors, shape.descriptors);
    EXPECT_EQ(data.hierarchy.shape.bending, shape.bending);
    EXPECT_EQ(shape.descriptors.rows(), data.surface.mesh.vertex_count());
}

TEST(Level, MeansOverCellsAreWeightedByMass) {
    Level level;
    level.samples = {0, 2};
    level.cell = {0, 0, 1};
    level.mass = Eigen::Vector2d(.4, .6);
    const RowMatrix means = cell_means(level, Eigen::Vector3d(.1, .3, .6), Eigen::Vector3d(1, 5, 7));
    EXPECT_NEAR(means(0, 0), 4, 1e-15);
    EXPECT_NEAR(means(1, 0), 7, 1e-15);
}

TEST(Neighbourhoods, NearerPartOfThoseCutAtAHalfHasWeightsFromSevenTenthsOn) {
    SparseMatrix weights(1, 3);
    weights.insert(0, 0) = 1;
    weights.insert(0, 1) = .71;
    weights.insert(0, 2) = .69;
    EXPECT_EQ(nearer_part(weights, .5).nonZeros(), 2);
    EXPECT_EQ(nearer_part(weights, .95).nonZeros(), 1);
}

TEST(Hierarchy, ParentsAreTheCellsOfSamples) {
    const SurfaceData data = surface_data(unit_surface(shapes::tube(30, 16, true)), 30);
    const Level &coarse = data.hierarchy.levels[2], &fine = data.hierarchy.levels[4];
    const std::vector<int> parent = parents(fine, coarse);
    ASSERT_EQ(parent.size(), fine.samples.size());
    for (std::size_t k = 0; k < parent.size(); ++k) {
        EXPECT_EQ(parent[k], coarse.cell[std::size_t(fine.samples[k])]);
        if (k < coarse.samples.size()) {
            EXPECT_EQ(parent[k], int(k));
        }
    }
}

TEST(Hierarchy, TakesFurtherSamples) {
    const SurfaceData data = surface_data(unit_surface(shapes::tube(40, 20, true)), 30);
    const GeodesicGraph graph(data.surface.mesh);
    const Hierarchy& h = data.hierarchy;
    const LevelBuilder builder(data.surface, data.basis, graph, h.options);
    for (const Level& level : h.levels) {
        const std::vector<int> wanted{level.samples[1], 17, 500};
        const bool diffusion = level.kind == LevelKind::diffusion;
        const RowMatrix embedding = diffusion_embedding(data.basis, level.scale);
        const auto with_samples = [&](const std::vector<int>& further) {
            return diffusion ? builder.diffusion_with(level, further, embedding)
                             : builder.euclidean_with(level, further);
        };
        const Level with = with_samples(wanted);
        EXPECT_EQ(with.samples, samples_with(level, wanted));
        for (int v : wanted) EXPECT_EQ(with.samples[std::size_t(with.cell[std::size_t(v)])], v);
        EXPECT_LE(with.samples.size(), level.samples.size() + 2);
        expect_cells_and_masses(with, data.surface);
        expect_weights(with);
        if (!level.full) {
            const int count = int(with.samples.size());
            Level anew;
            if (diffusion) {
                anew = builder.diffusion_cells(level.scale, with.samples, count);
                builder.weigh(anew);
            } else {
                anew = *builder.euclidean(level.scale, with.samples, count, 0).least;
            }
            EXPECT_EQ(with.cell, anew.cell);
            EXPECT_EQ(with.mass, anew.mass);
            EXPECT_EQ(with.weights.nonZeros(), anew.weights.nonZeros());
            EXPECT_LT(RowMatrix(with.weights - anew.weights).cwiseAbs().maxCoeff(), 1e-12);
        }
        const Level same = with_samples(level.samples);
        EXPECT_EQ(same.samples, level.samples);
        EXPECT_EQ(same.cell, level.cell);
    }
}

}  // namespace
}  // namespace varimap
