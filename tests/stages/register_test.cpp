#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fixtures/temporary_folder.h"
#include "stages/register/answers.h"
#include "stages/register/comparison.h"
#include "stages/register/extent.h"
#include "stages/register/manifest.h"
#include "stages/register/procrustes.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/results/map_table.h"

namespace varimap {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Lt;
using ::testing::StartsWith;

const TriangleMesh& body() {
    static const TriangleMesh mesh = shapes::figure(.15);
    return mesh;
}

Points placed(const Points& points, double scale, double angle, const Vec3& by) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vec3(1, 2, .5).normalized()).toRotationMatrix();
    return ((scale * points * turn).rowwise() + by.transpose()).eval();
}

/// Bends upwards in proportion to `amount`.
Points bent(double amount) {
    Points points = body().vertices;
    points.col(2).array() += amount * points.col(0).array().square() / 10;
    return points;
}

double largest_distance(const Points& a, const Points& b) {
    return (a - b).rowwise().norm().maxCoeff();
}

TEST(Procrustes, LaysMovedCopiesOverTheStart) {
    const Eigen::VectorXd weights = voronoi_masses(body());
    const Points& rest = body().vertices;
    const Alignment found =
        procrustes({placed(rest, 1, .4, {1, 2, 3}), placed(rest, 3, -2, {0, -5, 1})}, rest, weights, true);
    EXPECT_THAT(found.distances, Each(Lt(1e-9)));
    EXPECT_NEAR(found.sizes[1] / found.sizes[0], 3, 1e-9);
    // The mean has the mean size, twice that of the start, and lies over it.
    const Eigen::RowVector3d centre = weights.transpose() * rest;
    EXPECT_LT(largest_distance(found.mean, (2 * (rest.rowwise() - centre)).rowwise() + centre), 1e-8);
}

/// The average of the aligned shapes, times `enlarged` about its centroid.
Points average_of(const Alignment& alignment, const Eigen::VectorXd& weights, double enlarged = 1) {
    Points average = Points::Zero(alignment.mean.rows(), 3);
    for (const Points& shape : alignment.shapes) average += shape / double(alignment.shapes.size());
    const Eigen::RowVector3d centre = weights.transpose() * average;
    return (enlarged * (average.rowwise() - centre)).rowwise() + centre;
}

double size_about_centroid(const Points& points, const Eigen::VectorXd& weights) {
    const Eigen::RowVector3d centre = weights.transpose() * points;
    return std::sqrt(weights.dot(Eigen::VectorXd((points.rowwise() - centre).rowwise().squaredNorm())));
}

TEST(Procrustes, TheMeanIsTheAverageEnlargedToTheMeanSize) {
    const Eigen::VectorXd weights = voronoi_masses(body()) / voronoi_masses(body()).sum();
    const std::vector<Points> shapes{bent(-3), placed(bent(1), 2, .5, {1, 0, 0}), bent(4)};
    const Alignment found = procrustes(shapes, body().vertices, weights, true);
    const double size = (found.sizes[0] + found.sizes[1] + found.sizes[2]) / 3;
    const double enlarged = size / size_about_centroid(average_of(found, weights), weights);
    EXPECT_GT(enlarged, 1.001);
    EXPECT_LT(largest_distance(found.mean, average_of(found, weights, enlarged)), 1e-9);
    const Alignment sized = procrustes(shapes, body().vertices, weights, false);
    EXPECT_LT(largest_distance(sized.mean, average_of(sized, weights)), 1e-9);
}

TEST(Procrustes, KeepsSizesWhereAsked) {
    const Eigen::VectorXd weights = voronoi_masses(body());
    const Alignment found = procrustes({body().vertices, placed(body().vertices, 3, 1, {0, 0, 1})},
                                       body().vertices, weights, false);
    EXPECT_NEAR(found.distances[0], found.sizes[0], 1e-6);  // from 1 to the mean 2
    EXPECT_NEAR(found.distances[1], found.sizes[0], 1e-6);
}

TEST(Procrustes, NeverMirrors) {
    const Eigen::VectorXd weights = voronoi_masses(body());
    Points mirrored = body().vertices;
    mirrored.col(0) = -mirrored.col(0);
    const Alignment found = procrustes({mirrored}, body().vertices, weights, true);
    EXPECT_GT(largest_distance(found.shapes[0], body().vertices), .1);
}

