#include "varimap/core/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace varimap {
namespace {

using Rows = Eigen::Matrix<double, 4, 3, Eigen::RowMajor>;

const Eigen::Matrix3d turn = Eigen::AngleAxisd(.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
const Eigen::Vector4d weights(1, 3, .5, 2);
const Rows corners = (Rows() << 0, 0, 0, 1, 0, 0, 0, 2, 0, .5, .3, 3).finished();

TEST(NearestRotation, TakesPointsOntoTheirTurnedAndShiftedSelves) {
    const Rows moved = (corners * turn.transpose()).rowwise() + Eigen::RowVector3d(4, -1, 9);
    EXPECT_TRUE(nearest_rotation(corners, moved, weights).isApprox(turn, 1e-12));
}

TEST(NearestRotation, IsAReflectionWhereThatIsAsked) {
    const Eigen::Matrix3d mirror = Eigen::Vector3d(-1, 1, 1).asDiagonal();
    const Rows reflected = corners * (turn * mirror).transpose();
    EXPECT_TRUE(nearest_rotation(corners, reflected, weights, true).isApprox(turn * mirror, 1e-12));
    EXPECT_NEAR(nearest_rotation(corners, reflected, weights).determinant(), 1, 1e-12);
}

TEST(NearestRotation, GoesByTheWeights) {
    Rows moved = corners * turn.transpose();
    moved.row(3) += Eigen::RowVector3d(5, 5, 5);  // an outlier, which counts for nothing
    const Eigen::Vector4d without(1, 3, .5, 0);
    EXPECT_FALSE(nearest_rotation(corners, moved, weights).isApprox(turn, 1e-2));
    // Three points lie in a plane; which side of it is the front follows from the rotation.
    EXPECT_TRUE(nearest_rotation(corners, moved, without).isApprox(turn, 1e-12));
}

}  // namespace
}  // namespace varimap
