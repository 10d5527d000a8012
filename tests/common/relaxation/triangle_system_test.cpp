#include "varimap/relaxation/triangle_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "fixtures/shapes.h"

namespace varimap {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

Triangles triangles_of(const TriangleMesh& mesh, int step_without_unknowns) {
    Triangles triangles;
    for (int f = 0; f < mesh.face_count(); ++f) {
        auto& t = triangles.emplace_back();
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.faces(f, k);
            t[k] = v % step_without_unknowns == 0 ? -1 : v - v / step_without_unknowns - 1;
        }
    }
    return triangles;
}

/// Fills a system and its dense counterpart with the same random matrices.
Eigen::MatrixXd fill(TriangleSystem& system, const Triangles& triangles, int node_count) {
    std::srand(1);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(2 * node_count, 2 * node_count);
    system.clear();
    for (int t = 0; t < int(triangles.size()); ++t) {
        const TriangleSystem::TriangleMatrix root = TriangleSystem::TriangleMatrix::Random();
        const TriangleSystem::TriangleMatrix matrix = root * root.transpose();
        system.add(t, matrix, 0.5);
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l)
                if (triangles[t][k] >= 0 && triangles[t][l] >= 0)
                    dense.block<2, 2>(2 * triangles[t][k], 2 * triangles[t][l]) +=
                        0.5 * matrix.block<2, 2>(2 * k, 2 * l);
    }
    const Eigen::Matrix2d block{{3, 1}, {1, 2}};
    system.add(4, block);
    dense.block<2, 2>(8, 8) += block;
    system.scale_diagonal(1.01);
    dense.diagonal() *= 1.01;
    return dense;
}

TEST(TriangleSystem, SolvesWhatADenseFactorisationSolves) {
    const TriangleMesh mesh = shapes::ellipsoid(2);
    const int held = 7, node_count = mesh.vertex_count() - (mesh.vertex_count() + held - 1) / held;
    const Triangles triangles = triangles_of(mesh, held);
    TriangleSystem system(node_count, triangles);
    for (int time = 0; time < 2; ++time) {  // workspaces are left clean
        const Eigen::MatrixXd dense = fill(system, triangles, node_count);
        ASSERT_TRUE(system.factorize());
        const Eigen::VectorXd b = Eigen::VectorXd::Random(2 * node_count);
        EXPECT_LT((system.solve(b) - dense.ldlt().solve(b)).norm(), 1e-10 * b.norm());
    }
}

TEST(TriangleSystem, TellsSingularOnes) {
    TriangleSystem system(4, {{0, 1, 2}, {2, 1, 3}});
    system.clear();
    system.add(0, TriangleSystem::TriangleMatrix::Identity(), 1);
    EXPECT_FALSE(system.factorize());
    system.add(3, Eigen::Matrix2d::Identity());
    EXPECT_TRUE(system.factorize());
}

}  // namespace
}  // namespace varimap
