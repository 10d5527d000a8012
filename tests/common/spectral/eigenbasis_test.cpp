#include "varimap/spectral/eigenbasis.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "fixtures/shapes.h"
#include "fixtures/surface_data.h"
#include "varimap/core/error.h"
#include "varimap/spectral/laplacian.h"

namespace varimap {
namespace {

using shapes::unit_surface;
using std::numbers::pi;

Basis eigenbasis(const Surface& surface, int count) {
    EigenSolverOptions options;
    options.count = count;
    return compute_eigenbasis(surface, options);
}

TEST(Eigenbasis, SatisfiesItsEquationsOnATube) {
    const Surface surface = unit_surface(shapes::tube(40, 20, false));
    const Basis basis = eigenbasis(surface, 30);
    const auto L = cotangent_laplacian(surface.mesh);
    ASSERT_EQ(basis.eigenvalues.size(), 30);
    EXPECT_EQ(basis.eigenvalues[0], 0);
    EXPECT_LT((basis.functions.col(0).array() - 1).abs().maxCoeff(), 1e-12);
    const Eigen::MatrixXd gram = basis.functions.transpose() * surface.mass.asDiagonal() * basis.functions;
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(30, 30)).cwiseAbs().maxCoeff(), 1e-9);
    for (int k = 1; k < 30; ++k) {
        EXPECT_GE(basis.eigenvalues[k], basis.eigenvalues[k - 1]);
        const Eigen::VectorXd phi = basis.functions.col(k), Mphi = surface.mass.cwiseProduct(phi);
        EXPECT_NEAR(phi.dot(L * phi), basis.eigenvalues[k], 1e-9 * basis.eigenvalues[k]);
        EXPECT_LT((L * phi - basis.eigenvalues[k] * Mphi).norm(), 1e-7 * basis.eigenvalues[k] * Mphi.norm());
    }
    EXPECT_LT(basis.residuals.maxCoeff(), 1e-7);
}

TEST(Eigenbasis, HasTheSpectrumOfTheSphere) {
    // Multiplicity 2l + 1: the solver must not pass over any of equal eigenvalues.
    const Basis basis = eigenbasis(unit_surface(shapes::ellipsoid(4)), 100);
    ASSERT_EQ(basis.eigenvalues.size(), 100);
    for (int l = 1, k = 1; l <= 9; ++l)
        for (int m = 0; m < 2 * l + 1; ++m, ++k)
            EXPECT_NEAR(basis.eigenvalues[k] / (4 * pi * l * (l + 1)), 1, l < 5 ? .01 : .04) << "l = " << l;
}

/// Splits a face at its edge 01, and the flat face there in its middle: a vertex with hardly any mass, with
/// faces whose height is `thin` of their length.
void add_needles(TriangleMesh& mesh, int face, double thin) {
    const int a = mesh.faces(face, 0), b = mesh.faces(face, 1), c = mesh.faces(face, 2);
    const int first = mesh.vertex_count(), second = first + 1;
    mesh.vertices.conservativeResize(first + 2, 3);
    mesh.vertices.row(first) =
        (1 - thin) / 2 * (mesh.vertex(a) + mesh.vertex(b)).transpose() + thin * mesh.vertex(c).transpose();
    mesh.vertices.row(second) = (mesh.vertex(a) + mesh.vertex(b) + mesh.vertex(first)).transpose() / 3;
    const int added = mesh.face_count();
    mesh.faces.conservativeResize(added + 4, 3);
    mesh.faces.row(face) << a, b, second;
    mesh.faces.row(added) << b, first, second;
    mesh.faces.row(added + 1) << first, a, second;
    mesh.faces.row(added + 2) << b, c, first;
    mesh.faces.row(added + 3) << c, a, first;
}

TEST(Eigenbasis, IsNotRefusedForNeedles) {
    TriangleMesh mesh = shapes::ellipsoid(3);
    const Basis plain = eigenbasis(unit_surface(mesh), 100);
    const int faces = mesh.face_count();
    for (int f = 0; f < faces; f += 40) add_needles(mesh, f, 1e-5);
    const Basis basis = eigenbasis(unit_surface(mesh), 100);
    ASSERT_EQ(basis.eigenvalues.size(), plain.eigenvalues.size());
    for (int k = 1; k < 100; ++k) EXPECT_NEAR(basis.eigenvalues[k] / plain.eigenvalues[k], 1, .03) << k;
    EXPECT_LT(basis.residuals.maxCoeff(), 1e-8);
}

TEST(Eigenbasis, HasTheNeumannSpectrumOfTheSquare) {
    const Basis basis = eigenbasis(unit_surface(shapes::square(40)), 6);
    const double expected[] = {0, 1, 1, 2, 4, 4};
    ASSERT_EQ(basis.eigenvalues.size(), 6);
    for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(basis.eigenvalues[k], expected[k] * pi * pi, .01 * expected[k] * pi * pi);
}

