#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "fixtures/shapes.h"
#include "fixtures/transfer.h"

namespace varimap {
namespace {

using namespace transfers;
using ::testing::HasSubstr;

TEST_F(Transfer, CarriesPointsOfTheIdentityOntoThemselves) {
    const Vec3 p = position(ball_, {7, {.2, .3, .5}});
    TransferRequest request;
    request.points = {write("p.txt", fmt::format("{} {} {}\n", p[0], p[1], p[2]))};
    const auto files = carry(request, identity_onto(ball_));
    std::istringstream text(files.at("p.txt"));
    Vec3 found;
    text >> found[0] >> found[1] >> found[2];
    EXPECT_LT((found - p).norm(), 1e-12);
}

TEST_F(Transfer, CarriesPointsToAMovedCopyExactly) {
    const Correspondence map = moved_copy(ball_);
    const SurfacePoint at{11, {.1, .6, .3}};
    const PointCarrier there(map.from, map.there, map.to);
    TriangleMesh moved = shapes::moved(ball_, 3, 1.2, {1, -2, 3});
    EXPECT_LT((position(map.to, there(at)) - position(moved, at)).norm(), 1e-9);
}

TEST_F(Transfer, CarriesPointsOntoAnotherTessellationInAnotherPose) {
    const PosedPair pair;
    const PointCarrier there(pair.map.from, pair.map.there, pair.map.to);
    double sum = 0, worst = 0;
    for (int f = 0; f < pair.rest.face_count(); f += 3) {
        const SurfacePoint at{f, {.2, .5, .3}};
        const Vec3 truth = pair.pose.forward(position(pair.rest, at));
        const double error = (position(pair.map.to, there(at)) - truth).norm() / pair.unit();
        sum += 3 * error, worst = std::max(worst, error);
    }
    EXPECT_LT(sum / pair.rest.face_count(), 1.5e-3);
    EXPECT_LT(worst, half_edge / pair.unit());
    RecordProperty("mean", std::to_string(sum / pair.rest.face_count()));
}

TEST_F(Transfer, KeepsWhatPointFilesSayBesidesPositions) {
    const Correspondence map = identity_onto(ball_);
    const Vec3 p = ball_.vertex(5);
    TransferRequest request;
    request.points = {
        write("a.mrk.json",
              fmt::format(R"({{"@schema": "s", "markups": [{{"type": "Fiducial", "coordinateSystem": "RAS",
            "controlPoints": [{{"id": "1", "label": "nose", "position": [{}, {}, {}], "locked": true}},
            {{"id": "2", "label": "lost", "positionStatus": "undefined", "position": []}}]}}]}})",
                          -p[0], -p[1], p[2])),
        write("a.fcsv",
              fmt::format("# CoordinateSystem = LPS\nid7,{},{},{},0,0,0,1,1,1,0,ear,,\n", p[0], p[1], p[2])),
        write("a.pp", fmt::format("<PickedPoints>\n <point x=\"{}\" y=\"{}\" z=\"{}\" name=\"tip\" "
                                  "active=\"1\"/>\n</PickedPoints>\n",
                                  p[0], p[1], p[2])),
        write("a.pts",
              fmt::format("Version 1.0\n2\nS000 {} {} {}\r\nS001 9999 9999 9999\n", p[0], p[1], p[2])),
        write("a.csv", fmt::format("name;x;y;z\ntail;{};{};{}\n", p[0], p[1], p[2]))};
    const auto files = carry(request, map);
    for (const std::string name : {"a.mrk.json", "a.fcsv", "a.pp", "a.pts"}) {
        const auto before = read_picked_points(folder_ / name);
        const auto after = read_picked_points(write("after-" + name, files.at(name)));
        ASSERT_EQ(after.size(), before.size());
        EXPECT_EQ(after[0].name, before[0].name);
        EXPECT_EQ(after[0].space, before[0].space);
        EXPECT_LT((after[0].position - before[0].position).norm(), 1e-12) << name;
    }
    EXPECT_THAT(files.at("a.mrk.json"), HasSubstr("\"locked\": true"));
    EXPECT_FALSE(read_picked_points(folder_ / "after-a.mrk.json")[1].defined);
    EXPECT_THAT(files.at("a.pts"), HasSubstr("\r\nS001 9999 9999 9999\n"));
    EXPECT_THAT(files.at("a.csv"), HasSubstr("name;x;y;z\ntail;"));
}

