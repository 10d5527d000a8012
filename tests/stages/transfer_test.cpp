#include "stages/transfer/transfer.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fixtures/temporary_folder.h"
#include "stages/transfer/image.h"
#include "stages/transfer/seams.h"
#include "stages/transfer/shape.h"
#include "stages/transfer/values.h"
#include "varimap/artifact/npy.h"
#include "varimap/core/error.h"
#include "varimap/core/warnings.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_files/ply_columns.h"
#include "varimap/results/map_table.h"

namespace varimap {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

PointMap closest_points(const Points& positions, const TriangleMesh& mesh) {
    const ClosestPoint closest(mesh);
    PointMap map;
    for (const auto position : positions.rowwise()) map.push_back(closest(Vec3(position.transpose())).point);
    return map;
}

Correspondence identity_onto(const TriangleMesh& mesh) {
    return {"a.obj", "b.obj", mesh, mesh, shapes::at_vertices(mesh), shapes::at_vertices(mesh)};
}

/// A copy, scaled, turned and with its vertices and faces in another order, and its true map.
Correspondence moved_copy(const TriangleMesh& mesh) {
    const TriangleMesh copy = shapes::shuffled(shapes::moved(mesh, 3, 1.2, {1, -2, 3}), 7);
    const Points in_place = shapes::moved(mesh, 3, 1.2, {1, -2, 3}).vertices;
    std::vector<int> old_vertex;
    shapes::shuffled(mesh, 7, &old_vertex);
    Correspondence map{"a.obj", "b.obj", mesh, copy, closest_points(in_place, copy), {}};
    const PointMap at = shapes::at_vertices(mesh);
    for (const int v : old_vertex) map.back.push_back(at[std::size_t(v)]);
    return map;
}

/// The figure and another tessellation of it in another pose; its true map, up to the tessellations.
struct PosedPair {
    shapes::Pose pose = shapes::figure_pose(1);
    TriangleMesh rest = shapes::figure(.15), other = shapes::figure(.15, .5);
    Correspondence map{"a.obj",
                       "b.obj",
                       rest,
                       pose(other),
                       closest_points(posed(rest.vertices), pose(other)),
                       closest_points(other.vertices, rest)};

    Points posed(const Points& points) const {
        Points moved = points;
        for (auto point : moved.rowwise()) point = pose.forward(point.transpose()).transpose();
        return moved;
    }
    double unit() const { return std::sqrt(surface_area(map.to)); }
};

/// Of the grid that meshes the figure: what two tessellations may differ by at sharp tips.
constexpr double half_edge = .15 / 2;

/// Largest y^2 + z^2, the squared gradient of y z.
double truth_radius(const TriangleMesh& mesh) {
    return mesh.vertices.rightCols<2>().rowwise().squaredNorm().maxCoeff();
}

/// Texture coordinates by angle and height about the z axis: one patch with a seam behind it, and the poles.
ObjModel unwrapped(const TriangleMesh& mesh) {
    ObjModel model;
    model.uv_of.resize(mesh.face_count(), 3);
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Vec3 centre = position(mesh, {f, Vec3::Constant(1 / 3.)});
        const double middle = std::atan2(centre[1], centre[0]);
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = mesh.vertex(mesh.faces(f, k));
            const double turn = std::remainder(std::atan2(p[1], p[0]) - middle, 2 * M_PI);
            model.uv_of(f, k) = int(model.uv.size());
            model.uv.emplace_back((middle + turn) / (2 * M_PI) + .5, p[2] / 4 + .5);
        }
    }
    model.material.assign(std::size_t(mesh.face_count()), 0);
    model.materials = {"skin"};
    return model;
}

std::string obj_of(const TriangleMesh& mesh, const ObjModel& model, const std::string& library = "") {
    return to_obj({mesh, model}, library);
}

class Transfer : public ::testing::Test {
  protected:
    std::string write(const std::string& name, const std::string& bytes) {
        write_file_atomically(folder_ / name, bytes);
        return folder_ / name;
    }
    /// A file that can be read only once, as one that changes right after.
    std::string write_once(const std::string& name, const std::string& bytes) {
        int ends[2];
        EXPECT_EQ(::pipe(ends), 0);
        EXPECT_EQ(::write(ends[1], bytes.data(), bytes.size()), ssize_t(bytes.size()));
        ::close(ends[1]);
        pipes_.push_back(ends[0]);
        std::filesystem::create_symlink(fmt::format("/proc/self/fd/{}", ends[0]), folder_ / name);
        return folder_ / name;
    }
    void TearDown() override {
        for (const int pipe : pipes_) ::close(pipe);
    }
    std::map<std::string, std::string> carry(const TransferRequest& request, const Correspondence& map) {
        const NamedFiles files = transfer(request, map, false);
        return {files.begin(), files.end()};
    }
    std::string refusal(const TransferRequest& request, const Correspondence& map) {
        try {
            transfer(request, map, false);
        } catch (const Error& error) {
            return error.what();
        }
        return "none";
    }
    /// What the program warned of meanwhile, a line each.
    std::string warnings_of(const TransferRequest& request, const Correspondence& map) {
        const std::size_t before = logged_warnings().size();
        transfer(request, map, false);
        std::string lines;
        for (std::size_t i = before; i < logged_warnings().size(); ++i) lines += logged_warnings()[i] + "\n";
        return lines;
    }
    /// A line for each vertex of the ball: `even`, `odd`, `even`, ...
    std::string by_turns(const std::string& even, const std::string& odd) const {
        std::string text;
        for (int v = 0; v < ball_.vertex_count(); ++v) text += (v % 2 == 0 ? even : odd) + "\n";
        return text;
    }
    /// What becomes of a file of labels that the identity carries.
    std::string kept_labels(const std::string& name, const std::string& bytes) {
        TransferRequest request;
        request.labels = {write(name, bytes)};
        return carry(request, identity_onto(ball_)).at(name);
    }
    std::vector<int> pipes_;
    TemporaryFolder folder_;
    const TriangleMesh ball_ = shapes::ellipsoid(2, {1, .8, 1.3});
};

TEST(SampleImage, MixesNoColourOfWhatCannotBeSeen) {
    TextureImage image;
    image.width = 2, image.height = 1;
    image.rgba = {255, 0, 0, 255, 0, 0, 255, 0};
    EXPECT_TRUE(sample_image(image, {.5, .5}).isApprox(Rgba(255, 0, 0, 127.5)));
    image.rgba = {200, 0, 0, 255, 0, 100, 0, 255};
    EXPECT_TRUE(sample_image(image, {.5, .5}).isApprox(Rgba(100, 50, 0, 255)));
    image.rgba = {200, 0, 0, 0, 0, 100, 0, 0};  // an image whose opacity means something else
    EXPECT_TRUE(sample_image(image, {.5, .5}).isApprox(Rgba(100, 50, 0, 0)));
}

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
        write("a.csv", fmt::format("name;x;y;z\ntail;{};{};{}\n", p[0], p[1], p[2]))};
    const auto files = carry(request, map);
    for (const std::string name : {"a.mrk.json", "a.fcsv", "a.pp"}) {
        const auto before = read_picked_points(folder_ / name);
        const auto after = read_picked_points(write("after-" + name, files.at(name)));
        ASSERT_EQ(after.size(), before.size());
        EXPECT_EQ(after[0].name, before[0].name);
        EXPECT_EQ(after[0].space, before[0].space);
        EXPECT_LT((after[0].position - before[0].position).norm(), 1e-12) << name;
    }
    EXPECT_THAT(files.at("a.mrk.json"), HasSubstr("\"locked\": true"));
    EXPECT_FALSE(read_picked_points(folder_ / "after-a.mrk.json")[1].defined);
    EXPECT_THAT(files.at("a.csv"), HasSubstr("name;x;y;z\ntail;"));
}

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

/// Vertices that no face uses make them as many as the faces.
TEST_F(Transfer, AColumnCalledFaceNumbersFaces) {
    TriangleMesh mesh = ball_;
    mesh.vertices.conservativeResize(mesh.face_count(), 3);
    mesh.vertices.bottomRows(mesh.face_count() - ball_.vertex_count()).setZero();
    std::string rows;
    for (int f = 0; f < mesh.face_count(); ++f) rows += fmt::format("{},{}\n", f, .5 * f);
    const auto place_in = [&](const std::string& name) {
        return read_values(write(name + ".csv", name + ",value\n" + rows), ValueKind::number, mesh, "a.obj")
            .tables[0]
            .place;
    };
    EXPECT_EQ(place_in("face"), Place::face);
    EXPECT_EQ(place_in("vertex"), Place::vertex);
    const std::size_t before = logged_warnings().size();
    EXPECT_EQ(place_in("index"), Place::vertex);
    EXPECT_EQ(logged_warnings().size(), before + 1);

    const PlyColumn column{"heat", "double", std::vector<double>(std::size_t(mesh.face_count()), 1.5)};
    const std::string ply = to_ply(mesh, PlyColumns{{}, {column}, {}}, PlyFormat::ascii);
    EXPECT_EQ(read_values(write("a.ply", ply), ValueKind::number, mesh, "a.obj").tables[0].place,
              Place::face);
}

TEST_F(Transfer, TheNameOfOneColumnMayBeSeveralWords) {
    std::string text = "bone density\n";
    for (int v = 0; v < ball_.vertex_count(); ++v) text += fmt::format("{}\n", .5 * v);
    const ValueFile file = read_values(write("a.csv", text), ValueKind::number, ball_, "a.obj");
    EXPECT_EQ(file.tables[0].values.rows(), ball_.vertex_count());
    EXPECT_THAT(file.write(file.tables, ball_), StartsWith("\"bone density\"\n0\n0.5\n"));
    EXPECT_THROW(read_values(write("b.csv", "1 2\n" + text.substr(text.find('\n') + 1)), ValueKind::number,
                             ball_, "a.obj"),
                 InputError);
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
                HasSubstr("1 of 2 points are not defined, or switched off"));
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

