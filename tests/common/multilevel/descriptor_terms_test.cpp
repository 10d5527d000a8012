#include "varimap/multilevel/descriptor_terms.h"

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

TEST(ShapeTerm, AddsNothingAtWeightZero) {
    LevelPair pair = figures().diffusion_level(3);
    add_shape_term(pair, figures(), 0);
    EXPECT_EQ(pair.A.side.descriptor.size(), 0);
    EXPECT_EQ(pair.B.side.descriptor.size(), 0);
}

TEST(ShapeTerm, GrowsWithItsWeightAndWithTheUnitsOfTheEmbedding) {
    const auto descriptors = [](double weight, double unit) {
        LevelPair pair = figures().diffusion_level(5);
        for (Side* side : {&pair.A.side, &pair.B.side}) side->points *= unit;
        add_shape_term(pair, figures(), weight);
        return pair.A.side.descriptor;
    };
    const RowMatrix once = descriptors(1, 1);
    ASSERT_GT(once.norm(), 0);
    EXPECT_LT((descriptors(4, 1) - 2 * once).norm(), 1e-12 * once.norm());
    EXPECT_LT((descriptors(1, 10) - 10 * once).norm(), 1e-9 * once.norm());
}

TEST(ShapeTerm, StandsBesideTheWassersteinTerm) {
    LevelPair both = figures().diffusion_level(5), one = both;
    add_wasserstein_term(both, figures(), .5);
    ASSERT_EQ(both.A.side.descriptor.cols(), 3);
    const RowMatrix positions = both.A.side.descriptor;
    add_shape_term(both, figures(), 1);
    add_shape_term(one, figures(), 1);
    EXPECT_EQ(both.A.side.descriptor.leftCols(3), positions);
    EXPECT_EQ(both.A.side.descriptor.rightCols(one.A.side.descriptor.cols()), one.A.side.descriptor);
}

TEST(ShapeTerm, AgreesBetweenPosesOfOneShape) {
    const shapes::KnownPair pair = shapes::figure_pair(1, false);
    const PairContext context = pair.context();
    LevelPair level = context.diffusion_level(context.diffusion_levels() - 1);
    add_shape_term(level, context, 1);
    const Side &A = level.A.side, &B = level.B.side;
    RowMatrix there(A.descriptor.rows(), A.descriptor.cols());
    for (Eigen::Index k = 0; k < there.rows(); ++k) {
        const int image = shapes::nearest_vertex(context.B().surface.mesh,
                                                 pair.A_on_B.row(level.A.level.samples[k]).transpose());
        there.row(k) = B.descriptor.row(level.B.level.cell[image]);
    }
    const RowMatrix turned = there.colwise().reverse();
    EXPECT_LT(mean_square(A.descriptor - there, A.mass), .5 * mean_square(A.descriptor - turned, A.mass));
}

TEST(LandmarkTerm, AddsNothingWithoutLandmarksOrWeight) {
    LevelPair pair = figures().diffusion_level(3);
    add_landmark_term(pair, figures(), 1);
    EXPECT_EQ(pair.A.side.descriptor.size(), 0);
    const PairContext context = shapes::figure_pair(1, true).context();
    pair = context.diffusion_level(3);
    add_landmark_term(pair, context, 0);
    EXPECT_EQ(pair.A.side.descriptor.size(), 0);
}

TEST(LandmarkTerm, FallsAwayFromEachLandmark) {
    const PairContext context = shapes::figure_pair(1, true).context();
    LevelPair pair = context.euclidean_level(context.euclidean_levels() - 1, 0);  // samples are vertices
    add_landmark_term(pair, context, 1);
    const RowMatrix& near = pair.A.side.descriptor;
    ASSERT_EQ(near.cols(), Eigen::Index(context.landmarks().size()));
    for (Eigen::Index k = 0; k < near.cols(); ++k) {
        Eigen::Index nearest = 0;
        EXPECT_GT(near.col(k).maxCoeff(&nearest), 100 * near.col(k).minCoeff());
        EXPECT_EQ(pair.A.level.samples[std::size_t(nearest)],
                  context.landmarks()[std::size_t(k)].first.index);
    }
}

/// Softer ones hold less.
TEST(LandmarkTerm, GrowsWithItsWeightAndThatOfTheLandmarks) {
    const auto descriptors = [](double weight, double landmark_weight) {
        const PairContext context = shapes::figure_pair(1, true).context(landmark_weight);
        LevelPair pair = context.diffusion_level(context.diffusion_levels() - 1);
        add_landmark_term(pair, context, weight);
        return pair.A.side.descriptor;
    };
    const RowMatrix once = descriptors(1, 1);
    ASSERT_GT(once.norm(), 0);
    EXPECT_LT((descriptors(4, 1) - 2 * once).norm(), 1e-12 * once.norm());
    EXPECT_LT((descriptors(1, .25) - once / 2).norm(), 1e-12 * once.norm());
}

TEST(DescriptorTerms, AreThoseOfShapeAndOfLandmarks) {
    const PairContext context = shapes::figure_pair(1, true).context();
    LevelPair both = context.diffusion_level(3), apart = both;
    add_descriptor_terms(both, context, {.shape = .5, .vicinity = 4});
    add_shape_term(apart, context, .5);
    add_landmark_term(apart, context, 4);
    EXPECT_EQ(both.A.side.descriptor, apart.A.side.descriptor);
    EXPECT_EQ(both.B.side.descriptor, apart.B.side.descriptor);
}

}  // namespace
}  // namespace varimap