TEST_F(Transfer, HonoursTheAxesOfBothMeshes) {
    Correspondence map = identity_onto(ball_);
    map.to.space = Space::ras;
    const Vec3 p = ball_.vertex(5);
    TransferRequest request;
    request.points = {
        write("a.fcsv",
              fmt::format("# CoordinateSystem = LPS\n1,{},{},{},0,0,0,1,1,1,0,ear,,\n", p[0], p[1], p[2]))};
    const auto after = read_picked_points(write("b.fcsv", carry(request, map).at("a.fcsv")));
    EXPECT_LT((after[0].position - Vec3(-p[0], -p[1], p[2])).norm(), 1e-12);
}

TEST_F(Transfer, SaysWhichPointsStayAsTheyAre) {
    const Vec3 p = ball_.vertex(5);
    TransferRequest request;
    request.points = {
        write("a.pp", fmt::format("<point x=\"{}\" y=\"{}\" z=\"{}\" active=\"1\" name=\"a\"/>\n"
                                  "<point x=\"7\" y=\"8\" z=\"9\" active=\"0\" name=\"b\"/>\n",
                                  p[0], p[1], p[2]))};
    EXPECT_THAT(warnings_of(request, identity_onto(ball_)),
                HasSubstr("1 of 2 points are missing, not defined, or switched off"));
}

TEST_F(Transfer, MissingPointsStayAsTheyAre) {
    const Vec3 p = ball_.vertex(5);
    const std::string point = fmt::format("{},{},{}", p[0], p[1], p[2]);
    TransferRequest request;
    for (const std::string& text : std::vector<std::string>{
             "name,x,y,z\nnose,NA,NA,NA\near," + point + "\n", "nose,,,\near," + point + "\n",
             "NA,nan,?\n" + point + "\n", "nose,NA\ntail,7\n", "5\nNA\n"}) {
        request.points = {write("a.csv", text)};
        const std::string carried = carry(request, identity_onto(ball_)).at("a.csv");
        std::istringstream before(text), after(carried);
        for (std::string was, is; std::getline(before, was);) {
            ASSERT_TRUE(std::getline(after, is)) << text;
            EXPECT_EQ(std::count(is.begin(), is.end(), ','), std::count(was.begin(), was.end(), ','));
            EXPECT_TRUE(is == was || was.find(point) != std::string::npos) << is;
        }
        EXPECT_THAT(warnings_of(request, identity_onto(ball_)), HasSubstr("1 of 2 points are missing"));
    }
    request.points = {write("a.csv", "x,y,z\nNA,NA,NA\n")};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("a.csv: all of its points are missing"));
    request.points = {write("a.csv", "x,y,z\nNA,NA,1\n" + point + "\n")};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("a.csv:2: 'NA' is not a coordinate"));
}

TEST_F(Transfer, FindsThePlacesOfPointsHoweverTheirXmlIsWritten) {
    const auto text = [](const Vec3& p) {
        return fmt::format(
            "<!-- <point x=\"9\" y=\"9\" z=\"9\"/> -->\n"
            "<point\n y = '{}' x='{}'\tz=\"{}\" name='x=\"1\"'/>\n",
            p[1], p[0], p[2]);
    };
    Correspondence map = identity_onto(ball_);
    map.to.vertices *= 2;
    TransferRequest request;
    request.points = {write("a.pp", text(ball_.vertex(5)))};
    EXPECT_EQ(carry(request, map).at("a.pp"), text(2 * ball_.vertex(5)));
}