TEST_F(Transfer, InterpolatesASmoothFunctionOntoAnotherTessellation) {
    const PosedPair pair;
    const auto wave = [](const Points& p) {
        return Eigen::VectorXd((2 * p.col(0).array()).sin() + p.col(1).array() * p.col(2).array());
    };
    const PointCarrier back(pair.map.to, pair.map.back, pair.map.from);
    const ValueTable table{Place::vertex, wave(pair.rest.vertices)};
    const ValueTable carried = carry_values(table, ValueKind::number, pair.map, back);
    const Eigen::VectorXd truth = wave(pair.other.vertices);
    const double extent = truth.maxCoeff() - truth.minCoeff();
    const Eigen::VectorXd error = (carried.values.col(0) - truth).cwiseAbs() / extent;
    EXPECT_LT(error.mean(), 2e-3);
    const double steepest = std::sqrt(4 + truth_radius(pair.rest));
    EXPECT_LT(error.maxCoeff(), half_edge * steepest / extent);
    RecordProperty("mean", std::to_string(error.mean()));
}

TEST_F(Transfer, KeepsValuesOfTheIdentity) {
    const Correspondence map = identity_onto(ball_);
    const PointCarrier back(map.to, map.back, map.from);
    const ValueTable vertices{Place::vertex, Eigen::MatrixXd::Random(ball_.vertex_count(), 3)};
    const ValueTable faces{Place::face, Eigen::MatrixXd::Random(ball_.face_count(), 2)};
    for (const ValueKind kind : {ValueKind::number, ValueKind::label}) {
        EXPECT_TRUE(carry_values(vertices, kind, map, back).values.isApprox(vertices.values, 1e-14));
        EXPECT_TRUE(carry_values(faces, kind, map, back).values.isApprox(faces.values, 1e-14));
    }
}

TEST_F(Transfer, LabelsAreNeverMixedAndKeepTheirWords) {
    const PosedPair pair;
    std::string csv = "vertex,part\n";
    for (int v = 0; v < pair.rest.vertex_count(); ++v)
        csv += fmt::format("{},{}\n", v, pair.rest.vertices(v, 0) > 0 ? "front" : "back");
    TransferRequest request;
    request.labels = {write("parts.csv", csv)};
    std::istringstream lines(carry(request, pair.map).at("parts.csv"));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "vertex,part");
    int seen = 0;
    for (; std::getline(lines, line); ++seen) {
        const bool front = line.ends_with(",front");
        ASSERT_TRUE(front || line.ends_with(",back")) << line;
        // The border runs along edges of the source.
        const double x = pair.other.vertices(seen, 0);
        if (std::abs(x) > 2 * half_edge) {
            EXPECT_EQ(front, x > 0) << seen;
        }
    }
    EXPECT_EQ(seen, pair.other.vertex_count());
}

/// The ball onto itself, where face 0 of either has another point of it as its first corner's image.
Correspondence onto_middle(const TriangleMesh& ball, const Vec3& barycentric) {
    Correspondence map = identity_onto(ball);
    map.back[std::size_t(ball.faces(0, 0))] = {0, barycentric};
    return map;
}

/// They would spread to all vertices whose image lies on a face beside them.
TEST_F(Transfer, MissingValuesCountWhereTheyHaveMostOfAShare) {
    const int row = ball_.faces(0, 0), second = ball_.faces(0, 1);
    const auto carried = [&](const Vec3& barycentric) {
        std::string text;
        for (int v = 0; v < ball_.vertex_count(); ++v)
            text += v == second ? "nan\n" : v == row ? "2\n" : "4\n";
        TransferRequest request;
        request.values = {write("a.txt", text)};
        std::istringstream lines(carry(request, onto_middle(ball_, barycentric)).at("a.txt"));
        std::string line;
        for (int i = 0; i <= row; ++i) std::getline(lines, line);
        return line;
    };
    EXPECT_EQ(carried({.25, .5, .25}), "nan");
    EXPECT_EQ(carried({.375, .25, .375}), "3");
}

TEST_F(Transfer, EveryColumnOfLabelsIsElectedByItself) {
    const Correspondence map = onto_middle(ball_, {.3, .3, .4});
    const int row = ball_.faces(0, 0), last = ball_.faces(0, 2);
    std::string csv = "bone,id\n";
    std::vector<std::int64_t> pairs;
    const std::int64_t large = std::int64_t(1) << 53;
    for (int v = 0; v < ball_.vertex_count(); ++v) {
        const int bone = v == last ? 9 : 7;
        csv += fmt::format("b{},{}\n", bone, v);
        pairs.insert(pairs.end(), {large + bone, large + v});
    }
    TransferRequest request;
    request.labels = {write("a.csv", csv), write("a.npy", to_npy("<i8", {162, 2}, pairs))};
    const auto files = carry(request, map);
    std::istringstream lines(files.at("a.csv"));
    std::string line;
    for (int i = 0; i < row + 2; ++i) std::getline(lines, line);
    EXPECT_EQ(line, fmt::format("b7,{}", last));
    std::int64_t found[2];
    const std::string& npy = files.at("a.npy");
    std::memcpy(found, npy.data() + npy.size() - 162 * 16 + 16 * std::size_t(row), 16);
    EXPECT_THAT(found, ElementsAre(large + 7, large + last));
}

TEST_F(Transfer, AColourIsOneLabel) {
    const Correspondence map = onto_middle(ball_, {.3, .3, .4});
    PlyColumns columns;
    for (const char* name : {"red", "green", "blue", "part"})
        columns.vertex.push_back({name, "uchar", std::vector<double>(162, 0)});
    for (int k = 0; k < 3; ++k) columns.vertex[std::size_t(k)].values[std::size_t(ball_.faces(0, k))] = 255;
    columns.vertex[3].values[std::size_t(ball_.faces(0, 2))] = 1;
    TransferRequest request;
    request.labels = {write("a.ply", to_ply(ball_, columns, PlyFormat::binary))};
    const auto carried = parse_ply_columns(carry(request, map).at("a.ply"), "a.ply").vertex;
    std::vector<double> label;
    for (const PlyColumn& column : carried)
        if (column.type == "uchar") label.push_back(column.values[std::size_t(ball_.faces(0, 0))]);
    EXPECT_THAT(label, ElementsAre(0, 0, 255, 0));
}

TEST_F(Transfer, WordsOfLabelsStayAsTheyAre) {
    for (const auto& [even, odd] :
         {std::pair("seg#1", "seg#2"), std::pair("left arm", "head"), std::pair("\"arm, left\"", "head"),
          std::pair("\"#1\"", "\"\""), std::pair("a,", "b,\"c \"\"d\"\"\"")}) {
        const std::string csv = by_turns(even, odd);
        EXPECT_EQ(kept_labels("a.csv", csv), csv);
    }
    EXPECT_EQ(kept_labels("a.txt", "# parts\n" + by_turns("seg#1", "seg#2")), by_turns("seg#1", "seg#2"));
}

TEST_F(Transfer, TheNumberOfRowsTellsWhetherTheFirstNamesColumns) {
    const std::string words = by_turns("face", "leg");
    EXPECT_EQ(kept_labels("a.csv", words), words);
    EXPECT_EQ(kept_labels("a.csv", "label\n" + words), "label\n" + words);
    const std::string mixed = by_turns("unknown", "7");
    EXPECT_EQ(kept_labels("a.csv", mixed), mixed);
    EXPECT_EQ(kept_labels("a.csv", "label\n" + mixed), "label\n" + mixed);
    TransferRequest request;
    request.labels = {write("a.csv", "5\n" + by_turns("7", "8"))};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("a.csv: 163 rows, but"));
    request = {};
    request.values = {write("a.csv", "NA\n" + by_turns("7", "8").substr(2))};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("a.csv:1: 'NA' is not a number"));
}

TEST_F(Transfer, TheFirstRowTellsWhereTheNumberOfRowsDoesNot) {
    // Four vertices and five faces.
    TriangleMesh mesh = shapes::square(1);
    mesh.faces = (Faces(5, 3) << 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2).finished();
    const auto rows = [&](const std::string& text) {
        return read_values(write("a.csv", text), ValueKind::label, mesh, "a.obj").tables[0].values.rows();
    };
    EXPECT_EQ(rows("part\n1\n2\n3\n4\n"), 4);
    EXPECT_EQ(rows("vertex,part\n0,a\n1,b\n2,a\n3,b\n"), 4);
    EXPECT_EQ(rows("arm\nleg\narm\nleg\narm\n"), 5);
}

TEST_F(Transfer, LabelsOfAnyIntegerStayExact) {
    const std::int64_t large = (std::int64_t(1) << 53) + 1;
    std::vector<std::int64_t> ids;
    std::vector<std::uint64_t> unsigned_ids;
    for (int v = 0; v < ball_.vertex_count(); ++v) {
        ids.push_back(v % 2 == 0 ? large : -large - v % 3);
        unsigned_ids.push_back(~std::uint64_t(v));
    }
    std::string npy = to_npy("<i8", {162}, ids);
    EXPECT_EQ(kept_labels("a.npy", npy), npy);
    npy = to_npy("<u8", {162, 1}, unsigned_ids);
    EXPECT_EQ(kept_labels("a.npy", npy), npy);
    const std::string by_columns =
        npy_header("<i8", {162, 2}, true) + npy.substr(npy.size() - 162 * 8) + std::string(162 * 8, '\x7f');
    const std::string kept = kept_labels("a.npy", by_columns);
    const std::string header = npy_header("<i8", {162, 2});
    ASSERT_EQ(kept.size(), header.size() + 162 * 16);
    for (std::size_t v = 0; v < 162; ++v) {
        std::uint64_t row[2];
        std::memcpy(row, kept.data() + header.size() + 16 * v, 16);
        EXPECT_EQ(row[0], ~std::uint64_t(v));
        EXPECT_EQ(row[1], 0x7f7f7f7f7f7f7f7fu);
    }
}

