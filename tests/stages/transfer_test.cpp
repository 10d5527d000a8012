#include "stages/transfer/transfer.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "fixtures/shapes.h"
#include "fixtures/transfer.h"
#include "varimap/core/error.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/results/map_table.h"

namespace varimap {
namespace {

using namespace transfers;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(Transfer, ReadsFilesOnce) {
    const Vec3 p = ball_.vertex(5);
    const ObjModel plain{{},
                         Faces::Constant(ball_.face_count(), 3, -1),
                         std::vector<int>(std::size_t(ball_.face_count()), -1),
                         {},
                         {}};
    TransferRequest request;
    request.points = {
        write_once("a.fcsv", fmt::format("\"id,7\",{},{},{},0,0,0,1,1,1,0,ear,,\n", p[0], p[1], p[2])),
        write_once("a.pp", fmt::format("<point x=\"{}\" y=\"{}\" z=\"{}\"/>", p[0], p[1], p[2]))};
    request.mesh = write_once("a.obj", obj_of(ball_, plain));
    const auto files = carry(request, identity_onto(ball_));
    EXPECT_THAT(files.at("a.fcsv"),
                testing::AllOf(StartsWith("\"id,7\","), HasSubstr(",0,0,0,1,1,1,0,ear,,\n")));
    EXPECT_EQ(parse_picked_points(files.at("a.pp"), "a.pp").size(), 1u);
    EXPECT_EQ(parse_mesh(files.at("source_on_target.obj"), "a.obj").faces, ball_.faces);
}

TEST_F(Transfer, RefusesWhatWouldHaveNoEffect) {
    TransferRequest request;
    request.regions = {write("r.txt", "3\n")};
    request.bake = {16, 1};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("give --texture"));
    request.bake = {0};
    request.onto = "b.obj";
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("--onto says what to bake onto"));
    request.onto.clear();
    request.bake = {0, 8};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("--padding is that of what is baked"));
    request.bake = {0};
    request.influences = 4;
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("how many of --weights are kept"));
    request.influences = 0;
    request.reading.space = LandmarkSpace::lps;
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("which axes --points have"));
    request.reading.space = LandmarkSpace::stated;
    EXPECT_EQ(carry(request, identity_onto(ball_)).size(), 1u);
}

TEST_F(Transfer, ReadsMapsInBothDirections) {
    const std::string a = write("a.ply", to_ply(ball_)), b = write("b.ply", to_ply(shapes::ellipsoid(1)));
    const TriangleMesh small = shapes::ellipsoid(1);
    const std::string there = write("there.csv", to_csv(closest_points(ball_.vertices, small)));
    const std::string back = write("back.csv", to_csv(closest_points(small.vertices, ball_)));
    const Correspondence reversed = read_correspondence({a, b, there, back}, true);
    EXPECT_EQ(reversed.from.vertex_count(), small.vertex_count());
    EXPECT_EQ(int(reversed.there.size()), small.vertex_count());
    EXPECT_THROW(read_correspondence({b, a, there, back}, false), InputError);
}

}  // namespace
}  // namespace varimap