TEST(PrincipalComponents, FindTheOneWayInWhichShapesDiffer) {
    const Eigen::VectorXd weights = voronoi_masses(body());
    std::vector<Points> shapes;
    for (const double amount : {-2., -1., 0., 1., 2.})
        shapes.push_back(placed(bent(amount * .01), 1, amount, {amount, 0, 0}));
    const Alignment alignment = procrustes(shapes, body().vertices, weights, false);
    const PrincipalComponents found = principal_components(alignment, weights, 10);
    ASSERT_EQ(found.variance.size(), 4);
    EXPECT_GT(found.variance[0] / found.total_variance, .999);
    EXPECT_NEAR(found.variance.sum(), found.total_variance, 1e-12);
    // Equal steps in the bend are equal steps in the score.
    const Eigen::VectorXd steps = found.scores.col(0).tail(4) - found.scores.col(0).head(4);
    EXPECT_LT((steps.array() / steps.mean() - 1).abs().maxCoeff(), .02);
    // Scores and displacements rebuild the shapes.
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        Points rebuilt = alignment.mean;
        for (Eigen::Index k = 0; k < 4; ++k)
            if (found.variance[k] > 1e-20)
                rebuilt += found.scores(Eigen::Index(i), k) / std::sqrt(found.variance[k]) *
                           found.displacement[std::size_t(k)];
        EXPECT_LT(largest_distance(rebuilt, alignment.shapes[i]), 1e-6);
    }
}

TEST(PrincipalComponents, OfOneShapeAreNone) {
    const Eigen::VectorXd weights = voronoi_masses(body());
    const Alignment alignment = procrustes({body().vertices}, body().vertices, weights, true);
    EXPECT_EQ(principal_components(alignment, weights, 5).variance.size(), 0);
}

TEST(Outliers, AreFarFromTheOthers) {
    EXPECT_THAT(outliers({1, 1.1, .9, 1.05, 5}, 0), ElementsAre(false, false, false, false, true));
    EXPECT_THAT(outliers({1, 1.1, .9, 1.05, 1.2}, 0), Each(false));
    EXPECT_THAT(outliers({1, 50}, 0), Each(false));
}

TEST(Outliers, AreNoRounding) {
    EXPECT_THAT(outliers({0, 0, 0, 0, 1e-12}, 1e-9), Each(false));
    EXPECT_THAT(outliers({0, 0, 0, 0, 1e-3}, 1e-9), ElementsAre(false, false, false, false, true));
}

Answer identity_answer() {
    const PointMap at = shapes::at_vertices(body());
    return {{"a.off", "b.off", body(), body(), at, at}, {}};
}

/// All vertices go to one wrong place, the tip that is numbered last.
Answer wrong_answer() {
    Answer answer = identity_answer();
    const PointMap at = answer.map.there;
    for (SurfacePoint& point : answer.map.there) point = at.back();
    answer.from_first = at;
    return answer;
}

Answer right_answer_of_another() {
    Answer answer = identity_answer();
    answer.from_first = answer.map.there;
    return answer;
}

TEST(CorrespondingPoints, AreTheImagesOfASingleTemplate) {
    EXPECT_LT(largest_distance(corresponding_points({identity_answer()}), body().vertices), 1e-12);
}

TEST(CorrespondingPoints, OneWrongTemplateOfThreeIsOutvoted) {
    const std::vector<Answer> answers{identity_answer(), wrong_answer(), right_answer_of_another()};
    EXPECT_LT(largest_distance(corresponding_points(answers), body().vertices), 1e-9);
}

TEST(CorrespondingPoints, WithoutAnImageAreNotNumbers) {
    Answer answer = identity_answer();
    answer.map.there[3] = {};
    const Points points = corresponding_points({answer});
    EXPECT_TRUE(points.row(3).hasNaN());
    EXPECT_TRUE(points.row(4).allFinite());
}

TEST(TransferredLandmarks, AreTrustedWhereTheWayBackLeadsHome) {
    const PointMap landmarks{{5, {.2, .3, .5}}, {50, {1, 0, 0}}};
    const TransferredLandmarks found = transfer_landmarks({identity_answer()}, {landmarks});
    EXPECT_LT((found.positions.row(0).transpose() - position(body(), landmarks[0])).norm(), 1e-9);
    EXPECT_THAT(found.confidence[0], DoubleNear(1, 1e-9));
    Answer doubtful = identity_answer();
    doubtful.probability = .6;
    const TransferredLandmarks doubted =
        transfer_landmarks({identity_answer(), doubtful}, {landmarks, landmarks});
    EXPECT_THAT(doubted.confidence[0], DoubleNear(.8, 1e-9));
    const TransferredLandmarks wrong = transfer_landmarks({wrong_answer()}, {landmarks});
    EXPECT_LT(wrong.confidence[0], .1);
    const TransferredLandmarks disputed =
        transfer_landmarks({identity_answer(), wrong_answer()}, {landmarks, landmarks});
    EXPECT_GT(disputed.spread[0], .1);
    EXPECT_LT(disputed.confidence[0], .1);
    const TransferredLandmarks absent = transfer_landmarks({identity_answer()}, {{SurfacePoint{}}});
    EXPECT_EQ(absent.confidence[0], 0);
    EXPECT_TRUE(absent.positions.row(0).hasNaN());
}