TEST_F(Transfer, ANameAboveTooFewRowsIsNoValue) {
    std::string rows = "vertex,bone,other\n", labels = "vertex,part\n";
    for (int v = 0; v < 161; ++v) {
        rows += fmt::format("{},0.5,0.5\n", v);
        labels += fmt::format("{},arm\n", v);
    }
    TransferRequest request;
    request.weights = {write("a.csv", rows)};
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("a.csv: 161 rows, but a.obj has 162 vertices"));
    request = {};
    request.labels = {write("a.csv", labels)};
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("a.csv: 161 rows, but a.obj has 162 vertices"));
}

TEST_F(Transfer, SaysThatListsAreNotCarried) {
    const std::string bare =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float heat\nproperty list uchar float bones\nelement face 1\n"
        "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
        "0 0 0 1 0\n1 0 0 2 0\n0 1 0 3 1 .5\n3 0 1 2 0\n";
    TransferRequest request;
    request.values = {write("a.ply", bare)};
    EXPECT_THAT(warnings_of(request, identity_onto(parse_mesh(bare, "a.ply"))),
                HasSubstr("a.ply: lists are not carried: bones, texcoord"));
}

TEST_F(Transfer, PolygonsOfAPlyFileHaveValues) {
    // Two polygons, of four and of three corners, are three triangles.
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nproperty int part\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n4 0 1 2 3 7\n3 1 4 2 8\n";
    const TriangleMesh mesh = parse_mesh(ply, "a.ply");
    ASSERT_EQ(mesh.face_count(), 3);
    const ValueFile file = read_values(write("a.ply", ply), ValueKind::label, mesh, "a.ply");
    ASSERT_EQ(file.tables.size(), 1u);
    EXPECT_EQ(file.tables[0].place, Place::face);
    EXPECT_EQ(file.tables[0].values, Eigen::Vector3d(7, 7, 8));
    const ValueFile written =
        read_values(write("b.ply", file.write(file.tables, mesh)), ValueKind::label, mesh, "a.ply");
    EXPECT_EQ(written.tables[0].values, file.tables[0].values);
}

TEST_F(Transfer, RowsWithoutAnImageHaveNoValue) {
    Correspondence map = identity_onto(ball_);
    map.back[5] = {};
    std::string numbers;
    for (int v = 0; v < ball_.vertex_count(); ++v) numbers += fmt::format("{}\n", v);
    TransferRequest request;
    request.values = {write("a.csv", numbers),
                      write("a.npy", to_npy("<i4", {162}, std::vector<int>(162, 7)))};
    const auto files = carry(request, map);
    EXPECT_THAT(files.at("a.csv"), HasSubstr("\n4\nnan\n6\n"));
    std::vector<int> truth(162, 7);
    truth[5] = 0;
    EXPECT_EQ(files.at("a.npy"), to_npy("<i4", {162}, truth));
    request = {};
    request.labels = {write("a.csv", by_turns("arm", "leg")),
                      write("a.npy", to_npy("<i8", {162}, std::vector<std::int64_t>(162, 7)))};
    const auto labels = carry(request, map);
    EXPECT_THAT(labels.at("a.csv"), HasSubstr("arm\nleg\narm\nnan\narm"));
    EXPECT_EQ(labels.at("a.npy"),
              to_npy("<i8", {162}, std::vector<std::int64_t>(truth.begin(), truth.end())));
    EXPECT_EQ(kept_labels("again.csv", labels.at("a.csv")), labels.at("a.csv"));
    request = {};
    request.points = {write("v.txt", "5\n")};
    map.there[5] = {};
    EXPECT_THAT(refusal(request, map), HasSubstr("v.txt: without an image on the other mesh: vertex 5;"));
}

TEST_F(Transfer, NamesAllThatHasNoImage) {
    Correspondence map = identity_onto(ball_);
    for (const int v : {5, 7, 9}) map.there[std::size_t(v)] = {};
    TransferRequest request;
    request.points = {write("v.txt", "5\n6\n9\n")};
    EXPECT_THAT(refusal(request, map), HasSubstr("vertices 5, 9; leave out"));
    const auto at = [&](int v) {
        const Vec3 p = ball_.vertex(v);
        return fmt::format("{} {} {}\n", p[0], p[1], p[2]);
    };
    request.points = {write("p.txt", at(6) + at(7) + at(9))};
    EXPECT_THAT(refusal(request, map), HasSubstr("points (from 1) 2, 3; leave out"));
    std::string all;
    for (int v = 0; v < ball_.vertex_count(); ++v) {
        map.there[std::size_t(v)] = {};
        all += fmt::format("{}\n", v);
    }
    request.points = {write("all.txt", all)};
    EXPECT_THAT(refusal(request, map), HasSubstr("10, 11 and 150 more; leave out"));
}

TEST_F(Transfer, ARegionThatVanishesIsSaid) {
    Correspondence map = identity_onto(ball_);
    TransferRequest request;
    request.regions = {write("r.txt", "face\n3\n4\n")};
    EXPECT_EQ(carry(request, map).at("r.txt"), "face\n3\n4\n");
    for (SurfacePoint& point : map.back) point = {0, Vec3(1, 0, 0)};
    EXPECT_THAT(warnings_of(request, map),
                HasSubstr("r.txt: no face of the other mesh has its centroid on this region"));
    EXPECT_EQ(carry(request, map).at("r.txt"), "face\n");
}

TEST_F(Transfer, WeightsStaySumsOfOne) {
    const PosedPair pair;
    Eigen::MatrixXd weights = Eigen::MatrixXd::Random(pair.rest.vertex_count(), 6).cwiseAbs();
    for (auto row : weights.rowwise()) row /= row.sum();
    const PointCarrier back(pair.map.to, pair.map.back, pair.map.from);
    ValueTable carried = carry_values({Place::vertex, weights}, ValueKind::weight, pair.map, back);
    EXPECT_LT((carried.values.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-15 * 8);
    keep_largest(carried.values, 4);
    EXPECT_LT((carried.values.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-15 * 8);
    EXPECT_LE((carried.values.array() > 0).rowwise().count().maxCoeff(), 4);
    carried.values.row(7).setConstant(std::numeric_limits<double>::quiet_NaN());
    keep_largest(carried.values, 2);
    EXPECT_TRUE(carried.values.row(7).array().isNaN().all()) << "without an image";
}

TEST_F(Transfer, WeightsAreScaledToSumsOfOneWithAWord) {
    TransferRequest request;
    request.weights = {write("w.txt", by_turns("3 1", "0 0"))};
    EXPECT_THAT(warnings_of(request, identity_onto(ball_)),
                AllOf(HasSubstr("81 rows of weights are scaled"), HasSubstr("81 rows hold no weight")));
    const std::string carried = carry(request, identity_onto(ball_)).at("w.txt");
    EXPECT_TRUE(carried.starts_with("0.75 0.25\n0 0\n")) << carried.substr(0, 40);
}

TEST_F(Transfer, WarnsOfIntegersThatAreRounded) {
    std::vector<std::int64_t> numbers(162, (1ll << 60) + 1);
    TransferRequest request;
    request.values = {write("a.npy", to_npy("<i8", {162}, numbers))};
    EXPECT_THAT(warnings_of(request, identity_onto(ball_)), HasSubstr("beyond 2^53"));
    request.labels.swap(request.values);
    EXPECT_EQ(warnings_of(request, identity_onto(ball_)), "");
}

/// Another program may have written the mesh anew.
TEST_F(Transfer, RefusesPlyValuesOfAMeshInAnotherOrder) {
    const PlyColumns heat{{{"heat", "double", std::vector<double>(162, 1)}}, {}, {}};
    TransferRequest request;
    request.values = {write("a.ply", to_ply(shapes::shuffled(ball_, 7), heat, PlyFormat::binary))};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("but in another order"));
    const TriangleMesh elsewhere = shapes::moved(ball_, 2, .3, {1, 2, 3});
    request.values = {write("a.ply", to_ply(elsewhere, heat, PlyFormat::binary))};
    EXPECT_EQ(warnings_of(request, identity_onto(ball_)), "") << "faces tell the order";
    const TriangleMesh cloud{ball_.vertices, Faces(0, 3)}, other_cloud{elsewhere.vertices, Faces(0, 3)};
    request.values = {write("a.ply", to_ply(cloud, heat, PlyFormat::binary))};
    EXPECT_EQ(warnings_of(request, identity_onto(ball_)), "");
    request.values = {write("a.ply", to_ply(other_cloud, heat, PlyFormat::binary))};
    EXPECT_THAT(warnings_of(request, identity_onto(ball_)), HasSubstr("its vertices lie elsewhere"));
}

/// With one label missing a heading makes up for it.
TEST_F(Transfer, RefusesLabelsOfWhichALineWasPassedOver) {
    std::string rows;
    for (int v = 1; v < ball_.vertex_count(); ++v) rows += fmt::format("{}\n", v % 5);
    TransferRequest request;
    for (const std::string& text : {"part\n" + rows + "\n", "part\n# 7\n" + rows, "\n\npart\n\n" + rows}) {
        request.labels = {write("a.txt", text)};
        EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("'part' may name columns"));
    }
    request.labels = {write("a.txt", "arm\narm\n" + rows.substr(rows.find('\n') + 1) + "\n")};
    EXPECT_EQ(refusal(request, identity_onto(ball_)), "none") << "a label that stands twice is no heading";
    request.labels = {write("a.txt", "# parts\n\npart\n3\n" + rows + "\n")};
    EXPECT_EQ(refusal(request, identity_onto(ball_)), "none");
}

