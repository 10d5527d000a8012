#include "varimap/results/surface_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <locale>

#include "varimap/core/error.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/results/map_table.h"
#include "varimap/results/quality_numbers.h"

namespace varimap {
namespace {

class SurfaceMapFile : public ::testing::Test {
  protected:
    std::string path_ = ::testing::TempDir() + "/surface_map_" +
                        ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
    void TearDown() override { std::filesystem::remove(path_); }

    PointMap read(const std::string& text) {
        write_file_atomically(path_, text);
        return read_csv_map(path_);
    }
    void expect_refused(const std::string& text, const std::string& place) {
        try {
            read(text);
            ADD_FAILURE() << "accepted:\n" << text;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(path_ + ":" + place), std::string::npos) << error.what();
        }
    }
};

PointMap awkward_map() {
    return {{7, Vec3(1.0 / 3, 0.1, 1 - 1.0 / 3 - 0.1)},
            {},
            {0, Vec3(1, 0, 0)},
            {2147483647, Vec3(1e-17, 1, 5e-324)}};
}

void expect_equal(const PointMap& a, const PointMap& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].face, b[i].face);
        EXPECT_EQ(a[i].barycentric, b[i].barycentric);
    }
}

TEST_F(SurfaceMapFile, ReadsBackExactly) {
    expect_equal(read(to_csv(awkward_map())), awkward_map());
    EXPECT_TRUE(read(to_csv({})).empty());
}

TEST_F(SurfaceMapFile, HasTheDocumentedForm) {
    const PointMap map{{3, Vec3(0.25, 0.5, 0.25)}, {}};
    EXPECT_EQ(to_csv(map), "vertex,face,b0,b1,b2\n0,3,0.25,0.5,0.25\n1,-1,0,0,0\n");
}

/// A locale with a decimal comma, installed or not.
struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST_F(SurfaceMapFile, IgnoresTheLocale) {
    const std::string before = to_csv(awkward_map());
    const std::locale saved = std::locale::global(std::locale(std::locale(), new Comma));
    const std::string after = to_csv(awkward_map());
    const PointMap map = read(before);
    std::locale::global(saved);
    EXPECT_EQ(after, before);
    expect_equal(map, awkward_map());
}

TEST_F(SurfaceMapFile, AcceptsLinesOfOtherSystems) {
    expect_equal(read("vertex,face,b0,b1,b2\r\n0,3,0.25,0.5,0.25\r\n"), {{3, Vec3(0.25, 0.5, 0.25)}});
    expect_equal(read("vertex,face,b0,b1,b2\n0,3,0.25,0.5,0.25"), {{3, Vec3(0.25, 0.5, 0.25)}});
}

TEST_F(SurfaceMapFile, RefusesNamingTheLine) {
    const std::string header = "vertex,face,b0,b1,b2\n", good = "0,3,0.25,0.5,0.25\n";
    expect_refused("", "1");
    expect_refused("0,1,2\n", "1");
    expect_refused(header + good + "1,3,0.25,0.5\n", "3");
    expect_refused(header + good + "1,3,0.25,0.5,0.25,1\n", "3");
    expect_refused(header + good + "2,3,0.25,0.5,0.25\n", "3");
    expect_refused(header + good + "\n" + good, "3");
    expect_refused(header + "0,-2,0.25,0.5,0.25\n", "2");
    expect_refused(header + "0,3,0.25,0.5,0.5\n", "2");
    expect_refused(header + "0,3,-1,1,1\n", "2");
    expect_refused(header + "0,3,nan,0.5,0.25\n", "2");
    expect_refused(header + "0,99999999999,0.25,0.5,0.25\n", "2");
}

SurfaceMap small_map() {
    UntanglingReport report;
    report.flipped_before = 3;
    report.gated_area_percent = .5;
    return {awkward_map(), {{1, Vec3(0, 1, 0)}}, {{}, report}};
}

TEST(SurfaceMapArtifact, DecodesWhatItEncodes) {
    const SurfaceMap map = small_map();
    SurfaceMap again;
    decode(encode(map), again);
    expect_equal(again.A_to_B, map.A_to_B);
    expect_equal(again.B_to_A, map.B_to_A);
    EXPECT_EQ(again.untangling.B_to_A.flipped_before, 3);
    EXPECT_EQ(again.untangling.B_to_A.gated_area_percent, .5);
    EXPECT_EQ(encode(again), encode(map));
    EXPECT_THROW(decode(encode(map).substr(0, 60), again), ArtifactError);
}

TEST(SurfaceMapArtifact, RefusesPointsAndNumbersThatCannotBe) {
    SurfaceMap again, map = small_map();
    map.A_to_B[0].face = -2;
    EXPECT_THROW(decode(encode(map), again), ArtifactError);
    map = small_map();
    map.A_to_B[0].barycentric = Vec3(.5, .6, 0);
    EXPECT_THROW(decode(encode(map), again), ArtifactError);
    map = small_map();
    map.untangling.A_to_B.replaced_area_percent = std::nan("");
    EXPECT_THROW(decode(encode(map), again), ArtifactError);
}

TEST(QualityNumbersArtifact, IsAJsonObject) {
    QualityNumbers again;
    decode(encode(QualityNumbers{R"({"energy": 1})"}), again);
    EXPECT_EQ(again.json, R"({"energy": 1})");
    EXPECT_THROW(decode("[1]", again), ArtifactError);
    EXPECT_THROW(decode(R"({"energy": )", again), ArtifactError);
}

TEST(ImagePositions, KeepTheFallbackWhereThereIsNoImage) {
    const TriangleMesh target{(Points(3, 3) << 0, 0, 0, 1, 0, 0, 0, 2, 0).finished(),
                              (Faces(1, 3) << 0, 1, 2).finished()};
    const Points fallback = Points::Constant(2, 3, 9);
    const Points positions = image_positions({{}, {0, Vec3(0.5, 0.25, 0.25)}}, target, fallback);
    EXPECT_EQ(positions, (Points(2, 3) << 9, 9, 9, 0.25, 0.5, 0).finished());
}

}  // namespace
}  // namespace varimap
