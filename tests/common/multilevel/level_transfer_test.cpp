#include "varimap/multilevel/level_transfer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/known_pair.h"
#include "fixtures/random_plan.h"

namespace varimap {
namespace {

using random_plan::dense;

shapes::KnownPair tubes() {
    return shapes::known_pair(shapes::tube(40, 20, true), shapes::tube(36, 18, true, .4),
                              shapes::tube_pose(1), 50, {{-.3, 0, 0}, {1, .35, .45}});
}

/// A plan between the samples of a level, with marginals of some other plan.
Coupling some_plan(const LevelPair& pair) {
    random_plan::Generator random(1);
    Coupling plan;
    plan.support = random.support(int(pair.A.side.mass.size()), int(pair.B.side.mass.size()), .1);
    plan.value = random.values(plan.support.entries());
    plan.row_background = 1e-3 * random.values(plan.support.rows());
    plan.column_background = 1e-3 * random.values(plan.support.columns());
    return plan;
}

Coupling identity_plan(const Level& level) {
    Coupling plan;
    std::vector<std::vector<int>> columns;
    for (int k = 0; k < int(level.samples.size()); ++k) columns.push_back({k});
    plan.support = Support(columns, int(columns.size()));
    plan.value = level.mass;
    plan.row_background = plan.column_background = Eigen::VectorXd::Zero(level.mass.size());
    return plan;
}

/// Mass-weighted mean of a cell's vertices in an embedding.
Eigen::RowVectorXd cell_mean(const Level& level, int cell, const LevelSide& fine) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(fine.vertex_points.cols());
    double total = 0;
    for (std::size_t v = 0; v < level.cell.size(); ++v)
        if (level.cell[v] == cell) {
            sum += fine.vertex_mass[Eigen::Index(v)] * fine.vertex_points.row(Eigen::Index(v));
            total += fine.vertex_mass[Eigen::Index(v)];
        }
    return sum / total;
}

/// The start of a level, written out.
RowMatrix expected_centres(const RowMatrix& plan, const Level& coarse_from, const Level& coarse_to,
                           const LevelSide& from, const LevelSide& to) {
    RowMatrix image(plan.rows(), to.vertex_points.cols());
    for (int p = 0; p < plan.rows(); ++p) {
        image.row(p).setZero();
        for (int q = 0; q < plan.cols(); ++q) image.row(p) += plan(p, q) * cell_mean(coarse_to, q, to);
        image.row(p) /= plan.row(p).sum();
    }
    RowMatrix centres = RowMatrix::Zero(from.side.mass.size(), image.cols());
    for (int k = 0; k < centres.rows(); ++k) {
        for (SparseMatrix::InnerIterator it(from.side.averaging.P, k); it; ++it)
            centres.row(k) +=
                it.value() *
                image.row(coarse_from.cell[std::size_t(from.level.samples[std::size_t(it.col())])]);
    }
    return centres;
}

TEST(LevelTransfer, HandsDownImagesThroughParentsAndCells) {
    const PairContext context = tubes().context();
    const LevelPair coarse = context.diffusion_level(2), fine = context.diffusion_level(4);
    const Coupling plan = some_plan(coarse);
    const Start start = LevelSwitch(coarse.A.level, coarse.B.level, fine).hand_down(plan, .01);
    const RowMatrix pi = dense(plan);
    EXPECT_LT((start.centres.row - expected_centres(pi, coarse.A.level, coarse.B.level, fine.A, fine.B))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-10);
    EXPECT_LT((start.centres.column -
               expected_centres(pi.transpose(), coarse.B.level, coarse.A.level, fine.B, fine.A))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-10);
    EXPECT_EQ(start.kept,
              inherited(significant_entries(plan, coarse.A.level.mass, coarse.B.level.mass, .01),
                        parents(fine.A.level, coarse.A.level), parents(fine.B.level, coarse.B.level)));
}

TEST(LevelTransfer, OfTheIdentityStartsNearTheIdentity) {
    const shapes::KnownPair tube = tubes();
    const PairContext context(tube.A, tube.A, {});
    for (int level = 4; level < context.diffusion_levels(); ++level) {
        const LevelPair coarse = context.diffusion_level(level - 1), fine = context.diffusion_level(level);
        const Start start =
            LevelSwitch(coarse.A.level, coarse.B.level, fine).hand_down(identity_plan(coarse.A.level), .01);
        for (int k = 0; k < start.centres.row.rows(); ++k) {
            const auto centre = start.centres.row.row(k), here = fine.A.side.points.row(k);
            EXPECT_GT(2 * centre.dot(here) / (centre.squaredNorm() + here.squaredNorm()), .6)
                << "level " << level;
            EXPECT_TRUE(
                std::binary_search(start.kept[std::size_t(k)].begin(), start.kept[std::size_t(k)].end(), k));
        }
    }
}

TEST(PairContext, PinsLandmarksAtEveryLevel) {
    const shapes::KnownPair tube = tubes();
    const PairContext context = tube.context();
    std::vector<LevelPair> levels;
    for (int l = 0; l < context.diffusion_levels(); ++l) levels.push_back(context.diffusion_level(l));
    for (int l = 0; l < context.euclidean_levels(); ++l) levels.push_back(context.euclidean_level(l, 1));
    for (const LevelPair& pair : levels)
        for (const auto& [a, b] : tube.landmarks) {
            const int i = pair.A.level.cell[std::size_t(a.index)],
                      j = pair.B.level.cell[std::size_t(b.index)];
            EXPECT_EQ(pair.A.level.samples[std::size_t(i)], a.index);
            EXPECT_EQ(pair.B.level.samples[std::size_t(j)], b.index);
            const Partners& partners = pair.partners;
            EXPECT_EQ(partners.row[std::size_t(i)], j);
            EXPECT_EQ(partners.column[std::size_t(j)], i);
            EXPECT_EQ(std::count(partners.row.begin(), partners.row.end(), -1),
                      std::ptrdiff_t(partners.row.size() - tube.landmarks.size()));
        }
}

TEST(PairContext, FindsALevelByItsSamples) {
    const PairContext context = tubes().context();
    const int last = context.diffusion_levels() - 1;
    for (const int l : {last - 1, last}) {
        const LevelPair pair = context.diffusion_level(l);
        EXPECT_EQ(context.find_diffusion_level(pair.A.level.samples, pair.B.level.samples), l);
        const Levels plain = context.diffusion_samples(l);
        EXPECT_EQ(plain.A.cell, pair.A.level.cell);
        EXPECT_EQ(plain.B.mass, pair.B.level.mass);
    }
    const Levels some = context.diffusion_samples(last);
    EXPECT_EQ(context.find_diffusion_level(some.A.samples, some.A.samples), -1);
}

TEST(PairContext, LeadsSurfacesOfDifferentDepthToTheirVertices) {
    const shapes::KnownPair tube = tubes(), figure = shapes::figure_pair(0, false);
    const PairContext context(tube.A, figure.A, {});
    EXPECT_EQ(context.diffusion_levels(),
              std::max(tube.A.hierarchy.diffusion_levels(), figure.A.hierarchy.diffusion_levels()));
    const LevelPair deepest = context.diffusion_level(context.diffusion_levels() - 1);
    EXPECT_EQ(deepest.A.level.samples,
              tube.A.hierarchy.levels[std::size_t(tube.A.hierarchy.diffusion_levels()) - 1].samples);
    std::size_t before = 0;
    for (int l = 0; l < context.euclidean_levels(); ++l) {
        const LevelPair pair = context.euclidean_level(l, 0);
        EXPECT_EQ(pair.A.level.kind, LevelKind::euclidean);
        EXPECT_EQ(pair.B.level.kind, LevelKind::euclidean);
        EXPECT_GE(pair.B.level.samples.size(), before);
        before = pair.B.level.samples.size();
    }
    const LevelPair last = context.euclidean_level(context.euclidean_levels() - 1, 0);
    EXPECT_EQ(int(last.A.level.samples.size()), tube.A.surface.mesh.vertex_count());
    EXPECT_EQ(int(last.B.level.samples.size()), figure.A.surface.mesh.vertex_count());
}

TEST(PairContext, MixesPositionsWithDiffusionCoordinates) {
    const shapes::KnownPair tube = tubes();
    const PairContext context = tube.context();
    const TriangleMesh& mesh = tube.A.surface.mesh;
    EXPECT_EQ(context.euclidean_level(0, 0).A.vertex_points, RowMatrix(mesh.vertices));
    const RowMatrix mixed = context.euclidean_level(0, 1).A.vertex_points;
    EXPECT_EQ(mixed.leftCols(3), mesh.vertices);
    double in_space = 0, beside = 0;
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int c = 0; c < 3; ++c) {
            const int i = mesh.faces(f, c), j = mesh.faces(f, (c + 1) % 3);
            in_space += tube.A.surface.mass[i] * (mixed.row(i) - mixed.row(j)).head(3).squaredNorm();
            beside +=
                tube.A.surface.mass[i] * (mixed.row(i) - mixed.row(j)).tail(mixed.cols() - 3).squaredNorm();
        }
    EXPECT_NEAR(beside / in_space, 1, .05);
}

}  // namespace
}  // namespace varimap