TEST_F(Transfer, WarnsOfLabelsWhoseFirstLooksLikeAHeading) {
    std::string rows;
    for (int v = 1; v < ball_.vertex_count(); ++v) rows += v % 5 == 0 ? "leg\n" : "body\n";
    TransferRequest request;
    request.labels = {write("a.csv", "part\n" + rows)};
    EXPECT_THAT(warnings_of(request, identity_onto(ball_)),
                HasSubstr("'part', which no other row holds, is taken for the first row"));
    for (const std::string& right : {"leg\n" + rows, "part\nleg\n" + rows}) {
        request.labels = {write("a.csv", right)};
        EXPECT_EQ(warnings_of(request, identity_onto(ball_)), "");
    }
}

TEST_F(Transfer, WeightsOfIntegersBecomeFractions) {
    const Correspondence map = onto_middle(ball_, {.25, .25, .5});
    std::vector<std::uint8_t> weights;
    PlyColumns columns;
    for (const char* name : {"bone", "other"}) columns.vertex.push_back({name, "uchar", {}});
    for (int v = 0; v < 162; ++v)
        for (int k = 0; k < 2; ++k) {
            const bool held = (v == ball_.faces(0, 2)) == (k == 1);
            weights.push_back(held);
            columns.vertex[std::size_t(k)].values.push_back(held);
        }
    TransferRequest request;
    request.weights = {write("a.npy", to_npy("|u1", {162, 2}, weights)),
                       write("b.npy", to_npy("|b1", {162, 2}, weights)),
                       write("a.ply", to_ply(ball_, columns, PlyFormat::binary))};
    const auto files = carry(request, map);
    for (const auto& [name, bytes] : files) {
        const ValueFile file = read_values(write("after-" + name, bytes), ValueKind::weight, map.to, "b.obj");
        const Eigen::RowVectorXd row = file.tables[0].values.row(ball_.faces(0, 0));
        EXPECT_TRUE(row.isApprox(Eigen::RowVector2d(.5, .5))) << name << ": " << row;
    }
    EXPECT_THAT(files.at("b.npy"), HasSubstr("<f8"));
}

TEST_F(Transfer, WritesTheFormatItReads) {
    const Correspondence map = identity_onto(ball_);
    const auto round_trip = [&](const std::string& path) {
        const ValueFile file = read_values(path, ValueKind::number, map.from, map.from_file);
        return file.write(file.tables, map.to);
    };
    std::string csv = "index,heat,cold\n";
    for (int v = 0; v < ball_.vertex_count(); ++v) csv += fmt::format("{},{},{}\n", v, .1 * v, -v);
    EXPECT_EQ(round_trip(write("a.csv", csv)), csv);
    std::string plain;
    for (int f = 0; f < ball_.face_count(); ++f) plain += fmt::format("{} {}\n", f, 2 * f);
    EXPECT_EQ(round_trip(write("a.txt", plain)), plain);
    PlyColumns columns;
    columns.vertex.push_back({"red", "uchar", std::vector<double>(std::size_t(ball_.vertex_count()), 200)});
    columns.face.push_back({"part", "int", std::vector<double>(std::size_t(ball_.face_count()), -3)});
    columns.vertex.push_back({"heat", "float", std::vector<double>(std::size_t(ball_.vertex_count()), .1f)});
    for (const PlyFormat format : {PlyFormat::binary, PlyFormat::ascii}) {
        const std::string ply = to_ply(ball_, columns, format);
        EXPECT_EQ(round_trip(write("a.ply", ply)), ply);
    }
    std::string npy = npy_header("<f4", {ball_.vertex_count()});
    for (int v = 0; v < ball_.vertex_count(); ++v) {
        const float value = float(v) / 3;
        npy.append(reinterpret_cast<const char*>(&value), 4);
    }
    EXPECT_EQ(round_trip(write("a.npy", npy)), npy);
    const std::vector<std::int8_t> bytes(2 * std::size_t(ball_.face_count()), -7);
    const std::string table = to_npy("|i1", {ball_.face_count(), 2}, bytes);
    EXPECT_EQ(round_trip(write("b.npy", table)), table);
    EXPECT_EQ(round_trip(write("B.NPY", table)), table);
}

TEST_F(Transfer, ReadsBigEndianArraysAndHalves) {
    const auto reversed = [](std::string npy, std::size_t size) {
        for (std::size_t at = npy.size() - 162 * size; at < npy.size(); at += size)
            std::reverse(npy.begin() + std::ptrdiff_t(at), npy.begin() + std::ptrdiff_t(at + size));
        npy[npy.find('<')] = '>';
        return npy;
    };
    std::vector<double> heat;
    std::vector<std::int64_t> ids;
    std::vector<std::uint16_t> halves;
    for (int v = 0; v < 162; ++v) {
        heat.push_back(.1 * v);
        ids.push_back((std::int64_t(1) << 53) + v);
        halves.push_back(std::uint16_t(0x3c00 + v));  // 1 + v / 1024
    }
    const std::string npy = to_npy("<f8", {162}, heat), labels = to_npy("<i8", {162}, ids);
    EXPECT_EQ(kept_labels("a.npy", reversed(npy, 8)), npy);
    EXPECT_EQ(kept_labels("a.npy", reversed(labels, 8)), labels);
    const std::string half = to_npy("<f2", {162}, halves);
    for (const std::string& bytes : {half, reversed(half, 2)}) {
        const ValueFile file = read_values(write("a.npy", bytes), ValueKind::number, ball_, "a.obj");
        EXPECT_EQ(file.tables[0].values(161, 0), 1 + 161 / 1024.);
        const std::string written = file.write(file.tables, ball_);
        EXPECT_THAT(written, HasSubstr("<f4"));
        EXPECT_EQ(read_values(write("b.npy", written), ValueKind::number, ball_, "a.obj").tables[0].values,
                  file.tables[0].values);
    }
}

TEST_F(Transfer, RefusesValuesOfAnotherMesh) {
    const Correspondence map = identity_onto(ball_);
    TransferRequest request;
    request.values = {write("a.csv", "1\n2\n3\n")};
    EXPECT_THAT(refusal(request, map),
                HasSubstr("a.csv: 3 rows, but a.obj has 162 vertices and 320 triangles"));
    request.values = {write("a.csv", "heat,cold\n1,2\n3\n")};
    EXPECT_THAT(refusal(request, map), HasSubstr("a.csv:3: 1 columns, but the first line has 2"));
    request.values = {write("a.csv", "1\nwarm\n")};
    EXPECT_THAT(refusal(request, map), HasSubstr("a.csv:2: 'warm' is not a number; give words as --labels"));
    request.values = {write("a.npy", "nothing of the kind")};
    EXPECT_THAT(refusal(request, map), HasSubstr("a.npy: not an .npy file"));
    request.values = {write("a.npy", to_npy("<f8", {162, 1, 1}, std::vector<double>(162)))};
    EXPECT_THAT(refusal(request, map), HasSubstr("its shape is not one of rows and columns"));
    request.values = {write("a.csv", by_turns("1,2", "3,"))};
    EXPECT_THAT(refusal(request, map), HasSubstr("a.csv:2: a number is missing; write nan"));
    request = {};
    for (const auto& [row, found] : {std::pair{"-0.5,1.5", "-0.5"}, {"inf,0", "inf"}, {"nan,1", "nan"}}) {
        request.weights = {write("w.csv", by_turns(row, "0.5,0.5"))};
        EXPECT_THAT(refusal(request, map), HasSubstr(fmt::format("w.csv: row 0 (from 0) holds {}", found)));
    }
    request = {};
    request.values = {write("id.csv", "id,heat\n" + by_turns("7,1", "8,2"))};
    EXPECT_THAT(refusal(request, map),
                HasSubstr("id.csv:2: number '7' where 0 should stand: the column 'id' numbers the rows"));
}

/// As R's write.csv numbers them.
TEST_F(Transfer, RowsMayBeNumberedFrom1) {
    std::string rows = "\"\",heat\n";
    for (int v = 1; v <= ball_.vertex_count(); ++v) rows += fmt::format("\"{}\",2\n", v);
    TransferRequest request;
    request.values = {write("heat.csv", rows)};
    const std::string carried = carry(request, identity_onto(ball_)).at("heat.csv");
    EXPECT_THAT(carried, testing::StartsWith(",heat\n1,2\n2,2\n"));
    EXPECT_THAT(carried, testing::EndsWith(fmt::format("\n{},2\n", ball_.vertex_count())));
    rows.replace(rows.find("\"9\""), 3, "\"7\"");
    request.values = {write("heat.csv", rows)};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("heat.csv:10: number '7' where 9 should"));
}

TEST_F(Transfer, SaysWhatToWriteInsteadOfWhatIsNoNumber) {
    TransferRequest request;
    const auto refusal_of = [&](const std::string& rows) {
        request.values = {write("a.txt", rows)};
        return refusal(request, identity_onto(ball_));
    };
    EXPECT_THAT(refusal_of(by_turns("1", "NA")), HasSubstr("'NA' is not a number; write nan where there"));
    EXPECT_THAT(refusal_of(by_turns("1;2", "1,5;2")),
                HasSubstr("'1,5' is not a number; write decimals with"));
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

TEST_F(Transfer, NumbersOfRowsMayBeWrittenAsFloats) {
    const auto table = [&](const std::string& value, double shift = 0) {
        std::string rows = "vertex,x\n";
        for (int v = 0; v < ball_.vertex_count(); ++v) rows += fmt::format("{:.18e},{}\n", v + shift, value);
        return rows;
    };
    const Correspondence map = identity_onto(ball_);
    TransferRequest request;
    request.values = {write("heat.csv", table("2"))};
    request.labels = {write("parts.csv", table("arm"))};
    request.weights = {write("skin.csv", table("1"))};
    request.points = {write("points.txt", "7.000000000000000000e+00\n")};
    auto carried = carry(request, map);
    EXPECT_THAT(carried.at("heat.csv"), StartsWith("vertex,x\n0,2\n1,2\n"));
    EXPECT_THAT(carried.at("parts.csv"), StartsWith("vertex,x\n0,arm\n1,arm\n"));
    EXPECT_THAT(carried.at("skin.csv"), StartsWith("vertex,x\n0,1\n1,1\n"));
    EXPECT_EQ(carried.at("points.txt"), "7\n");
    request = {};
    request.values = {write("heat.csv", table("2", .5))};
    EXPECT_THAT(refusal(request, map), HasSubstr("heat.csv:2: number '5.000000000000000000e-01' where 0"));
}

TEST_F(Transfer, CarriesRegions) {
    TransferRequest request;
    request.regions = {write("r.txt", "3\n17\n200\n")};
    EXPECT_EQ(carry(request, identity_onto(ball_)).at("r.txt"), "3\n17\n200\n");
    request.regions = {write("r.txt", "320\n")};
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("r.txt:1: '320' is not one of the mesh's 320 faces"));
    request.regions = {write("r.txt", "vertex\n3\n17\n")};
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("r.txt:1: 'vertex' names vertices"));
}