TEST(Manifest, PickedLandmarksFarFromTheTemplateAreRefused) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "template.ply", to_ply(body()));
    write_file_atomically(folder / "far.pp",
                          "<PickedPoints><point x=\"90\" y=\"0\" z=\"0\" name=\"a\"/></PickedPoints>");
    write_file_atomically(folder / "manifest", R"({"template": ")" + (folder / "template.ply") +
                                                   R"(", "landmarks": ")" + (folder / "far.pp") + R"("})");
    try {
        read_registration(folder / "manifest", {LandmarkSpace::stated});
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("far.pp:1: 1 of 1 landmarks lie farther than 0.02 from the surface"));
    }
}

/// A specimen that a further template alone answers for, all three the same body; landmarks on the templates.
class FurtherTemplate : public ::testing::Test {
  protected:
    void SetUp() override {
        write("body.ply", to_ply(body()));
        write("same.csv", to_csv(shapes::at_vertices(body())));
    }
    void write(const std::string& name, const std::string& text) {
        write_file_atomically(folder_ / name, text);
    }
    Registration registration(const std::string& first, const std::string& own) {
        write("first.csv", first);
        write("own.csv", own);
        const auto path = [&](const std::string& name) { return "\"" + (folder_ / name) + "\""; };
        write("manifest", "{\"template\": " + path("body.ply") + ", \"landmarks\": " + path("first.csv") +
                              R"(, "specimens": [{"name": "a", "mesh": )" + path("body.ply") +
                              R"(, "answers": [{"template": )" + path("body.ply") + R"(, "there": )" +
                              path("same.csv") + R"(, "back": )" + path("same.csv") + R"(, "from_first": )" +
                              path("same.csv") + R"(, "landmarks": )" + path("own.csv") + "}]}]}");
        return read_registration(folder_ / "manifest", {LandmarkSpace::stated});
    }
    std::string refusal(const std::string& first, const std::string& own) {
        try {
            registration(first, own);
        } catch (const InputError& error) {
            return error.what();
        }
        return "none";
    }
    TemporaryFolder folder_;
};

TEST_F(FurtherTemplate, LandmarksBelongTogetherByTheirNames) {
    const Registration all = registration("nose,5\ntail,50\n", "tail,51\nnose,6\n");
    EXPECT_THAT(all.landmarks->names, ElementsAre("nose", "tail"));
    const Points& found = all.transferred[0].positions;
    EXPECT_LT((found.row(0) - body().vertices.row(6)).norm(), 1e-9);
    EXPECT_LT((found.row(1) - body().vertices.row(51)).norm(), 1e-9);
}

TEST_F(FurtherTemplate, LandmarksWithoutNamesBelongTogetherRowByRow) {
    const Registration all = registration("nose,5\ntail,50\n", "6\n51\n");
    EXPECT_LT((all.transferred[0].positions.row(1) - body().vertices.row(51)).norm(), 1e-9);
}

std::string at(const TriangleMesh& mesh, int vertex, const char* separator) {
    const Vec3 place = mesh.vertex(vertex);
    return fmt::format("{}{}{}{}{}\n", place[0], separator, place[1], separator, place[2]);
}

TEST_F(FurtherTemplate, LandmarksMayBePoints) {
    const Registration all =
        registration("name,x,y,z\nnose," + at(body(), 5, ",") + "tail," + at(body(), 50, ","),
                     at(body(), 6, " ") + at(body(), 51, " "));
    EXPECT_THAT(all.landmarks->names, ElementsAre("nose", "tail"));
    EXPECT_LT((position(body(), all.landmarks->points[1]) - body().vertex(50)).norm(), 1e-9);
    EXPECT_LT((all.transferred[0].positions.row(1) - body().vertices.row(51)).norm(), 1e-9);
}

TEST_F(FurtherTemplate, LandmarksAreReadInTheAxesThatWereAskedFor) {
    std::string turned;
    for (const int v : {5, 50, 90}) {
        const Vec3 place = body().vertex(v);
        turned += fmt::format("{} {} {}\n", -place[0], -place[1], place[2]);
    }
    write("turned.txt", turned);
    write("manifest", R"({"templates": [{"template": ")" + (folder_ / "body.ply") + R"(", "landmarks": ")" +
                          (folder_ / "turned.txt") + R"("}]})");
    EXPECT_NO_THROW(check_landmarks(folder_ / "manifest", {LandmarkSpace::ras}));
    EXPECT_THROW(check_landmarks(folder_ / "manifest", {LandmarkSpace::stated}), InputError);
}

