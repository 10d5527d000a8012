#include "varimap/multilevel/compared_terms.h"

#include <gtest/gtest.h>

#include "fixtures/known_pair.h"

namespace varimap {
namespace {

const PairContext& figures() {
    static const PairContext context = shapes::figure_pair(1, false).context();
    return context;
}

double mean_square(const RowMatrix& rows, const Eigen::VectorXd& mass) {
    return mass.dot(rows.rowwise().squaredNorm());
}

TEST(FeatureTerm, AddsNothingAtWeightZero) {
    LevelPair pair = figures().diffusion_level(3);
    FeatureTerm(figures(), 0).add_to(pair);
    EXPECT_EQ(pair.A.side.compared.size(), 0);
    EXPECT_EQ(pair.B.side.compared.size(), 0);
}

TEST(FeatureTerm, GrowsWithItsWeightAndWithTheUnitsOfTheEmbedding) {
    const auto features = [](double weight, double unit) {
        LevelPair pair = figures().diffusion_level(5);
        for (Side* side : {&pair.A.side, &pair.B.side}) side->points *= unit;
        FeatureTerm(figures(), weight).add_to(pair);
        return pair.A.side.compared;
    };
    const RowMatrix once = features(1, 1);
    ASSERT_GT(once.norm(), 0);
    EXPECT_LT((features(4, 1) - 2 * once).norm(), 1e-12 * once.norm());
    EXPECT_LT((features(1, 10) - 10 * once).norm(), 1e-9 * once.norm());
}

TEST(FeatureTerm, StandsBesideTheWassersteinTerm) {
    LevelPair both = figures().diffusion_level(5), one = both;
    add_wasserstein_term(both, figures(), .5);
    ASSERT_EQ(both.A.side.compared.cols(), 3);
    const RowMatrix positions = both.A.side.compared;
    FeatureTerm(figures(), 1).add_to(both);
    FeatureTerm(figures(), 1).add_to(one);
    EXPECT_EQ(both.A.side.compared.leftCols(3), positions);
    EXPECT_EQ(both.A.side.compared.rightCols(one.A.side.compared.cols()), one.A.side.compared);
}

TEST(FeatureTerm, AgreesBetweenPosesOfOneShape) {
    const shapes::KnownPair pair = shapes::figure_pair(1, false);
    const PairContext context = pair.context();
    LevelPair level = context.diffusion_level(context.diffusion_levels() - 1);
    FeatureTerm(context, 1).add_to(level);
    const Side &A = level.A.side, &B = level.B.side;
    RowMatrix there(A.compared.rows(), A.compared.cols());
    for (Eigen::Index k = 0; k < there.rows(); ++k) {
        const int image = shapes::nearest_vertex(context.B().surface.mesh,
                                                 pair.A_on_B.row(level.A.level.samples[k]).transpose());
        there.row(k) = B.compared.row(level.B.level.cell[image]);
    }
    const RowMatrix turned = there.colwise().reverse();
    EXPECT_LT(mean_square(A.compared - there, A.mass), .5 * mean_square(A.compared - turned, A.mass));
}

}  // namespace
}  // namespace varimap