/// The texture coordinates under points of a cut mesh, as the source has them there.
double worst_uv_error(const TexturedMesh& cut, const Correspondence& map, const ObjModel& model) {
    const Atlas source(map.from, model), target(cut.mesh, cut.model);
    const ClosestPoint on_target(map.to);
    const PointCarrier back(map.to, map.back, map.from);
    double worst = 0;
    for (int f = 0; f < cut.mesh.face_count(); ++f) {
        if (!(face_normal(cut.mesh, f).norm() > 1e-6)) continue;
        const SurfacePoint middle{f, Vec3::Constant(1 / 3.)};
        const SurfacePoint at = back(on_target(position(cut.mesh, middle)).point);
        Vec2 difference = target(middle) - source(at);
        difference[0] -= std::round(difference[0]);  // the picture repeats
        worst = std::max(worst, difference.norm());
    }
    return worst;
}

TEST_F(Transfer, TheIdentityKeepsTextureCoordinates) {
    const ObjModel model = unwrapped(ball_);
    const Correspondence map = identity_onto(ball_);
    const PointCarrier back(map.to, map.back, map.from);
    const TexturedMesh cut = cut_at_seams(map, back, model);
    EXPECT_EQ(cut.mesh.faces, ball_.faces);
    for (int f = 0; f < ball_.face_count(); ++f)
        for (int k = 0; k < 3; ++k)
            EXPECT_LT(
                (cut.model.uv[std::size_t(cut.model.uv_of(f, k))] - model.uv[std::size_t(model.uv_of(f, k))])
                    .norm(),
                1e-9);
}

TEST_F(Transfer, NoFaceSpansASeam) {
    TriangleMesh fine = shapes::ellipsoid(4, {1, .8, 1.3}), coarse = shapes::ellipsoid(3, {1, .8, 1.3});
    coarse.vertices = shapes::moved(coarse, 1, .3, {0, 0, 0}).vertices;
    for (const auto& [from, to] : {std::pair(fine, coarse), std::pair(coarse, fine)}) {
        const ObjModel model = unwrapped(from);
        // Balls about one centre: rays through it map them.
        const auto project = [](const TriangleMesh& a, const TriangleMesh& b) {
            return closest_points(a.vertices, b);
        };
        const Correspondence map{"a.obj", "b.obj", from, to, project(from, to), project(to, from)};
        const PointCarrier back(map.to, map.back, map.from);
        const TexturedMesh cut = cut_at_seams(map, back, model);
        EXPECT_GT(cut.mesh.face_count(), to.face_count());
        EXPECT_NEAR(surface_area(cut.mesh), surface_area(to), 1e-9);
        double widest = 0;
        for (int f = 0; f < cut.mesh.face_count(); ++f) {
            const Vec3 p = position(cut.mesh, {f, Vec3::Constant(1 / 3.)});
            if (p.head<2>().norm() < .35) continue;  // the poles, where the coordinates themselves end
            for (int k = 0; k < 3; ++k)
                widest =
                    std::max(widest, std::abs(cut.model.uv[std::size_t(cut.model.uv_of(f, k))][0] -
                                              cut.model.uv[std::size_t(cut.model.uv_of(f, (k + 1) % 3))][0]));
        }
        EXPECT_LT(widest, .15);
    }
}

/// What was cut is a mesh like others: cuts near a corner or another cut leave no slivers, the coordinates go
/// on from face to face but at seams, and a texture is carried on from there as it was the first time.
TEST_F(Transfer, WhatWasCutIsCutAgain) {
    const TriangleMesh fine = shapes::ellipsoid(4, {1, .8, 1.3});
    const ObjModel model = unwrapped(ball_);
    const auto onto = [](const TriangleMesh& from, const TriangleMesh& to) {
        return Correspondence{
            "a.obj", "b.obj", from, to, closest_points(from.vertices, to), closest_points(to.vertices, from)};
    };
    const Correspondence there = onto(ball_, fine);
    const TexturedMesh cut = cut_at_seams(there, PointCarrier(there.to, there.back, there.from), model);
    std::map<int, std::set<int>> uv_at;
    for (int f = 0; f < cut.mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto sides = [&](int i) {
                return (cut.mesh.vertex(cut.mesh.faces(f, i)) -
                        cut.mesh.vertex(cut.mesh.faces(f, (i + 1) % 3)))
                    .norm();
            };
            EXPECT_GT(sides(k), 5e-4 * std::max({sides(0), sides(1), sides(2)})) << "face " << f;
            uv_at[cut.mesh.faces(f, k)].insert(cut.model.uv_of(f, k));
        }
    const auto one = std::ranges::count_if(uv_at, [](const auto& at) { return at.second.size() == 1; });
    EXPECT_GT(double(one), .9 * double(uv_at.size()));
    const Correspondence back = onto(cut.mesh, ball_);
    const TexturedMesh again = cut_at_seams(back, PointCarrier(back.to, back.back, back.from), cut.model);
    EXPECT_LT(again.mesh.face_count(), 2 * ball_.face_count());
}

TEST_F(Transfer, TextureCoordinatesOfAMovedCopyAreThoseOfTheSource) {
    const Correspondence map = moved_copy(ball_);
    const ObjModel model = unwrapped(ball_);
    const PointCarrier back(map.to, map.back, map.from);
    const TexturedMesh cut = cut_at_seams(map, back, model);
    EXPECT_EQ(cut.mesh.face_count(), ball_.face_count());
    EXPECT_LT(worst_uv_error(cut, map, model), 1e-6);
}

/// Every face with vertices of its own.
TriangleMesh split_at_edges(const TriangleMesh& mesh) {
    TriangleMesh split{Points(3 * mesh.face_count(), 3), mesh.faces};
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k) {
            split.vertices.row(3 * f + k) = mesh.vertices.row(mesh.faces(f, k));
            split.faces(f, k) = 3 * f + k;
        }
    return split;
}

TEST_F(Transfer, VerticesListedForEveryFaceMakeNoSeam) {
    const TriangleMesh fine = shapes::ellipsoid(3, {1, .8, 1.3});
    ObjModel model = unwrapped(ball_);
    // Without the seam and the poles: one coordinate by height.
    for (int f = 0; f < ball_.face_count(); ++f)
        for (int k = 0; k < 3; ++k)
            model.uv[std::size_t(model.uv_of(f, k))] =
                Vec2(.5, ball_.vertices(ball_.faces(f, k), 2) / 4 + .5);
    for (const TriangleMesh& from : {ball_, split_at_edges(ball_)}) {
        const Correspondence map{"a.obj",
                                 "b.obj",
                                 from,
                                 fine,
                                 closest_points(from.vertices, fine),
                                 closest_points(fine.vertices, from)};
        const PointCarrier back(map.to, map.back, map.from);
        EXPECT_EQ(cut_at_seams(map, back, model).mesh.face_count(), fine.face_count())
            << from.vertex_count() << " vertices";
    }
}

TextureImage gradient(int n) {
    TextureImage image(n, n);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            unsigned char* at = image.pixel(x, y);
            at[0] = static_cast<unsigned char>(255 * x / (n - 1));
            at[1] = static_cast<unsigned char>(255 * y / (n - 1));
            at[2] = 128, at[3] = 255;
        }
    return image;
}

/// With the coordinates of its own plane, and one material.
ObjModel in_its_own_plane(const TriangleMesh& square) {
    ObjModel model;
    for (const auto p : square.vertices.rowwise()) model.uv.emplace_back(p[0], p[1]);
    model.uv_of = square.faces;
    model.material.assign(std::size_t(square.face_count()), 0);
    model.materials = {"skin"};
    return model;
}

TEST_F(Transfer, BakesWhatTheIdentityShows) {
    // The image comes out as it went in.
    const TriangleMesh square = shapes::square(8);
    const ObjModel model = in_its_own_plane(square);
    write("skin.png", to_png(gradient(64)));
    write("skin.mtl", "newmtl skin\nmap_Kd -s 1 1 1 skin.png\n");
    Correspondence map = identity_onto(square);
    map.to_file = write("square.obj", obj_of(square, model, "skin.mtl"));
    TransferRequest request;
    request.texture = map.to_file;
    request.bake = {64, 2};
    const auto files = carry(request, map);
    const TextureImage baked = read_png(write("baked.png", files.at("square_textured.png")));
    ASSERT_EQ(baked.width, 64);
    int worst = 0;
    const TextureImage truth = gradient(64);
    for (std::size_t i = 0; i < truth.rgba.size(); ++i)
        worst = std::max(worst, std::abs(int(truth.rgba[i]) - int(baked.rgba[i])));
    EXPECT_LE(worst, 1);
    EXPECT_THAT(files.at("square_textured.mtl"), HasSubstr("map_Kd square_textured.png"));
}

/// A part of a PNG file: its length, type, content and checksum.
std::string png_part(const std::string& type, const std::string& content) {
    const auto word = [](std::uint32_t number) {
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8) bytes += char(number >> shift & 255);
        return bytes;
    };
    const std::string named = type + content;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(named.data()), uInt(named.size()));
    return word(std::uint32_t(content.size())) + named + word(std::uint32_t(sum));
}