TEST_F(Transfer, ListsOfVerticesAndFacesMayHaveAName) {
    TransferRequest request;
    request.points = {write("v.csv", "vertex\n5\n7\n")};
    request.regions = {write("r.txt", "# region\nFace\n3\n17\n")};
    const auto files = carry(request, identity_onto(ball_));
    EXPECT_EQ(files.at("v.csv"), "vertex\n5\n7\n");
    EXPECT_EQ(files.at("r.txt"), "Face\n3\n17\n");
    request.regions = {write("r.txt", "nose\n3\n")};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("r.txt:1: 'nose' is not one of"));
}

TEST_F(Transfer, RefusesPointsOfAnotherMesh) {
    TransferRequest request;
    request.points = {write("p.txt", "100 0 0\n0 100 0\n")};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("2 of 2 points lie farther than 0.02"));
    request.points = {write("n.csv", "vertex,x,y,z\n5,0,0,1\n")};
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("n.csv:1: the numbers of the column 'vertex'"));
    request.points = {write("v.txt", "3\n162\n")};
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("v.txt:2: '162' is not one of the mesh's 162"));
}

TEST_F(Transfer, VerticesMayHaveNames) {
    TransferRequest request;
    for (const std::string text : {"nose,5\ntail,7\n", "name,vertex\nnose,5\n2,7\n",
                                   "# tips\nVertex;name\n5;\"nose; left\"\n\n7;tail\n", "5 nose\n7 tail\n"}) {
        request.points = {write("v.csv", text)};
        EXPECT_EQ(carry(request, identity_onto(ball_)).at("v.csv"), text);
    }
    request.points = {write("v.csv", "name,vertex\nnose,5\ntail,162\n")};
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("v.csv:3: '162' is not one of the mesh's 162"));
    request.points = {write("v.csv", "nose,5\ntail\n")};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("v.csv:2: '' is not one of the mesh's"));
}

TEST_F(Transfer, NormalsOfPointsAreLeftOut) {
    const Vec3 p = ball_.vertex(5);
    TransferRequest request;
    request.points = {write(
        "a.csv", fmt::format("name,x,y,z,nx,ny,nz,note\ntail,{},{},{},0,0,1,left\n", p[0], p[1], p[2]))};
    EXPECT_THAT(carry(request, identity_onto(ball_)).at("a.csv"),
                testing::MatchesRegex("name,x,y,z,note\ntail(,[-.0-9e]+){3},left\n"));
    EXPECT_THAT(warnings_of(request, identity_onto(ball_)),
                HasSubstr("a.csv: its normals are those of this"));
}

/// In lines that blanks split, where they may be landmarks' names.
TEST_F(Transfer, CommentsBehindPointsStay) {
    const Vec3 p = ball_.vertex(7);
    TransferRequest request;
    request.points = {write("p.txt", fmt::format("{} {} {}   # nose\n", p[0], p[1], p[2])),
                      write("v.txt", "vertex # of tips\n7 # ear\n8\n"), write("w.txt", "7 # ear, left\n8\n")};
    auto carried = carry(request, identity_onto(ball_));
    EXPECT_THAT(carried.at("p.txt"), testing::EndsWith(" # nose\n"));
    EXPECT_EQ(carried.at("v.txt"), "vertex # of tips\n7 # ear\n8\n");
    EXPECT_EQ(carried.at("w.txt"), "7 # ear, left\n8\n");
}

TEST_F(Transfer, CarriesColumnsOfParaView) {
    const Vec3 p = ball_.vertex(5);
    TransferRequest request;
    request.points = {write(
        "a.csv",
        fmt::format("\"heat\",\"Points:0\",\"Points:1\",\"Points:2\"\n7,{},{},{}\n", p[0], p[1], p[2]))};
    EXPECT_THAT(carry(request, identity_onto(ball_)).at("a.csv"), HasSubstr("\n7,"));
}

TEST_F(Transfer, LinesBetweenPointsStay) {
    const std::string text = "# curve 1\n1\n2\n\n# curve 2\n3\n# end\n";
    TransferRequest request;
    request.points = {write("a.txt", text)};
    EXPECT_EQ(carry(request, identity_onto(ball_)).at("a.txt"), text);
    request.points = {write("a.obj", "v 1 0 0\nl 1 2 3\n")};
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("a.obj: is a mesh; give its points as lines"));
}

}  // namespace
}  // namespace varimap
