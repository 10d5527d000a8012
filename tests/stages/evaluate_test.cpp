#include "stages/evaluate/evaluate.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fixtures/temporary_folder.h"
#include "varimap/core/error.h"
#include "varimap/core/logged.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/results/map_table.h"

namespace varimap {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// A square of side and area 1 on itself. Its first vertices are a step of 1/4 apart, in a row.
class Evaluate : public ::testing::Test {
  protected:
    std::string write(const std::string& name, const std::string& text) {
        write_file_atomically(folder_ / name, text);
        return folder_ / name;
    }
    EvaluateRequest request(const PointMap& map, const std::string& sources, const std::string& targets) {
        return {.target_mesh = write("b.ply", to_ply(square_)),
                .map = write("map.csv", to_csv(map)),
                .points = {write("sources.txt", sources), write("targets.txt", targets)}};
    }
    /// The message of the UsageError it throws.
    static std::string refusal(const EvaluateRequest& asked) {
        try {
            evaluate(asked);
        } catch (const UsageError& error) {
            return error.what();
        }
        return "none";
    }
    TemporaryFolder folder_;
    const TriangleMesh square_ = shapes::square(4);
    const PointMap identity_ = shapes::at_vertices(square_);
};

TEST_F(Evaluate, MeasuresFromImagesToWherePointsBelong) {
    const MapErrors errors = evaluate(request(identity_, "0\n1\n2\n", "0\n2\n0\n"));
    ASSERT_EQ(errors.errors.size(), 3u);
    EXPECT_EQ(errors.errors[0], 0);
    EXPECT_NEAR(errors.errors[1], .25, 1e-6);
    EXPECT_NEAR(errors.errors[2], .5, 1e-6);
    EXPECT_EQ(errors.unmapped, 0);
}

TEST_F(Evaluate, LeavesOutPointsWithoutAnImage) {
    PointMap map = identity_;
    map[1] = {-1, Vec3::Zero()};
    const MapErrors errors = evaluate(request(map, "0\n1\n", "1\n1\n"));
    EXPECT_EQ(errors.unmapped, 1);
    ASSERT_EQ(errors.errors.size(), 1u);
    EXPECT_NEAR(errors.errors[0], .25, 1e-6);
}

TEST_F(Evaluate, CountsListsFromTheirBase) {
    EvaluateRequest from_1 = request(identity_, "1\n2\n", "1\n3\n");
    from_1.reading.base = IndexBase::one;
    EXPECT_NEAR(evaluate(from_1).mean(), .125, 1e-6);
    from_1.points[1] = write("targets.txt", "0\n3\n");
    EXPECT_THROW(evaluate(from_1), InputError);
}

TEST_F(Evaluate, TheNumbersOfListsTellTheirBase) {
    const std::string last = std::to_string(square_.vertex_count()) + "\n";
    const auto warnings_of = [&](const std::string& sources, const std::string& targets, double mean) {
        const std::size_t before = logged_warnings().size();
        EXPECT_NEAR(evaluate(request(identity_, sources, targets)).mean(), mean, 1e-6);
        return logged_warnings().size() - before;
    };
    EXPECT_EQ(warnings_of("2\n" + last, "3\n" + last, .125), 0u) << "from 1";
    EXPECT_EQ(warnings_of("2\n3\n", "2\n" + last, 0.5 * std::hypot(.5, 1)), 0u) << "so is the other list";
    EXPECT_EQ(warnings_of("0\n2\n", "1\n2\n", .125), 0u) << "from 0";
    EXPECT_EQ(warnings_of("2\n3\n", "2\n4\n", .125), 1u);
    EXPECT_THAT(logged_warnings().back(),
                HasSubstr("nothing tells whether their vertices are counted from 0"));
    EvaluateRequest told = request(identity_, "2\n3\n", "2\n4\n");
    told.reading.base = IndexBase::zero;
    const std::size_t before = logged_warnings().size();
    evaluate(told);
    EXPECT_EQ(logged_warnings().size(), before);
}

TEST_F(Evaluate, CountsAMapOfVerticesFromItsBase) {
    std::string numbers;
    for (int v = 0; v < square_.vertex_count(); ++v) numbers += std::to_string(std::max(v, 1)) + "\n";
    EvaluateRequest asked = request({}, "2\n3\n", "2\n3\n");
    asked.map = write("map.txt", numbers);
    asked.map_base = IndexBase::zero;
    EXPECT_EQ(evaluate(asked).maximum(), 0);
    asked.map_base = IndexBase::one;
    EXPECT_NEAR(evaluate(asked).maximum(), .25, 1e-6);
}

TEST_F(Evaluate, NumbersOfATargetAreThoseOfItsFile) {
    TriangleMesh file = square_;  // its first face is degenerate, and all numbers of faces are one more
    file.faces.resize(square_.face_count() + 1, 3);
    file.faces << 0, 0, 1, square_.faces;
    EvaluateRequest asked = request(shapes::at_vertices(file), "7\n8\n", "7\n9\n");
    asked.target_mesh = write("b.ply", to_ply(file));
    const MapErrors errors = evaluate(asked);
    ASSERT_EQ(errors.errors.size(), 2u);
    EXPECT_EQ(errors.errors[0], 0);
    EXPECT_NEAR(errors.errors[1], .25, 1e-6);
}

TEST_F(Evaluate, CarriesLandmarksOfAnyFormFromTheSource) {
    EvaluateRequest asked = request(identity_, "", "");
    asked.points = {write("pairs.txt", "0 0 0  .25 0 0\n.625 .125 0  .125 .125 0\n")};
    EXPECT_THAT(refusal(asked),
                HasSubstr("pairs.txt: landmarks that are no lists of vertices need --source"));
    asked.source_mesh = write("a.ply", to_ply(square_));
    const MapErrors errors = evaluate(asked);
    ASSERT_EQ(errors.errors.size(), 2u);
    EXPECT_NEAR(errors.errors[0], .25, 1e-6);
    EXPECT_NEAR(errors.errors[1], .5, 1e-6);
}

TEST_F(Evaluate, RefusesMoreThanTwoFilesOfPoints) {
    EvaluateRequest asked = request(identity_, "0\n", "0\n");
    asked.points.push_back(asked.points[0]);
    EXPECT_THAT(refusal(asked), HasSubstr("points: give a list for the source and one for the target"));
}

TEST_F(Evaluate, ChecksPointsBeforeThereIsAMap) {
    EvaluateRequest asked = request({}, "0\n1\n", "0\n24\n");
    asked.map = "none";
    check_points(asked);
    asked.points[1] = write("targets.txt", "0\n26\n");
    EXPECT_THROW(check_points(asked), InputError);
    asked.points = {write("sources.txt", "0\n26\n"), write("targets.txt", "0\n1\n")};
    check_points(asked);
    asked.source_mesh = write("a.ply", to_ply(square_));
    EXPECT_THROW(check_points(asked), InputError) << "the source tells how many vertices it has";
    asked.points = {write("pairs.txt", "0 0 0  .25 0 0\n")};
    check_points(asked);
    asked.points = {write("pairs.txt", "0 0 0  .25 0\n")};
    EXPECT_THROW(check_points(asked), InputError);
}

TEST_F(Evaluate, JsonHoldsEveryNumber) {
    MapErrors errors{{0, .03125, .0625, .25}, 2};
    const Json expected = Json::parse(R"({"pairs": 4, "unmapped": 2, "mean": 0.0859375, "median": 0.046875,
        "maximum": 0.25, "share_0025": 0.25, "share_005": 0.5, "share_01": 0.75})");
    EXPECT_EQ(Json::parse(as_json(errors)), expected);
    errors.smoothed_mean = .5;
    EXPECT_EQ(Json::parse(as_json(errors))["smoothed_mean"], .5);
}

TEST_F(Evaluate, TextHoldsOneNumberPerLine) {
    MapErrors errors{{0, .03125, .0625, .25}, 0};
    EXPECT_EQ(as_text(errors),
              "geodesic error in units of sqrt(target area)\n"
              "pairs                     4\n"
              "mean                0.08594\n"
              "median              0.04688\n"
              "maximum             0.25000\n"
              "share within 0.025  25.00 %\n"
              "share within 0.05   50.00 %\n"
              "share within 0.1    75.00 %\n");
    errors.unmapped = 3;
    errors.smoothed_mean = .5;
    EXPECT_THAT(as_text(errors), HasSubstr("unmapped                  3\nmean "));
    EXPECT_THAT(as_text(errors), HasSubstr("smoothed mean       0.50000\nmedian "));
}

}  // namespace
}  // namespace varimap