/// One grey pixel of 16 bits a channel, without or with a word that it is sRGB.
std::string deep_png(std::uint16_t grey, bool says_srgb) {
    std::string row(1, '\0'), packed(64, '\0');
    for (int channel = 0; channel < 3; ++channel) row += {char(grey >> 8), char(grey & 255)};
    uLongf size = uLongf(packed.size());
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(row.data()),
             uLong(row.size()));
    packed.resize(size);
    const std::string header("\0\0\0\1\0\0\0\1\x10\2\0\0\0", 13);
    return "\x89PNG\r\n\x1a\n" + png_part("IHDR", header) +
           (says_srgb ? png_part("sRGB", std::string(1, '\0')) : "") + png_part("IDAT", packed) +
           png_part("IEND", "");
}

TEST_F(Transfer, SixteenBitsAreSrgbAsEightAre) {
    for (const bool says_srgb : {false, true}) {
        const TextureImage image = read_png(write("a.png", deep_png(100 * 257, says_srgb)));
        EXPECT_EQ(int(image.rgba[0]), 100) << says_srgb;
        EXPECT_EQ(int(image.rgba[3]), 255);
    }
}

TEST_F(Transfer, SaysThatColouredMaterialsAreBakedWithoutTheirColour) {
    write("skin.png", to_png(gradient(8)));
    Correspondence map = identity_onto(ball_);
    ObjModel model = unwrapped(ball_);
    for (Vec2& uv : model.uv) uv = uv.cwiseMax(0).cwiseMin(1);
    map.to_file = write("a.obj", obj_of(ball_, model, "skin.mtl"));
    TransferRequest request;
    request.texture = map.to_file;
    request.bake = {16, 1};
    write("skin.mtl", "newmtl skin\nKd 1 .5 .5\nmap_Kd skin.png\n");
    EXPECT_THAT(warnings_of(request, map), HasSubstr("skin.png: is baked as it is, not times the colour Kd"));
    write("skin.mtl", "newmtl skin\nKd .8 .8 .8\nmap_Kd skin.png\n");
    EXPECT_EQ(warnings_of(request, map), "");
}

TEST_F(Transfer, NamesTheFileThatCannotBeBakedOnto) {
    write("skin.mtl", "newmtl skin\nKd 1 1 1\n");
    ObjModel outside = unwrapped(ball_);
    outside.uv[0] = {1.5, .5};
    TransferRequest request;
    request.texture = write("a.obj", obj_of(ball_, unwrapped(ball_), "skin.mtl"));
    request.bake = {16, 1};
    request.onto = write("outside.obj", obj_of(ball_, outside));
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("outside.obj: texture coordinates (1.5, 0.5)"));
}

/// A square whose second half lies where its first does, and in one point: what is said of baking onto these.
TEST_F(Transfer, SaysWhereMemoryDoesNotSufficeToBake) {
    const TriangleMesh square = shapes::square(8);
    write("skin.mtl", "newmtl skin\nKd 1 1 1\n");
    Correspondence map = identity_onto(square);
    map.to_file = write("a.obj", obj_of(square, in_its_own_plane(square), "skin.mtl"));
    TransferRequest request;
    request.texture = map.to_file;
    request.bake = {10'000'000, 0};
    try {
        carry(request, map);
        FAIL() << "petabytes";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_output);
        EXPECT_THAT(error.what(), HasSubstr("use a smaller --bake than 10000000"));
    }
}

TEST_F(Transfer, SaysWhereFacesOverlapInTextureCoordinates) {
    const TriangleMesh square = shapes::square(8);
    ObjModel model = in_its_own_plane(square);
    write("skin.mtl", "newmtl skin\nKd 1 1 1\n");
    TransferRequest request;
    request.texture = write("a.obj", obj_of(square, model, "skin.mtl"));
    request.bake = {61, 2};  // whose pixels lie on no side of a face
    request.onto = request.texture;
    EXPECT_EQ(warnings_of(request, identity_onto(square)), "");
    for (Vec2& uv : model.uv) uv[0] = std::min(uv[0], 1 - uv[0]);
    request.onto = write("folded.obj", obj_of(square, model));
    EXPECT_THAT(warnings_of(request, identity_onto(square)),
                HasSubstr("folded.obj: faces overlap in its texture coordinates on 9"));
    ObjModel tiled = model;
    tiled.uv = {{0, 0}, {1, 0}, {0, 1}};
    for (int f = 0; f < int(tiled.uv_of.rows()); ++f) tiled.uv_of.row(f) << 0, 1, 2;
    request.onto = write("tiled.obj", obj_of(square, tiled));
    EXPECT_THAT(refusal(request, identity_onto(square)),
                HasSubstr("tiled.obj: more than 32 faces lie over each other"));
    for (Vec2& uv : model.uv) uv.setZero();
    request.onto = write("zero.obj", obj_of(square, model));
    EXPECT_THAT(refusal(request, identity_onto(square)),
                HasSubstr("zero.obj: its texture coordinates cover none of 61 x 61 pixels; give --onto"));
}

