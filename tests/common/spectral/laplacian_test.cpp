#include "varimap/spectral/laplacian.h"

#include <gtest/gtest.h>

#include <random>

#include "fixtures/shapes.h"

namespace varimap {
namespace {

Eigen::VectorXd random_vector(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    return Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
}

/// Integral of |grad f|^2 for a piecewise linear f, from the gradients of the faces.
double dirichlet_energy(const TriangleMesh& mesh, const Eigen::VectorXd& f) {
    double energy = 0;
    for (int t = 0; t < mesh.face_count(); ++t) {
        const Vec3 normal = face_normal(mesh, t);
        const double twice_area = normal.norm();
        Vec3 gradient = Vec3::Zero();
        for (int c = 0; c < 3; ++c) {
            const Vec3 opposite =
                mesh.vertex(mesh.faces(t, (c + 2) % 3)) - mesh.vertex(mesh.faces(t, (c + 1) % 3));
            gradient += f[mesh.faces(t, c)] * normal.cross(opposite) / (twice_area * twice_area);
        }
        energy += gradient.squaredNorm() * twice_area / 2;
    }
    return energy;
}

double largest(const Eigen::SparseMatrix<double>& matrix) {
    return Eigen::MatrixXd(matrix).cwiseAbs().maxCoeff();
}

TEST(Laplacian, IsSymmetricWithRowsThatSumToZero) {
    const auto L = cotangent_laplacian(shapes::tube(20, 14, false, .3));
    EXPECT_LT(largest(L - Eigen::SparseMatrix<double>(L.transpose())), 1e-14);
    EXPECT_LT((L * Eigen::VectorXd::Ones(L.cols())).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Laplacian, GivesTheDirichletEnergyOfEveryFunction) {
    for (const TriangleMesh& mesh : {shapes::tube(20, 14, false, .3), shapes::ellipsoid(2, {1, 2, 3})}) {
        const auto L = cotangent_laplacian(mesh);
        for (unsigned seed = 0; seed < 5; ++seed) {
            const Eigen::VectorXd f = random_vector(mesh.vertex_count(), seed);
            const double energy = dirichlet_energy(mesh, f);
            EXPECT_GT(energy, 0);
            EXPECT_NEAR(f.dot(L * f), energy, 1e-10 * energy);
        }
    }
}

TEST(Laplacian, OfALinearFunctionOnAFlatSquareIsItsSlopeSquared) {
    const TriangleMesh mesh = shapes::square(7);
    const Eigen::VectorXd f = 3 * mesh.vertices.col(0) - 2 * mesh.vertices.col(1);
    EXPECT_NEAR(f.dot(cotangent_laplacian(mesh) * f), 13, 1e-12);
}

TEST(Laplacian, DoesNotDependOnPlaceAndScale) {
    const TriangleMesh mesh = shapes::tube(12, 9, true);
    EXPECT_LT(
        largest(cotangent_laplacian(mesh) - cotangent_laplacian(shapes::moved(mesh, 250, 1, {3, -7, 1}))),
        1e-10);
}

TEST(Laplacian, OfANeedleIsNotNegative) {
    const TriangleMesh needle = shapes::make_mesh({{0, 0, 0}, {1, 0, 0}, {.5, 2.5e-7, 0}}, {{0, 1, 2}});
    const Eigen::SparseMatrix<double> L = cotangent_laplacian(needle);
    EXPECT_LE(largest(L), 1.1e6);
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Eigen::VectorXd f = random_vector(3, seed);
        EXPECT_GE(f.dot(L * f), 0) << seed;
    }
    const Eigen::Vector3d ends(-1, 1, 0);
    EXPECT_GE(ends.dot(L * ends), 0);
}

TEST(Laplacian, IgnoresTrianglesWithoutArea) {
    const TriangleMesh mesh =
        shapes::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {.5, .5, 0}}, {{0, 1, 2}, {1, 3, 2}, {0, 0, 1}});
    const TriangleMesh clean = shapes::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {.5, .5, 0}}, {{0, 1, 2}});
    EXPECT_LT(largest(cotangent_laplacian(mesh) - cotangent_laplacian(clean)), 1e-15);
}

}  // namespace
}  // namespace varimap