TEST(Eigenbasis, NeverCutsAnEigenspace) {
    // On the subdivided icosahedron the spaces of l = 1 and l = 2 keep their multiplicities 3 and 5.
    const Surface sphere = unit_surface(shapes::ellipsoid(2));
    for (int wanted = 4; wanted < 9; ++wanted) EXPECT_EQ(eigenbasis(sphere, wanted).eigenvalues.size(), 4);
    EXPECT_EQ(eigenbasis(sphere, 9).eigenvalues.size(), 9);
}

TEST(Eigenbasis, DependsOnPlaceAndScaleByRoundingOnly) {
    const TriangleMesh mesh = shapes::tube(30, 16, true);
    const Basis here = eigenbasis(unit_surface(mesh), 20),
                there = eigenbasis(unit_surface(shapes::moved(mesh, 1e-3, 2, {5, 1, -2})), 20);
    EXPECT_LT((here.eigenvalues - there.eigenvalues).cwiseAbs().maxCoeff(), 1e-8 * here.eigenvalues[19]);
    // Inner products, unlike the functions, have no arbitrary signs.
    const RowMatrix a = diffusion_embedding(here, .01), b = diffusion_embedding(there, .01);
    EXPECT_LT((a * a.transpose() - b * b.transpose()).cwiseAbs().maxCoeff(),
              1e-8 * a.rowwise().squaredNorm().maxCoeff());
}

TEST(Eigenbasis, IsTheSameToTheLastBitForAnyThreads) {
    const Surface surface = unit_surface(shapes::tube(40, 20, true));
    const auto bytes = [&](int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return encode(eigenbasis(surface, 20));
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

TEST(Eigenbasis, IsCappedByTheNumberOfVertices) {
    const Basis basis = eigenbasis(unit_surface(shapes::ellipsoid(1, {1, 1.3, 2})), 100);
    EXPECT_EQ(basis.eigenvalues.size(), 41);
}

TEST(Eigenbasis, RefusesWhatHasNone) {
    const TriangleMesh triangle = shapes::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    EXPECT_THROW(eigenbasis(unit_surface(triangle), 10), InputError);
    TriangleMesh two = shapes::ellipsoid(2), other = shapes::moved(two, 1.1, 1, {5, 0, 0});
    two.faces.conservativeResize(640, 3);
    two.faces.bottomRows(320) = other.faces.array() + two.vertex_count();
    two.vertices.conservativeResize(2 * other.vertex_count(), 3);
    two.vertices.bottomRows(other.vertex_count()) = other.vertices;
    EXPECT_THROW(eigenbasis(unit_surface(two), 10), ConvergenceError);
}

TEST(Eigenbasis, SurvivesBeingStored) {
    const Basis basis = eigenbasis(unit_surface(shapes::tube(12, 9, true)), 8);
    Basis read;
    decode(encode(basis), read);
    EXPECT_EQ(read.eigenvalues, basis.eigenvalues);
    EXPECT_EQ(read.functions, basis.functions);
    EXPECT_EQ(read.residuals, basis.residuals);
}

TEST(DiffusionEmbedding, HasTheHeatKernelAsItsInnerProduct) {
    const Surface surface = unit_surface(shapes::tube(24, 12, true));
    const Basis basis = eigenbasis(surface, 25);
    EXPECT_EQ(diffusion_embedding(basis, 0), basis.functions);
    const double t = coarsest_time(basis) / 16;
    const RowMatrix embedding = diffusion_embedding(basis, t), later = diffusion_embedding(basis, 2 * t);
    const RowMatrix kernel = embedding * embedding.transpose();
    // Heat is conserved; its trace is sum exp(-lambda t); diffusing twice is diffusing for twice the time.
    EXPECT_LT((kernel * surface.mass - Eigen::VectorXd::Ones(surface.mass.size())).cwiseAbs().maxCoeff(),
              1e-8);
    EXPECT_NEAR(kernel.diagonal().dot(surface.mass), (-t * basis.eigenvalues.array()).exp().sum(), 1e-8);
    const RowMatrix twice = kernel * surface.mass.asDiagonal() * kernel;
    EXPECT_LT((twice - later * later.transpose()).cwiseAbs().maxCoeff(), 1e-8);
    const std::vector<int> some{7, 0, 100};
    EXPECT_EQ(diffusion_embedding(basis, t, some), RowMatrix(embedding(some, Eigen::all)));
}

TEST(DiffusionEmbedding, StartsWhereTheSecondFunctionDecaysToATenth) {
    const Basis basis = eigenbasis(unit_surface(shapes::tube(24, 12, true)), 5);
    EXPECT_NEAR(std::exp(-basis.eigenvalues[1] * coarsest_time(basis)), .1, 1e-12);
}

}  // namespace
}  // namespace varimap