TEST_F(Transfer, BakesFacesThatAreFarSmallerThanPixels) {
    const TriangleMesh fine = shapes::square(100);
    write("skin.mtl", "newmtl skin\nKd 1 1 1\n");
    TransferRequest request;
    request.texture = write("fine.obj", obj_of(fine, in_its_own_plane(fine), "skin.mtl"));
    request.onto = request.texture;
    request.bake = {4, 0};
    EXPECT_EQ(warnings_of(request, identity_onto(fine)), "");
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

/// The description within a .glb.
nlohmann::json description_of(const std::string& glb) {
    std::uint32_t length;
    std::memcpy(&length, glb.data() + 12, 4);
    return nlohmann::json::parse(glb.substr(20, length));
}

/// A third of the faces each has the first, the second and the third material.
ObjModel of_three_materials(const TriangleMesh& mesh) {
    ObjModel model = unwrapped(mesh);
    model.materials = {"skin", "M\xe4t", "horn"};
    for (std::size_t f = 0; f < model.material.size(); ++f) model.material[f] = int(f % 3);
    return model;
}

TEST_F(Transfer, AGlbHoldsEveryImageOnceAndValidText) {
    write("skin.png", to_png(gradient(8)));
    TextureImage glass = gradient(8);
    glass.rgba[3] = 100;
    write("glass.png", to_png(glass));
    write("skin.mtl",
          "newmtl skin\nmap_Kd skin.png\nnewmtl M\xe4t\nmap_Kd skin.png\n"
          "newmtl horn\nmap_Kd glass.png\n");
    TransferRequest request;
    request.texture = write("a.obj", obj_of(ball_, of_three_materials(ball_), "skin.mtl"));
    const auto glb = description_of(carry(request, identity_onto(ball_)).at("b_textured.glb"));
    ASSERT_EQ(glb.at("materials").size(), 3u);
    EXPECT_EQ(glb.at("images").size(), 2u);
    EXPECT_EQ(glb.at("materials")[1].at("name"), "M\xef\xbf\xbdt");
    const auto texture = [&](int i) {
        return glb.at("materials")[std::size_t(i)]
            .at("pbrMetallicRoughness")
            .at("baseColorTexture")
            .at("index");
    };
    EXPECT_EQ(texture(0), texture(1));
    EXPECT_NE(texture(0), texture(2));
    EXPECT_FALSE(glb.at("materials")[0].contains("alphaMode"));
    EXPECT_EQ(glb.at("materials")[2].at("alphaMode"), "BLEND");
}

TEST_F(Transfer, AGlbIsBakedToo) {
    const TriangleMesh square = shapes::square(2);
    write("skin.mtl", "newmtl skin\nmap_Kd skin.png\nnewmtl unused\nmap_Kd glass.png\n");
    Correspondence map = identity_onto(square);
    map.to_file = write("square.obj", obj_of(square, in_its_own_plane(square), "skin.mtl"));
    TransferRequest request;
    request.texture = map.to_file;
    request.bake = {8, 0};
    // As transparent as what is baked, whatever lies beside the patches.
    TextureImage glass = gradient(8);
    glass.rgba[3] = 100;
    write("glass.png", to_png(glass));
    for (const bool transparent : {false, true}) {
        write("skin.png", to_png(transparent ? glass : gradient(8)));
        const auto files = carry(request, map);
        const std::string& glb = files.at("square_textured.glb");
        EXPECT_THAT(glb, HasSubstr(files.at("square_textured.png")));
        const auto material = description_of(glb).at("materials")[0];
        EXPECT_EQ(material.at("name"), "baked");
        EXPECT_EQ(material.contains("alphaMode"), transparent);
    }
    write("skin.mtl", "newmtl skin\nmap_Kd skin.png\nd 0.5\n");
    write("skin.png", to_png(gradient(8)));
    const auto files = carry(request, map);
    EXPECT_TRUE(description_of(files.at("square_textured.glb")).at("materials")[0].contains("alphaMode"));
    const TextureImage drawn = read_png(write("drawn.png", files.at("square_textured.png")));
    EXPECT_EQ(drawn.rgba[4 * (4 * 8 + 4) + 3], 128) << "half of what is drawn in the middle";
}

TEST_F(Transfer, MaterialsStayApartWhateverTheirNames) {
    ObjModel model = of_three_materials(ball_);
    model.materials = {"Material #1", "Material #2", "Material #3"};
    write("a.mtl", "newmtl Material #1\nKd 1 0 0\nnewmtl Material #2\nKd 0 1 0\nd .5\nnewmtl Material #3\n");
    TransferRequest request;
    request.texture = write("a.obj", obj_of(ball_, model, "a.mtl"));
    const auto files = carry(request, identity_onto(ball_));
    EXPECT_THAT(files.at("b_textured.obj"), HasSubstr("usemtl Material #3\n"));
    EXPECT_THAT(files.at("b_textured.mtl"), HasSubstr("newmtl Material #3\n"));
    const auto glb = description_of(files.at("b_textured.glb"));
    ASSERT_EQ(glb.at("materials").size(), 3u);
    EXPECT_EQ(glb.at("materials")[1].at("pbrMetallicRoughness").at("baseColorFactor")[3], .5);
    EXPECT_EQ(glb.at("materials")[1].at("alphaMode"), "BLEND");
}

TEST_F(Transfer, TexturesLieWhereTheirMaterialPutsThem) {
    const TriangleMesh square = shapes::square(2);
    const ObjModel model = in_its_own_plane(square);
    write("skin.png", to_png(gradient(64)));
    write("skin.mtl", "newmtl skin\nmap_Kd -s .5 .5 1 -o .25 .125 0 skin.png\n");
    Correspondence map = identity_onto(square);
    map.to_file = write("square.obj", obj_of(square, model, "skin.mtl"));
    TransferRequest request;
    request.texture = map.to_file;
    const auto glb = description_of(carry(request, map).at("square_textured.glb"));
    const auto& placed = glb.at("materials")[0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"];
    EXPECT_EQ(placed["KHR_texture_transform"]["offset"], nlohmann::json({.25, .375}));
    request.bake = {64, 0};
    const TextureImage baked = read_png(write("baked.png", carry(request, map).at("square_textured.png")));
    // The middle of the square is at (.5, .5) of .5 + (.25, .125).
    EXPECT_NEAR(baked.pixel(32, 32)[0], 255 * .5, 4);
    EXPECT_NEAR(baked.pixel(32, 32)[1], 255 * (1 - .375), 4);
}

TEST_F(Transfer, ImagesThatGltfDoesNotTakeAreCopied) {
    write("skin.tga", "no picture that glTF takes");
    write("skin.mtl", "newmtl skin\nKd 1 .5 0\nmap_Kd skin.tga\n");
    TransferRequest request;
    request.texture = write("a.obj", obj_of(ball_, unwrapped(ball_), "skin.mtl"));
    EXPECT_THAT(warnings_of(request, identity_onto(ball_)),
                HasSubstr("skin.tga: glTF takes PNG and JPEG images only"));
    const auto files = carry(request, identity_onto(ball_));
    EXPECT_EQ(files.at("skin.tga"), "no picture that glTF takes");
    EXPECT_THAT(files.at("b_textured.mtl"), HasSubstr("map_Kd skin.tga"));
    const auto glb = description_of(files.at("b_textured.glb"));
    EXPECT_FALSE(glb.contains("images"));
    EXPECT_EQ(glb.at("materials")[0].at("pbrMetallicRoughness").at("baseColorFactor")[1], .5);
}

TEST_F(Transfer, ImagesTakeNoOtherImagesPlace) {
    for (const char* folder : {"a", "b", "results"}) std::filesystem::create_directory(folder_ / folder);
    for (const std::string folder : {"a", "b"}) {
        write(folder + "/skin.png", to_png(gradient(folder == "a" ? 8 : 4)));
        write(folder + "/skin.mtl", "newmtl skin\nmap_Kd skin.png\n");
        write(folder + "/m.obj", obj_of(ball_, unwrapped(ball_), "skin.mtl"));
    }
    // In one run, and beside what lies there; what is there already stays itself.
    TransferRequest request;
    request.mesh = folder_ / "a/m.obj";
    request.texture = folder_ / "b/m.obj";
    request.folder = folder_ / "results";
    for (int run = 0; run < 2; ++run) {
        const auto files = carry(request, identity_onto(ball_));
        EXPECT_EQ(files.at("skin.png"), read_file(folder_ / "a/skin.png"));
        EXPECT_EQ(files.at("skin-2.png"), read_file(folder_ / "b/skin.png"));
        EXPECT_THAT(files.at("source_on_target.mtl"), HasSubstr("map_Kd skin.png"));
        EXPECT_THAT(files.at("b_textured.mtl"), HasSubstr("map_Kd skin-2.png"));
        for (const auto& [name, bytes] : files) write("results/" + name, bytes);
    }
    request.texture.clear();
    request.mesh = folder_ / "b/m.obj";
    EXPECT_THAT(carry(request, identity_onto(ball_)).at("source_on_target.mtl"),
                HasSubstr("map_Kd skin-2.png"));
    std::filesystem::remove(folder_ / "results/skin-2.png");
    std::filesystem::create_directory(folder_ / "results/skin-2.png");
    EXPECT_THAT(carry(request, identity_onto(ball_)).at("source_on_target.mtl"),
                HasSubstr("map_Kd skin-3.png"));
}

TEST_F(Transfer, SaysWhichMaterialsAreNotDescribed) {
    write("skin.mtl", "newmtl skin\nKd 1 1 1\n");
    ObjModel model = unwrapped(ball_);
    model.materials = {"fur"};
    TransferRequest request;
    request.texture = write("a.obj", obj_of(ball_, model, "skin.mtl"));
    EXPECT_THAT(warnings_of(request, identity_onto(ball_)),
                HasSubstr("a.obj: no library (mtllib) describes the materials fur"));
}

TEST_F(Transfer, WritesTexturesAndGlb) {
    write("skin.png", to_png(gradient(8)));
    write("skin.mtl", "newmtl skin\nKd 1 1 1\nmap_Kd skin.png\n");
    TransferRequest request;
    request.texture = write("a.obj", obj_of(ball_, unwrapped(ball_), "skin.mtl"));
    const auto files = carry(request, identity_onto(ball_));
    EXPECT_EQ(files.at("skin.png"), read_file(folder_ / "skin.png"));
    EXPECT_THAT(files.at("b_textured.mtl"), HasSubstr("map_Kd skin.png"));
    EXPECT_THAT(files.at("b_textured.obj"), HasSubstr("mtllib b_textured.mtl"));
    const std::string& glb = files.at("b_textured.glb");
    EXPECT_TRUE(glb.starts_with("glTF"));
    EXPECT_EQ(glb.size() % 4, 0u);
}

TEST_F(Transfer, WritesNoEmptyLibrary) {
    TransferRequest request;
    request.texture = write("a.obj", obj_of(ball_, unwrapped(ball_)));
    write("empty.mtl", "");
    request.mesh = write("b.obj", obj_of(ball_, unwrapped(ball_), "empty.mtl"));
    for (const auto& [name, bytes] : carry(request, identity_onto(ball_))) {
        EXPECT_FALSE(name.ends_with(".mtl"));
        EXPECT_THAT(bytes, Not(HasSubstr("mtllib")));
    }
}

TEST_F(Transfer, CarriesShapesWhoseMaterialsAreNotThere) {
    TransferRequest request;
    request.mesh = write("b.obj", obj_of(ball_, unwrapped(ball_), "skin.mtl"));
    const auto files = carry(request, identity_onto(ball_));
    ASSERT_EQ(files.size(), 1u);
    const std::string& shape = files.begin()->second;
    EXPECT_THAT(shape, Not(HasSubstr("mtllib")));
    EXPECT_EQ(parse_mesh(shape, "b.obj").faces, ball_.faces);
}

TEST_F(Transfer, WarnsOfWhatMayBeDecimalCommas) {
    std::string commas, fractions;
    for (int v = 0; v < ball_.vertex_count(); ++v) {
        commas += fmt::format("{},{}\n", v, v % 7);
        fractions += fmt::format("{},.{}\n", v, v % 7);
    }
    TransferRequest request;
    request.values = {write("heat.txt", commas)};
    EXPECT_THAT(warnings_of(request, identity_onto(ball_)), HasSubstr("two columns of whole numbers"));
    request.values = {write("heat.txt", fractions)};
    EXPECT_EQ(warnings_of(request, identity_onto(ball_)), "");
}

TEST_F(Transfer, RefusesTexturesThatAreNotThere) {
    TransferRequest request;
    request.texture = write("a.obj", obj_of(ball_, unwrapped(ball_), "skin.mtl"));
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("its materials skin.mtl are missing"));
    write("skin.mtl", "newmtl skin\nmap_Kd skin.png\n");
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("skin.mtl:2: the texture skin.png is missing"));
    write("skin.png", "no picture");
    request.bake = {16, 1};
    Correspondence map = identity_onto(ball_);
    map.to_file = request.texture;
    EXPECT_NE(refusal(request, map), "none");
    request.texture = write("b.obj", obj_of(shapes::ellipsoid(1), unwrapped(shapes::ellipsoid(1))));
    EXPECT_THAT(refusal(request, identity_onto(ball_)), HasSubstr("b.obj: is not the mesh a.obj of the map"));
    ObjModel bare = unwrapped(ball_);
    bare.uv_of.setConstant(-1);
    request.texture = write("c.obj", obj_of(ball_, bare));
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("c.obj: has faces without texture coordinates"));
}

TEST_F(Transfer, CarriesAShapeExactlyToAMovedCopy) {
    const Correspondence map = moved_copy(ball_);
    TriangleMesh smile = ball_;
    for (auto p : smile.vertices.rowwise())
        p += .2 * std::exp(-4 * (p - smile.vertices.row(3)).squaredNorm()) * p;
    const Points truth = shapes::shuffled(shapes::moved(smile, 3, 1.2, {1, -2, 3}), 7).vertices;
    EXPECT_LT((carry_shape(map, smile.vertices) - truth).rowwise().norm().maxCoeff(), 2e-3 * .2 * 3);
}

TEST_F(Transfer, CarriesAShapeInTheFramesOfAnotherPose) {
    // A swelling along normals stays one, wherever the limbs point.
    const PosedPair pair;
    Points swollen = pair.rest.vertices + .05 * vertex_normals(pair.rest);
    const Points moved = carry_shape(pair.map, swollen);
    const Points truth = .05 * vertex_normals(pair.map.to);
    const Eigen::VectorXd error = (moved - pair.map.to.vertices - truth).rowwise().norm() / .05;
    EXPECT_LT(error.mean(), .15);
}