TEST_F(FurtherTemplate, RefusesLandmarksOfOtherNames) {
    const std::string first = "nose,5\ntail,50\n";
    EXPECT_THAT(refusal(first, "nose,5\near,50\n"),
                HasSubstr("own.csv: 'tail', a landmark of the first template, is not there; give the same"));
    EXPECT_THAT(refusal("nose,5\ntail,50\near,7\n", "ear,5\nnose,50\nnose,7\n"),
                HasSubstr("own.csv: 'nose', a landmark of the first template, is there twice"));
    EXPECT_THAT(refusal(first, "nose,5\n"), HasSubstr("own.csv: 1 landmarks, but the first template has 2"));
}

TriangleMesh two_triangles() {
    TriangleMesh square;
    square.vertices = Points{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
    square.faces = Faces{{0, 1, 2}, {0, 2, 3}};
    return square;
}

TEST(Extents, LackWhatOneSpecimenLacks) {
    const TriangleMesh square = two_triangles();
    Points lacking = square.vertices;
    lacking.row(1).setConstant(std::nan(""));
    const Extent common = Extents(square, {square.vertices, lacking}, {false, false}, {"a", "b"}).common();
    EXPECT_THAT(common.vertices, ElementsAre(0, 2, 3));
    EXPECT_EQ(common.faces, (Faces{{0, 2, 3}}));
    EXPECT_THAT(common.weights, Each(DoubleNear(1. / 3, 1e-12)));
    EXPECT_EQ(common.of(lacking).row(2), square.vertices.row(3));
    lacking.row(3).setConstant(std::nan(""));
    const auto refusal = [&](const std::vector<Points>& specimens, const std::vector<bool>& is_part) {
        try {
            Extents(square, specimens, is_part, {"a", "b"});
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(refusal({square.vertices, lacking}, {false, false}), HasSubstr("; b has the least"));
    EXPECT_THAT(refusal({square.vertices, lacking}, {false, true}), testing::StartsWith("b has nothing of"));
}

TEST(Extents, OfAPartAreNotThoseOfTheOthers) {
    const TriangleMesh square = two_triangles();
    Points part = square.vertices;
    part.row(1).setConstant(std::nan(""));
    const Extents extents(square, {square.vertices, part}, {false, true}, {"whole", "part"});
    EXPECT_THAT(extents.common().vertices, ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(extents.of(0).vertices, ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(extents.of(1).vertices, ElementsAre(0, 2, 3));
    EXPECT_EQ(extents.of(1).faces, (Faces{{0, 2, 3}}));
    EXPECT_THAT(extents.of(1).weights, Each(DoubleNear(1. / 3, 1e-12)));
}

/// The body bent in three ways, and a moved, larger copy of one of these that lacks its front.
Registration with_a_part() {
    Registration all;
    all.first = body();
    Points part = placed(bent(.02), 3, 1.2, {5, 0, -4});
    for (Eigen::Index v = 0; v < part.rows(); ++v)
        if (body().vertices(v, 0) > 0) part.row(v).setConstant(std::nan(""));
    all.points = {bent(0), part, bent(.01), bent(.02)};
    all.is_part = {false, true, false, false};
    all.is_mirrored.assign(4, false);
    all.names = {"a", "part", "b", "c"};
    return all;
}

TEST(Comparison, LaysAPartOverTheMeanByWhatItHas) {
    const Registration all = with_a_part();
    const Extents extents(all.first, all.points, all.is_part, all.names);
    const ShapeComparison shapes = compare_shapes(all, extents, 5, true);
    EXPECT_EQ(shapes.components.scores.rows(), 3);
    EXPECT_NEAR(shapes.sizes[1] / shapes.sizes[3], 3, .02);
    // Where the whole one lies of which it is a part, but for what little the rest of that moves it.
    Points whole = Points::Zero(body().vertex_count(), 3);
    whole(extents.common().vertices, Eigen::all) = shapes.aligned[3];
    EXPECT_LT(largest_distance(shapes.aligned[1], extents.of(1).of(whole)), .02);
    EXPECT_LT(shapes.distances[1], .02);
}

TEST(Comparison, NamesASpecimenOnWhichAllPointsLieInOnePlace) {
    Registration all = with_a_part();
    const Extents extents(all.first, all.points, all.is_part, all.names);
    all.points[2].rowwise() = Eigen::RowVector3d(1, 2, 3);
    try {
        compare_shapes(all, extents, 5, true);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), StartsWith("b: all of the template's points lie in one place"));
    }
}

TEST(Comparison, OfPartsAloneIsWithTheTemplate) {
    Registration all = with_a_part();
    all.is_part = {true, true, true, true};
    const Extents extents(all.first, all.points, all.is_part, all.names);
    const ShapeComparison shapes = compare_shapes(all, extents, 5, true);
    EXPECT_EQ(shapes.components.variance.size(), 0);
    EXPECT_LT(largest_distance(shapes.mean, extents.common().of(body().vertices)), 1e-12);
    EXPECT_LT(shapes.distances[0], 1e-9);
}

}  // namespace
}  // namespace varimap
