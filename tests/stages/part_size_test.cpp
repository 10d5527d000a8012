#include "stages/locate/part_size.h"

#include <gtest/gtest.h>

#include <vector>

#include "fixtures/shapes.h"
#include "stages/locate/sides.h"
#include "stages/preprocess/preprocess.h"

namespace varimap {
namespace {

/// The vertices at the ends of the axes but for the lowest.
std::vector<int> ends(const TriangleMesh& mesh) {
    std::vector<int> result;
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        int farthest;
        (mesh.vertices * axis).maxCoeff(&farthest);
        result.push_back(farthest);
    }
    return result;
}

TEST(PartSize, IsThatOfTheAreas) {
    const TriangleMesh ball = shapes::ellipsoid(4);
    std::vector<int> upper;
    for (int f = 0; f < ball.face_count(); ++f)
        if (position(ball, {f, Vec3::Constant(1.0 / 3)}).z() > -.3) upper.push_back(f);
    const Surface whole = preprocess(ball, {});
    for (const double units : {1., 1.1, 10., .001}) {
        TriangleMesh piece{ball.vertices, ball.faces(upper, Eigen::all)};
        piece.vertices *= units;
        const Surface part = preprocess(piece, {});
        const PartSize size = part_size(part, ends(part.mesh), whole, ends(whole.mesh));
        const double expected = units == 1.1 ? 1 : 1 / units;  // a tenth may be the landmarks' error
        EXPECT_NEAR(size.scale / expected, 1, .05) << units;
        EXPECT_NEAR(size.share, (units == 1.1 ? 1.21 : 1) * .65, .05) << units;
    }
}

TEST(Sides, TakeNoSizeFromTheOnePathBetweenTwoLandmarks) {
    const TriangleMesh ball = shapes::ellipsoid(4);
    std::vector<int> lower;
    for (int f = 0; f < ball.face_count(); ++f)
        if (position(ball, {f, Vec3::Constant(1.0 / 3)}).z() < .6) lower.push_back(f);
    const Surface whole = preprocess(ball, {}),
                  part = preprocess(TriangleMesh{ball.vertices, ball.faces(lower, Eigen::all)}, {});
    // On both sides of what was cut off.
    VertexPairs<MeshVertex> landmarks;
    for (const double side : {1., -1.}) {
        int a, b;
        (part.mesh.vertices * Vec3(.8 * side, 0, .6)).maxCoeff(&a);
        (whole.mesh.vertices * Vec3(.8 * side, 0, .6)).maxCoeff(&b);
        landmarks.emplace_back(MeshVertex{a}, MeshVertex{b});
    }
    const Sides sides(part, whole, landmarks, PartSide::source);
    EXPECT_LT(part_size(part, sides.landmarks_part, whole, sides.landmarks_whole).scale, .8);
    EXPECT_EQ(sides.size().scale, 1);
    EXPECT_NEAR(sides.size().share, .8, .02);
}

/// The larger one is no part.
TEST(PartSize, MayBeLargerThanTheWhole) {
    const TriangleMesh ball = shapes::ellipsoid(3);
    const Surface one = preprocess(ball, {});
    TriangleMesh stretched = ball;
    stretched.vertices.col(2) *= 3;
    const Surface other = preprocess(stretched, {});
    EXPECT_GT(part_size(other, ends(other.mesh), one, ends(one.mesh)).share, 1.1);
}

}  // namespace
}  // namespace varimap