/// Makes the identity a map onto the mirrored mesh, whose faces look outward, too.
void mirror(Correspondence& map) {
    map.to.vertices.col(0) *= -1;
    map.to.faces.col(1).swap(map.to.faces.col(2));
    for (SurfacePoint& image : map.there) std::swap(image.barycentric[1], image.barycentric[2]);
}

/// A ball and a small one beside it, which is not in the map.
struct WithEye {
    TriangleMesh both;
    Correspondence map;

    WithEye(const TriangleMesh& ball, bool mirrored) {
        const TriangleMesh eye = shapes::moved(shapes::ellipsoid(1), .05, .4, {.3, .7, .5});
        const int n = ball.vertex_count();
        both = {Points(n + eye.vertex_count(), 3), Faces(ball.face_count() + eye.face_count(), 3)};
        both.vertices << ball.vertices, eye.vertices;
        both.faces << ball.faces, eye.faces.array() + n;
        map = identity_onto(both);
        for (int v = n; v < both.vertex_count(); ++v)
            map.there[std::size_t(v)] = map.back[std::size_t(v)] = {};
        if (mirrored) mirror(map);
        map.to = shapes::moved(map.to, 3, 1.2, {1, -2, 3});
    }
};

TEST_F(Transfer, WhatWasLeftOutOfTheMapFollowsItsNeighbours) {
    for (const bool mirrored : {false, true}) {
        const WithEye pair(ball_, mirrored);
        EXPECT_LT((carried_vertices(pair.map) - pair.map.to.vertices).rowwise().norm().maxCoeff(), 1e-9)
            << mirrored;
    }
}

TEST_F(Transfer, AShapeMovesWhatWasLeftOutOfTheMap) {
    const WithEye pair(ball_, false);
    TriangleMesh risen = pair.both;
    risen.vertices.col(2).array() += .3;
    const Points truth = shapes::moved(risen, 3, 1.2, {1, -2, 3}).vertices;
    EXPECT_LT((carry_shape(pair.map, risen.vertices) - truth).rowwise().norm().maxCoeff(), .01);
}

TEST_F(Transfer, AShapeMovesAsMuchBesideWhatHasNoImage) {
    const TriangleMesh plane = shapes::square(20);
    Correspondence half = identity_onto(plane);
    const double middle = plane.vertices.col(0).mean();
    for (int v = 0; v < plane.vertex_count(); ++v)
        if (plane.vertices(v, 0) > middle) half.back[std::size_t(v)] = {};
    const Points risen = plane.vertices.rowwise() + Eigen::RowVector3d(0, 0, .1);
    EXPECT_LT((carry_shape(half, risen) - risen).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(Transfer, AShapeMayLieElsewhere) {
    Correspondence map = identity_onto(ball_);
    map.to_file = "b.ply";
    TriangleMesh bulging = ball_;
    bulging.vertices.row(5) *= 1.1;
    EXPECT_FALSE(laid_onto(ball_, bulging.vertices));
    const Points away = shapes::moved(bulging, 1000, 1.5, {4, 5, 6}).vertices;
    EXPECT_LT((laid_onto(ball_, away).value() - bulging.vertices).rowwise().norm().maxCoeff(), .01);
    TriangleMesh bent = ball_;
    bent.vertices.col(2).array() += bent.vertices.col(0).array().square();
    EXPECT_FALSE(laid_onto(ball_, bent.vertices)) << "its motion is not one of the whole";
    TransferRequest request;
    request.shapes = {write("away.ply", to_ply({away, ball_.faces}))};
    EXPECT_THAT(warnings_of(request, map), HasSubstr("lies elsewhere than a.obj"));
    for (const Points& other : {bulging.vertices, away, bent.vertices})
        EXPECT_FALSE(is_mirror_image(ball_, other));
    TriangleMesh exchanged = bulging;
    exchanged.vertices.col(1).swap(exchanged.vertices.col(2));
    EXPECT_TRUE(is_mirror_image(ball_, exchanged.vertices));
    request.shapes = {write("exchanged.ply", to_ply(exchanged))};
    EXPECT_THAT(refusal(request, map), HasSubstr("is a mirror image of a.obj, or has two axes exchanged"));
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

/// The same map between meshes whose faces all have vertices of their own.
Correspondence split_at_edges(const Correspondence& map) {
    Correspondence split{map.from_file,          map.to_file, split_at_edges(map.from),
                         split_at_edges(map.to), {},          {}};
    for (const int v : map.from.faces.reshaped<Eigen::RowMajor>())
        split.there.push_back(map.there[std::size_t(v)]);
    for (const int v : map.to.faces.reshaped<Eigen::RowMajor>())
        split.back.push_back(map.back[std::size_t(v)]);
    return split;
}

/// Of values of the vertices of a mesh, those of the corners of its faces.
Points at_corners(const Points& values, const TriangleMesh& mesh) {
    Points result(3 * mesh.face_count(), 3);
    for (int i = 0; i < result.rows(); ++i) result.row(i) = values.row(mesh.faces(i / 3, i % 3));
    return result;
}

TEST_F(Transfer, AShapeIsCarriedAlikeWhereEveryFaceHasVerticesOfItsOwn) {
    const PosedPair pair;
    const Points swollen = pair.rest.vertices + .05 * vertex_normals(pair.rest);
    const Points whole = carry_shape(pair.map, swollen);
    const Points split = carry_shape(split_at_edges(pair.map), at_corners(swollen, pair.rest));
    EXPECT_LT((split - at_corners(whole, pair.map.to)).rowwise().norm().maxCoeff(), 1e-9);
}

TEST_F(Transfer, WhatWasLeftOutStaysWholeWhereEveryFaceHasVerticesOfItsOwn) {
    WithEye pair(ball_, false);
    pair.map.to.vertices.col(0) *= 1.3;  // no similarity takes the ball's surroundings there
    const Points carried = carried_vertices(split_at_edges(pair.map));
    Points first = Points::Constant(pair.both.vertex_count(), 3, NAN);
    for (int i = 0; i < carried.rows(); ++i) {
        auto there = first.row(pair.both.faces(i / 3, i % 3));
        if (there.hasNaN()) there = carried.row(i);
        ASSERT_LT((carried.row(i) - there).norm(), 1e-9) << "corner " << i;
    }
}

TEST_F(Transfer, SaysHowManyVerticesFollowTheirNeighbours) {
    const WithEye pair(ball_, false);
    const ObjModel plain{{},
                         Faces::Constant(pair.both.face_count(), 3, -1),
                         std::vector<int>(std::size_t(pair.both.face_count()), -1),
                         {},
                         {}};
    TransferRequest request;
    request.mesh = write("a.obj", obj_of(pair.both, plain));
    EXPECT_THAT(warnings_of(request, pair.map), HasSubstr("a.obj: 42 vertices have no image; they follow"));
    request = {};
    request.shapes = {folder_ / "a.obj"};
    Correspondence map = pair.map;
    map.to_file = "b.off";
    EXPECT_THAT(warnings_of(request, map), HasSubstr("b.off: 42 vertices have no image; they follow"));
}

TEST_F(Transfer, AMirroringMapTurnsPolygons) {
    Correspondence map = identity_onto(ball_);
    mirror(map);
    std::string obj;
    for (const auto p : ball_.vertices.rowwise()) obj += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
    obj += "vt 0 0\nvt 1 0\nvt 0 1\n";
    for (const auto f : ball_.faces.rowwise())
        obj += fmt::format("f {}/1 {}/2 {}/3\n", f[0] + 1, f[1] + 1, f[2] + 1);
    TransferRequest request;
    request.mesh = write("a.obj", obj);
    const std::string text = carry(request, map).at("source_on_target.obj");
    const TriangleMesh mesh = parse_mesh(text, "a.obj");
    EXPECT_EQ(mesh.faces, map.to.faces);
    EXPECT_LT((mesh.vertices - map.to.vertices).norm(), 1e-9);
    EXPECT_THAT(text, HasSubstr(fmt::format("f {}/1 {}/3 {}/2\n", ball_.faces(0, 0) + 1,
                                            ball_.faces(0, 2) + 1, ball_.faces(0, 1) + 1)));
}

TEST_F(Transfer, TellsAnotherOrderFromAnotherMesh) {
    const TriangleMesh other = shapes::shuffled(ball_, 7);
    TransferRequest request;
    request.shapes = {write("c.ply", to_ply(other))};
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("as many vertices and triangles, but in another order"));
}

TEST_F(Transfer, CarriesTheSourcesPolygons) {
    std::string obj = "# SPACE=LPS\nmtllib none.mtl\n";
    for (const auto p : ball_.vertices.rowwise())
        obj += fmt::format("v {} {} {} .5 .5 .5\n", p[0], p[1], p[2]);
    obj += "vn 0 0 1\nvt 0 0\ng head\n";
    for (const auto f : ball_.faces.rowwise())
        obj += fmt::format("f {}/1/1 {}/1/1 {}//1\n", f[0] + 1, f[1] + 1, f[2] + 1);
    write("none.mtl", "newmtl a\n");
    TransferRequest request;
    request.mesh = write("quads.obj", obj);
    Correspondence map = moved_copy(ball_);
    map.to.space = Space::ras;
    const auto files = carry(request, map);
    const std::string& text = files.at("source_on_target.obj");
    EXPECT_THAT(text, HasSubstr("g head"));
    EXPECT_EQ(text.find("vn"), std::string::npos);
    EXPECT_EQ(text.find("/1/1"), std::string::npos);
    const TriangleMesh mesh = parse_mesh(text, "a.obj");
    EXPECT_EQ(mesh.faces, ball_.faces);
    EXPECT_EQ(mesh.space, Space::ras);
    const Points truth = shapes::moved(ball_, 3, 1.2, {1, -2, 3}).vertices;
    EXPECT_LT((mesh.vertices - truth).rowwise().norm().maxCoeff(), 1e-9);
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
