#include "varimap/landmarks/vertex_list.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "fixtures/temporary_folder.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/logged.h"

namespace varimap {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A strip of triangles over vertices 0 to 9; vertex 10 belongs to no face.
TriangleMesh strip() {
    TriangleMesh mesh{Points(11, 3), Faces(8, 3)};
    for (int v = 0; v < 11; ++v) mesh.vertices.row(v) << v / 2, v % 2, .1 * v;
    for (int f = 0; f < 8; ++f) mesh.faces.row(f) << f, f + 1, f + 2;
    return mesh;
}

/// Matches landmarks by their vertices' numbers.
auto are(const std::vector<std::pair<int, int>>& numbers) {
    VertexPairs<InputVertex> pairs;
    for (const auto& [a, b] : numbers) pairs.emplace_back(InputVertex{a}, InputVertex{b});
    return testing::Eq(pairs);
}

class VertexList : public testing::Test {
  protected:
    std::string write(const std::string& name, const std::string& text) {
        const std::string path = folder_ / name;
        write_file_atomically(path, text);
        return path;
    }
    /// The message of the InputError that reading the pairs or lists throws; empty if it throws none.
    std::string error_of(const std::vector<std::string>& files, const LandmarkReading& reading = {}) {
        try {
            read_landmarks(files, mesh_, mesh_, reading);
            return {};
        } catch (const InputError& error) {
            return error.what();
        }
    }
    TemporaryFolder folder_;
    const TriangleMesh mesh_ = strip();
};

TEST_F(VertexList, SaysWhyAVertexHasNoFace) {
    const std::string pairs = write("a.txt", "1 2\n3 10\n");
    EXPECT_THAT(
        error_of({pairs}),
        HasSubstr("target vertex 10 belongs to no face that is mapped: no face of the file names it"));
    const std::pair<VertexFate, const char*> reasons[] = {
        {VertexFate::unused, "no face of the file names it"},
        {VertexFate::not_finite, "not a number"},
        {VertexFate::faces_dropped, "dropped by the repair"},
        {VertexFate::component_dropped, "its component is left out"},
        {VertexFate::outside_part, "outside of the part"}};
    for (const auto& [fate, reason] : reasons) {
        std::vector<VertexFate> fates(11, VertexFate::kept);
        fates[10] = fate;
        try {
            read_landmarks({pairs}, mesh_, mesh_, {LandmarkSpace::stated}, Repeats::refuse, {}, fates);
            ADD_FAILURE();
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(reason));
        }
    }
}

/// The numbers in a list, which is its own partner.
std::vector<int> vertices_in(const std::string& path, IndexBase base, const TriangleMesh* mesh) {
    std::vector<int> vertices;
    for (const auto& [vertex, partner] : read_vertex_pairs(path, path, base, mesh, mesh)) {
        EXPECT_EQ(vertex, partner);
        vertices.push_back(vertex);
    }
    return vertices;
}

TEST_F(VertexList, ReadsNumbersCommentsAndBlankLines) {
    const auto path = write("a.pinned", "# five\n 3\n\n0 # first\r\n\t7\n");
    EXPECT_THAT(vertices_in(path, IndexBase::automatic, &mesh_), ElementsAre(3, 0, 7));
    EXPECT_THAT(vertices_in(path, IndexBase::zero, nullptr), ElementsAre(3, 0, 7));
}

TEST_F(VertexList, ShiftsWhereNumbersStartAtOne) {
    const auto path = write("a.vts", "1\n8\n");
    EXPECT_THAT(vertices_in(path, IndexBase::one, &mesh_), ElementsAre(0, 7));
}

TEST_F(VertexList, LetsCoordinatesDecideTheBase) {
    const auto zero = write("zero.vts", "2 1 0 0.2\n5 2 1 0.5\n"),
               one = write("one.vts", "3 1 0 .2\n6 2 1 .5\n");
    EXPECT_THAT(vertices_in(zero, IndexBase::automatic, &mesh_), ElementsAre(2, 5));
    EXPECT_THAT(vertices_in(one, IndexBase::automatic, &mesh_), ElementsAre(2, 5));
    EXPECT_THAT(vertices_in(one, IndexBase::zero, &mesh_), ElementsAre(3, 6));
}

TEST_F(VertexList, AVertexThatNoFaceUsesDoesNotBlurCoordinates) {
    TriangleMesh mesh = mesh_;
    mesh.vertices.row(10) << 1e9, 0, 0;
    const auto one = write("one.vts", "3 1 0 .2\n6 2 1 .5\n");
    EXPECT_THAT(vertices_in(one, IndexBase::automatic, &mesh), ElementsAre(2, 5));
}

TEST_F(VertexList, StartsAtZeroWhereCoordinatesSayNothing) {
    const auto path = write("a.vts", "3 0.0 0.0 0.0\n6 0.0 0.0 0.0\n");
    EXPECT_THAT(vertices_in(path, IndexBase::automatic, &mesh_), ElementsAre(3, 6));
}

TEST_F(VertexList, MatchesVerticesByNameWhereAllHaveOne) {
    const auto sources = write("a.csv", "name,vertex\nnose,3\near,0\ntail,7\n"),
               targets = write("b.csv", "name,vertex\ntail,2\nnose,5\n"), rows = write("c.csv", "2\n5\n6\n");
    EXPECT_THAT(read_vertex_pairs(sources, targets, IndexBase::zero, &mesh_, &mesh_),
                ElementsAre(std::pair(3, 5), std::pair(7, 2)));
    EXPECT_THAT(read_vertex_pairs(sources, rows, IndexBase::zero, &mesh_, &mesh_),
                ElementsAre(std::pair(3, 2), std::pair(0, 5), std::pair(7, 6)));
    EXPECT_THROW(read_vertex_pairs(targets, rows, IndexBase::zero, &mesh_, &mesh_), InputError);
}

/// One that was not found shifts those behind it.
TEST_F(VertexList, RefusesEmptyLinesAtDifferentPlaces) {
    const auto full = write("full.txt", "3\n0\n7\n"), third = write("third.txt", "# tips\n3\n0\n\n7\n"),
               second = write("second.txt", "5\n\n6\n2\n");
    EXPECT_EQ(read_vertex_pairs(full, second, IndexBase::zero, &mesh_, &mesh_).size(), 3u);
    EXPECT_EQ(read_vertex_pairs(third, third, IndexBase::zero, &mesh_, &mesh_).size(), 3u);
    try {
        read_vertex_pairs(third, second, IndexBase::zero, &mesh_, &mesh_);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("third.txt:4 and"));
        EXPECT_THAT(error.what(), HasSubstr("second.txt:2: lines without a landmark stand at other places"));
    }
}

TEST_F(VertexList, NamesFileAndLineOfWhatIsWrong) {
    const std::pair<const char*, const char*> cases[] = {
        {"1\nx\n", ":2: 'x' is not a number"},
        {"1 2\n", ":1: expected a vertex number"},
        {"1\n2.5\n", ":2: 2.5 is not a vertex number"},
        {"-1\n", ":1: vertex -1 is out of range"},
        {"1\n11\n", ":2: vertex 11 is out of range: the mesh has 11"},
        {"1 0 inf 0\n", ":1: 'inf' is not a number"},
        {"# nothing\n", "holds no vertices or points"}};
    for (const auto& [text, message] : cases) {
        const auto path = write("bad.txt", text);
        try {
            vertices_in(path, IndexBase::zero, &mesh_);
            ADD_FAILURE() << text;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(path));
            EXPECT_THAT(error.what(), HasSubstr(message));
        }
    }
    EXPECT_THROW(vertices_in(write("one.txt", "0\n"), IndexBase::one, &mesh_), InputError);
    EXPECT_THROW(vertices_in(folder_ / "absent", IndexBase::zero, nullptr), IoError);
}

TEST_F(VertexList, LandmarksCountFromOneWhereThatIsSaid) {
    const auto expected = are({{3, 0}, {5, 9}});
    const LandmarkReading from_1{.base = IndexBase::one};
    EXPECT_THAT(read_landmarks({write("p.txt", "4 1\n6 10\n")}, mesh_, mesh_, from_1).vertices, expected);
    EXPECT_THAT(
        read_landmarks({write("a.txt", "4\n6\n"), write("b.vts", "1\n10\n")}, mesh_, mesh_, from_1).vertices,
        expected);
    EXPECT_THROW(read_landmarks({write("p.txt", "0 1\n6 10\n")}, mesh_, mesh_, from_1), InputError);
    // Coordinates would say 1.
    const auto list = write("one.vts", "3 1 0 .2\n6 2 1 .5\n");
    EXPECT_THAT(read_landmarks({list, list}, mesh_, mesh_, {.base = IndexBase::zero}).vertices,
                are({{3, 3}, {6, 6}}));
}

TEST_F(VertexList, ReadsLandmarksFromPairsOrFromTwoLists) {
    const auto expected = are({{3, 0}, {5, 9}});
    const auto pairs = write("pairs.txt", "# source target\n3 0\n5 9\n");
    EXPECT_THAT(read_landmarks({pairs}, mesh_, mesh_).vertices, expected);
    const auto sources = write("s.pinned", "3\n5\n"), targets = write("t.vts", "1 0 0 0\n10 4 1 .9\n");
    EXPECT_THAT(read_landmarks({sources, targets}, mesh_, mesh_).vertices, expected);
    const auto capitals = write("T.VTS", read_file(targets));
    EXPECT_THAT(read_landmarks({sources, capitals}, mesh_, mesh_).vertices, expected);
    const auto plain = write("t.txt", read_file(targets));
    EXPECT_THAT(read_landmarks({sources, plain}, mesh_, mesh_).vertices, expected);
    EXPECT_THROW(read_landmarks({pairs, pairs, pairs}, mesh_, mesh_), UsageError);
}

TEST_F(VertexList, RefusesLandmarksThatCannotBe) {
    EXPECT_THAT(error_of({write("a", "1 2\n3 4\n1 5\n")}),
                HasSubstr(":3: source vertex 1 is already the landmark of line 1"));
    EXPECT_THAT(error_of({write("a", "1 2\n3 2\n")}), HasSubstr(":2: target vertex 2 is already"));
    // By the numbers of the file, wherever these start.
    const LandmarkReading from_1{.base = IndexBase::one};
    EXPECT_THAT(error_of({write("a", "1 2\n3 2\n")}, from_1), HasSubstr(":2: target vertex 2 is already"));
    EXPECT_THAT(error_of({write("a", "1 11\n")}, from_1),
                HasSubstr(":1: target vertex 11 belongs to no face"));
    EXPECT_THAT(error_of({write("a", "1 2\n3 12\n")}),
                HasSubstr(":2: vertex 12 is out of range: the mesh has 11 vertices"));
    EXPECT_THAT(error_of({write("a", "1 10\n")}),
                HasSubstr(":1: target vertex 10 belongs to no face that is mapped"));
    EXPECT_THAT(error_of({write("a", "1 10\n")}), HasSubstr("no face of the file names it; choose another"));
    EXPECT_THAT(error_of({write("a", "1\n")}), HasSubstr(":1: expected two vertex numbers"));
    EXPECT_THAT(error_of({write("a.csv", "Target,Source\n7,4\n")}),
                HasSubstr(":1: columns have to stand in the order source,target"));
    EXPECT_THAT(error_of({write("a.csv", "z,y,x\n.4,0,2\n"), write("b.csv", "x,y,z\n2,0,.4\n")}),
                HasSubstr("in the order x,y,z"));
    EXPECT_THAT(error_of({write("a", "1\n2\n"), write("b", "1\n")}), HasSubstr("names 2 vertices but"));
}

TEST_F(VertexList, SaysWhereOnlyExchangedColumnsFit) {
    TriangleMesh small = mesh_;
    small.vertices.conservativeResize(5, 3);
    small.faces.conservativeResize(3, 3);
    EXPECT_THAT(read_landmarks({write("a", "9 4\n1 NA\n")}, mesh_, small).vertices, are({{9, 4}}));
    for (const char* text : {"4 9\n1 2\n", "4 9\n1 NA\nNA 2\n"}) try {
            read_landmarks({write("a", text)}, mesh_, small);
            ADD_FAILURE();
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("source and target look exchanged"));
        }
    EXPECT_THAT(error_of({write("a", "1 12\n")}), HasSubstr("vertex 12 is out of range"));
}

TEST_F(VertexList, SnapsRowsOfCoordinatesToTheSurface) {
    // Vertices 4 and 7 of the strip, lifted off it a little, and a point nearest to vertex 2.
    const auto pairs = write("pairs.txt", "2 0 .41 3 1 .7\n1.1 0.05 .2 0 0 0\n");
    EXPECT_THAT(read_landmarks({pairs}, mesh_, mesh_).vertices, are({{4, 7}, {2, 0}}));
    const auto sources = write("a.txt", "2 0 .4\n1 0 .2\n"), targets = write("b.txt", "7\n0\n");
    EXPECT_THAT(read_landmarks({sources, targets}, mesh_, mesh_).vertices, are({{4, 7}, {2, 0}}));
    EXPECT_THAT(error_of({write("bad.txt", "2 0 .4\n1 0\n"), targets}),
                HasSubstr("bad.txt:2: expected the three"));
}

TEST_F(VertexList, KeepsWherePointsWerePicked) {
    const Landmarks landmarks =
        read_landmarks({write("a.txt", "1 0 .2\n"), write("b.txt", "1.7 .3 .37\n")}, mesh_, mesh_);
    ASSERT_EQ(landmarks.points.size(), 1u);
    EXPECT_LT((position(mesh_, landmarks.points[0].first) - Vec3(1, 0, .2)).norm(), 1e-12);
    EXPECT_LT((position(mesh_, landmarks.points[0].second) - Vec3(1.7, .3, .37)).norm(), 1e-12);
    EXPECT_TRUE(read_landmarks({write("v.txt", "4 7\n")}, mesh_, mesh_).points.empty()) << "vertices";
    EXPECT_EQ(read_landmarks({write("c.txt", "4\n"), write("d.txt", "2 0 .4\n")}, mesh_, mesh_).points.size(),
              1u);
}

TEST_F(VertexList, LandmarksArePointsInEveryForm) {
    const PointPairs at_vertices = as_points({{{{4}, {7}}}, {}}, mesh_, mesh_);
    ASSERT_EQ(at_vertices.size(), 1u);
    EXPECT_EQ(position(mesh_, at_vertices[0].first), mesh_.vertex(4));
    EXPECT_EQ(position(mesh_, at_vertices[0].second), mesh_.vertex(7));
    const SurfacePoint picked{2, Vec3(.5, .25, .25)};
    const PointPairs points = as_points({{{{4}, {7}}}, {{picked, picked}}}, mesh_, mesh_);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_EQ(points[0].first.barycentric, picked.barycentric);
}

TEST_F(VertexList, ReadsCommasWhereBlanksAreRead) {
    const auto expected = are({{4, 7}, {2, 0}});
    const auto vertices_of = [&](const std::string& source, const std::string& target) {
        return read_landmarks({write("a.csv", source), write("b.csv", target)}, mesh_, mesh_).vertices;
    };
    const std::string points = "2,0,.4\r\n1,0,.2\r\n", partners = "3, 1, 0.7\n0, 0, 0\n";
    EXPECT_THAT(vertices_of(points, partners), expected);
    EXPECT_THAT(vertices_of("x,y,z\n" + points, "X, Y, Z\n" + partners), expected);
    // Names, first or last, match in any order.
    EXPECT_THAT(
        vertices_of("name,x,y,z\n\"left ear\",2,0,.4\nnose,1,0,.2\n", "0,0,0,nose\n3,1,.7,left ear\n"),
        expected);
    EXPECT_THAT(vertices_of("id,x,y,z\n1,2,0,.4\n2,1,0,.2\n", ",x,y,z\n2,0,0,0\n1,3,1,.7\n"), expected);
    EXPECT_THAT(vertices_of("ear,4\nnose,2\n", "nose,0\near,7\n"), expected);
    EXPECT_THAT(read_landmarks({write("p.csv", "source,target\n4,7\n2,0\n")}, mesh_, mesh_).vertices,
                expected);
    EXPECT_THAT(read_landmarks({write("p.csv", "2,0,.4,3,1,.7\n1,0,.2,0,0,0\n")}, mesh_, mesh_).vertices,
                expected);
    // Vertex numbers from 1 with their coordinates.
    EXPECT_THAT(vertices_of("vertex,x,y,z\n5,2,0,.4\n3,1,0,.2\n", partners), expected);
    EXPECT_TRUE(holds_points(write("h.csv", "name,x,y,z\n1,2,0,.4\n")));
    EXPECT_THAT(vertices_in(write("v.csv", "vertex,x,y,z\n5,2,0,.4\n"), IndexBase::automatic, &mesh_),
                ElementsAre(4));
}

TEST_F(VertexList, ReadsSemicolonsAndTabsWhereTheFirstLineHasThem) {
    const auto partners = write("b.csv", "name;x;y;z\nnose;0;0;0\n\"left; ear\"; 3;1;.7 # tip\n");
    for (const std::string text : {"name;x;y;z\n\"left; ear\";2;0;.4\nnose;1;0;.2\n",
                                   "name\tx\ty\tz\r\nleft; ear\t2\t0\t.4\r\nnose\t1\t0\t.2\t\r\n",
                                   "2\t0\t.4\t\"left; ear\"\n1\t0\t.2\tnose\n"}) {
        const auto source = write("a.csv", text);
        EXPECT_THAT(read_landmarks({source, partners}, mesh_, mesh_).vertices, are({{4, 7}, {2, 0}})) << text;
    }
    // A column without a heading numbers the rows.
    EXPECT_TRUE(holds_points(write("h.csv", "\tx\ty\tz\n1\t2\t0\t.4\n")));
    EXPECT_THAT(read_landmarks({write("p.csv", "source;target\n4;7\n2;0\n")}, mesh_, mesh_).vertices,
                are({{4, 7}, {2, 0}}));
    // Tabs among numbers alone are blanks, as they ever were.
    EXPECT_THAT(read_landmarks({write("p.txt", "4 \t7\n2 0\n")}, mesh_, mesh_).vertices,
                are({{4, 7}, {2, 0}}));
}

TEST_F(VertexList, DecimalsMayHaveCommasWhereOthersSeparate) {
    const auto partners = write("b.csv", "ear;3;1;.7\nnose;0;0;0\n");
    for (const char* text :
         {"name;x;y;z\near;2;0;0,4\nnose;1,0;0;0,2\n", "ear;2,0;0;0,4\nnose;1;0;0,2\n",
          "ear\t2,0\t0\t0,4\nnose\t1\t0\t0,2\n", "ear,2,0,\"0,4\"\nnose,\"1,0\",0,\"0,2\"\n"})
        EXPECT_THAT(read_landmarks({write("a.csv", text), partners}, mesh_, mesh_).vertices,
                    are({{4, 7}, {2, 0}}))
            << text;
    // Two vertices, and three coordinates with a tab behind every comma.
    EXPECT_THAT(read_landmarks({write("p.csv", "4,7\n2,0\n")}, mesh_, mesh_).vertices, are({{4, 7}, {2, 0}}));
    const auto tabs = write("t.csv", "2,\t0,\t.4\n");
    EXPECT_THAT(read_landmarks({tabs, tabs}, mesh_, mesh_).vertices, are({{4, 4}}));
    EXPECT_THAT(error_of({write("c.csv", "nose;0,5;0.5;0\n"), partners}),
                HasSubstr("c.csv:1: some numbers have a decimal comma, others a decimal point"));
    EXPECT_THAT(error_of({write("c.csv", "ear;0,5;0;0\nnose;1.234,5;0;0\n"), partners}),
                HasSubstr("c.csv:2: '1.234,5' is not a number"));
}

TEST_F(VertexList, LandmarksThatOneSurfaceLacksAreLeftOut) {
    const auto left_out = [&](const std::vector<std::string>& files) {
        const std::size_t before = logged_notes().size();
        const Landmarks landmarks = read_landmarks(files, mesh_, mesh_);
        EXPECT_THAT(landmarks.vertices, are({{4, 7}, {2, 0}}));
        EXPECT_GT(landmarks.left_out, 0);
        EXPECT_EQ(logged_notes().size(), before + 1);
        return logged_notes().back();
    };
    const auto partners = write("b.csv", "name,x,y,z\near,3,1,.7\nnose,0,0,0\ntail,4,1,.9\npaw,NA,NA,NA\n");
    for (const char* text :
         {"name,x,y,z\ntail,NA,NA,NA\near,2,0,.4\npaw,4,0,.8\nnose,1,0,.2\n",
          "tail,?,?,?\near,2,0,.4\npaw,4,0,.8\nnose,1,0,.2\n",
          "2;0;.4;ear\n;;;tail\n4;0;.8;paw\n1;0;.2;nose\n", "name,vertex\near,4\npaw,8\ntail,\nnose,2\n"})
        EXPECT_THAT(
            left_out({write("a.csv", text), partners}),
            AllOf(HasSubstr("a.csv and "), HasSubstr("b.csv: 2 landmarks are missing or switched off"),
                  HasSubstr("'tail'"), HasSubstr("'paw'")))
            << text;
    EXPECT_THAT(
        left_out({write("p.txt", "4 7\n5 NA\n2 0\n")}),
        HasSubstr("1 landmark is missing or switched off on one of the surfaces, and left out: line 2"));
    EXPECT_THAT(left_out({write("p.csv", "source,target\n4,7\n,5\n2,0\n")}), HasSubstr("left out: line 3"));
    EXPECT_THAT(left_out({write("p.csv", "2,0,.4,3,1,.7\n4,1,.9,nan,nan,nan\n1,0,.2,0,0,0\n")}),
                HasSubstr("left out: line 2"));
    EXPECT_THAT(left_out({write("c.txt", "4\nNA\n2\n"), write("d.txt", "7\n5\n0\n")}),
                HasSubstr("left out: line 2"));
    EXPECT_THAT(error_of({write("p.txt", "4 NA\nNA 5\n")}),
                HasSubstr("no landmark is there on both surfaces"));
    EXPECT_THAT(error_of({write("c.txt", "NA NA NA\n"), partners}),
                HasSubstr("c.txt: all of its landmarks are missing"));
    const auto list = write("e.csv", "ear,4\nnose,NA\n");
    EXPECT_EQ(read_placed_landmarks(list, mesh_, {}).size(), 1u);
    EXPECT_THAT(logged_warnings().back(), HasSubstr("e.csv: 1 of 2 landmarks are missing or switched off"));
    EXPECT_THAT(read_vertex_pairs(list, list, IndexBase::zero, &mesh_, &mesh_), ElementsAre(std::pair(4, 4)));
}

TEST_F(VertexList, RefusesCommasThatDoNotSeparateNumbers) {
    const auto targets = write("b.txt", "7\n0\n");
    const std::pair<const char*, const char*> cases[] = {
        {"2,0,.4\n1,zero,.2\n", "bad.csv:2: 'zero' is not a number"},
        {"2,0,.4\n1,0\n", "bad.csv:2: expected the three"},
        {"2,0,.4\nx,y,z\n", "bad.csv:2: 'y' is not a number"},
        {"0,5 1,2 3,4\n", "bad.csv:1: '5 1' is not a number; where decimals have commas, semicolons or tabs"},
        {"x,y,z\n", "bad.csv: holds no vertices or points"}};
    for (const auto& [text, message] : cases)
        EXPECT_THAT(error_of({write("bad.csv", text), targets}), HasSubstr(message)) << text;
}

TEST_F(VertexList, SaysWhereRowsHaveOtherNames) {
    const auto list = [&](const char* file, const char* a, const char* b, const char* c) {
        return write(file, fmt::format(R"({{"markups": [{{"type": "Fiducial", "controlPoints": [
            {{"label": "{}", "position": [1, 0, 0.2]}}, {{"label": "{}", "position": [2, 0, 0.4]}},
            {{"label": "{}", "position": [3, 1, 0.7]}}]}}]}})",
                                       a, b, c));
    };
    const auto twice = list("twice.mrk.json", "nose", "nose", "ear");
    const std::size_t before = logged_warnings().size();
    read_landmarks({twice, twice}, mesh_, mesh_);
    EXPECT_EQ(logged_warnings().size(), before);
    read_landmarks({list("once.mrk.json", "nose", "ear", "tail"), twice}, mesh_, mesh_);
    ASSERT_EQ(logged_warnings().size(), before + 1);
    EXPECT_THAT(logged_warnings().back(), HasSubstr("row 2 is 'ear' and 'nose'"));
}

TEST_F(VertexList, CountsThePointsOfJson) {
    const auto json = write("a.mrk.json", R"({"markups": [{"type": "Fiducial", "controlPoints": [
        {"label": "nose", "position": [1, 0, 0.2]}, {"label": "ear", "position": [1, 0, 0.2]}]}]})");
    EXPECT_THAT(error_of({json, json}),
                HasSubstr("a.mrk.json: point 2: source vertex 2 is already the landmark of point 1"));
}

TEST_F(VertexList, KnownPartnersMayRepeatAVertex) {
    const auto pairs = write("a", "1 2\n3 2\n");
    const auto found = read_landmarks({pairs}, mesh_, mesh_, {LandmarkSpace::stated}, Repeats::allow);
    EXPECT_THAT(found.vertices, are({{1, 2}, {3, 2}}));
}

TEST_F(VertexList, MatchesPickedPointsByName) {
    const auto meshlab =
        write("a.pp",
              "<!DOCTYPE PickedPoints>\n<PickedPoints>\n <DocumentData/>\n"
              " <point x=\"2\" y=\"0\" z=\".4\" name=\"nose\" active=\"1\"/>\n"
              " <point name=\"tail\" active=\"1\" z=\".7\" y=\"1\" x=\"3\"/>\n"
              " <point x=\"0\" y=\"0\" z=\"0\" name=\"off\" active=\"0\"/>\n</PickedPoints>\n");
    const auto slicer = write("b.mrk.json", R"({"markups": [{"type": "Fiducial", "controlPoints": [
        {"label": "ear", "position": [0, 0, 0]}, {"label": "tail", "position": [1, 0, 0.2]},
        {"label": "nose", "position": [4, 1, 0.9]}]}]})");
    const auto old_slicer = write("c.fcsv",
                                  "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n"
                                  "1,1,0,.2,0,0,0,1,1,1,0,tail,,\r\n2,0,1,.1,0,0,0,1,1,1,0,nose,,\n");
    EXPECT_THAT(read_landmarks({meshlab, slicer}, mesh_, mesh_).vertices, are({{4, 9}, {7, 2}}));
    EXPECT_THAT(logged_notes().back(), HasSubstr("left out are 'ear', 'off'"));
    EXPECT_EQ(read_landmarks({meshlab, slicer}, mesh_, mesh_).left_out, 2);
    EXPECT_THAT(read_landmarks({meshlab, old_slicer}, mesh_, mesh_).vertices, are({{4, 1}, {7, 2}}));
    const auto capitals = write("C.FCSV", read_file(old_slicer));
    EXPECT_THAT(read_landmarks({meshlab, capitals}, mesh_, mesh_).vertices, are({{4, 1}, {7, 2}}));
    EXPECT_THAT(error_of({meshlab, write("other.fcsv", "1,0,0,0,0,0,0,1,1,1,0,paw,,\n")}),
                HasSubstr("no name in common"));
    EXPECT_THROW(read_landmarks({meshlab}, mesh_, mesh_), UsageError);
}

TEST_F(VertexList, ReadsPickedPointsHoweverTheirXmlIsWritten) {
    const auto meshlab = write("a.pp",
                               "<PickedPoints>\n<!-- <point x=\"0\" y=\"0\" z=\"0\" name=\"old\"/> -->\n"
                               "<point\n  x = '2' y='0'\tz=\".4\" name=\"a > b\"/>\n"
                               "<point x='0' y='0' z='0' name='off' active = '0'/>\n"
                               "<pointless x='1'/><point x=\"3\" name='x=\"9\"' y=\"1\" z=\".7\"></point>\n");
    const auto points = read_picked_points(meshlab);
    ASSERT_EQ(points.size(), 3u);
    EXPECT_EQ(points[0].position, Vec3(2, 0, .4));
    EXPECT_EQ(points[0].name, "a > b");
    EXPECT_EQ(points[0].line, 3);
    EXPECT_FALSE(points[1].defined);
    EXPECT_EQ(points[2].position, Vec3(3, 1, .7));
    EXPECT_EQ(points[2].line, 6);
    EXPECT_THAT(read_landmarks({meshlab, meshlab}, mesh_, mesh_).vertices, are({{4, 4}, {7, 7}}));
    EXPECT_THAT(logged_notes().back(), HasSubstr("1 landmark is missing or switched off"));
}

TEST_F(VertexList, NamesInQuotesMayHoldCommas) {
    const auto source = write("a.csv", "name,x,y,z\n\"tip, left\",2,0,.4\n\"the \"\"nose\"\"\",1,0,.2\n");
    const auto target = write("b.csv", "0,0,0, \"the \"\"nose\"\"\"\n3,1,.7,\"tip, left\" \n");
    EXPECT_THAT(read_landmarks({source, target}, mesh_, mesh_).vertices, are({{4, 7}, {2, 0}}));
    const auto slicer_file = write("c.fcsv",
                                   "# CoordinateSystem = LPS\n1,3,1,.7,0,0,0,1,1,1,0,\"tip, left\",,\r\n"
                                   "2,0,0,0,0,0,0,1,1,1,0,\"the \"\"nose\"\"\",,\n");
    EXPECT_THAT(read_landmarks({source, slicer_file}, mesh_, mesh_).vertices, are({{4, 7}, {2, 0}}));
    for (const char* row : {"\"tip, left,2,0,.4\n", "\"tip, #1\",2,0,.4\n", "\"tip\" left,2,0,.4\n"})
        EXPECT_THAT(error_of({write("bad.csv", row), target}), HasSubstr("bad.csv:1: a quote has no end"));
}

TEST_F(VertexList, RefusesDamagedFilesOfPickedPoints) {
    const auto good = write("good.fcsv", "1,1,0,.2\n");
    EXPECT_THAT(error_of({write("a.pp", "<PickedPoints>\n<point x=\"1\" y=\"2\"/>\n"), good}),
                HasSubstr("a.pp:2: a point without"));
    EXPECT_THAT(error_of({write("b.pp", "<point x=\"1\" y=\"2\" z=\"high\"/>"), good}),
                HasSubstr("'high' is not a coordinate"));
    EXPECT_THAT(error_of({write("c.pp", ""), good}), HasSubstr("c.pp: holds no points"));
    EXPECT_THAT(error_of({write("d.json", "{\"markups\": 3"), good}),
                HasSubstr("is not a 3D Slicer markups file"));
    EXPECT_THAT(error_of({write("e.fcsv", "1,2\n"), good}), HasSubstr("e.fcsv:1: expected id,x,y,z"));
}

/// A markups file of 3D Slicer; `status` is that of its second point.
std::string slicer(const std::string& space, const std::vector<Vec3>& points,
                   const std::string& status = "defined") {
    nlohmann::json controls;
    for (std::size_t i = 0; i < points.size(); ++i)
        controls.push_back({{"label", fmt::format("p{}", i)},
                            {"position", {points[i][0], points[i][1], points[i][2]}},
                            {"positionStatus", i == 1 ? status : "defined"}});
    return nlohmann::json{{"markups", {{{"coordinateSystem", space}, {"controlPoints", controls}}}}}.dump();
}

const std::vector<Vec3> picked{{2, 0, .4}, {3, 1, .7}, {4, 1, .9}};
const std::vector<Vec3> negated{{-2, 0, .4}, {-3, -1, .7}, {-4, -1, .9}};

TEST_F(VertexList, HonoursTheAxesThatFilesState) {
    const auto expected = are({{4, 4}, {7, 7}, {9, 9}});
    const auto lps = write("a.mrk.json", slicer("LPS", picked)),
               ras = write("b.mrk.json", slicer("RAS", negated));
    EXPECT_THAT(read_landmarks({lps, ras}, mesh_, mesh_).vertices, expected) << "a mesh without axes is LPS";
    TriangleMesh in_ras = mesh_;
    in_ras.space = Space::ras;
    const auto straight = write("c.mrk.json", slicer("RAS", picked));
    EXPECT_THAT(read_landmarks({lps, straight}, mesh_, in_ras).vertices, expected);
    for (const char* word : {"RAS", "0"}) {
        std::string text = fmt::format("# Markups version = 4.10\n# CoordinateSystem = {}\n", word);
        for (std::size_t i = 0; i < 3; ++i)
            text +=
                fmt::format("n,{},{},{},0,0,0,1,1,1,0,p{}\n", negated[i][0], negated[i][1], negated[i][2], i);
        EXPECT_THAT(read_landmarks({lps, write("d.fcsv", text)}, mesh_, mesh_).vertices, expected) << word;
    }
    EXPECT_THAT(error_of({lps, write("e.fcsv", "# CoordinateSystem = IJK\n1,0,0,0\n")}), HasSubstr("'IJK'"));
}

TEST_F(VertexList, TheUserKnowsTheAxesBetter) {
    const auto expected = are({{4, 4}, {7, 7}, {9, 9}});
    const auto wrong = write("a.mrk.json", slicer("RAS", picked));
    EXPECT_THAT(read_landmarks({wrong, wrong}, mesh_, mesh_, {LandmarkSpace::as_is}).vertices, expected);
    EXPECT_THAT(read_landmarks({wrong, wrong}, mesh_, mesh_, {LandmarkSpace::lps}).vertices, expected);
    const auto rows = write("b.txt", "-2 0 .4\n-3 -1 .7\n-4 -1 .9\n");
    EXPECT_THAT(read_landmarks({rows, rows}, mesh_, mesh_, {LandmarkSpace::ras}).vertices, expected);
}

TEST_F(VertexList, NamesTheLikelyCauseWhereMostPointsLieFarFromTheSurface) {
    const auto good = write("good.txt", "2 0 .4\n3 1 .7\n4 1 .9\n");
    const auto complaint = [&](const std::function<Vec3(Vec3)>& change) {
        std::string rows;
        for (const Vec3& p : picked) {
            const Vec3 q = change(p);
            rows += fmt::format("{} {} {}\n", q[0], q[1], q[2]);
        }
        return error_of({good, write("far.txt", rows)});
    };
    EXPECT_EQ(complaint([](const Vec3& p) { return p; }), "");
    EXPECT_THAT(
        complaint([](const Vec3& p) { return Vec3(-p[0], -p[1], p[2]); }),
        AllOf(HasSubstr("far.txt:3: 3 of 3 landmarks lie farther than 0.02 from the surface, the farthest "),
              HasSubstr("RAS for LPS"), HasSubstr("--landmark-space")));
    EXPECT_THAT(complaint([](const Vec3& p) { return Vec3(1000 * p); }), HasSubstr("0.001 times"));
    EXPECT_THAT(complaint([](const Vec3& p) { return Vec3(p[1], p[2], p[0]); }),
                HasSubstr("z x y for x y z"));
    EXPECT_THAT(complaint([](const Vec3& p) { return Vec3(p + Vec3(50, 60, 71)); }),
                HasSubstr("another mesh"));
    EXPECT_THAT(complaint([](const Vec3& p) { return Vec3(1e155 * p); }), HasSubstr("far.txt:3: 3 of 3"));
}

TEST_F(VertexList, PointsThatAreNotDefinedAreLeftOutWithTheirPartners) {
    const auto all = write("a.mrk.json", slicer("LPS", picked));
    const auto named = write("b.mrk.json", slicer("LPS", picked, "undefined"));
    EXPECT_THAT(read_landmarks({all, named}, mesh_, mesh_).vertices, are({{4, 4}, {9, 9}}));
    const auto rows = write("c.txt", "2 0 .4\n3 1 .7\n4 1 .9\n");
    EXPECT_THAT(read_landmarks({rows, named}, mesh_, mesh_).vertices, are({{4, 4}, {9, 9}}));
    const auto none =
        write("d.mrk.json", R"({"markups": [{"controlPoints": [{"positionStatus": "undefined"}]}]})");
    EXPECT_THAT(error_of({none, none}), HasSubstr("all of its landmarks are missing or switched off"));
}

TEST_F(VertexList, ReadsLandmarkEditorsFiles) {
    const auto source = write("a.pts", "Version 1.0\r\n3\r\nS000 2 0 .4\r\nS001 3 1 .7\r\nC000 1 0 .2\r\n");
    const auto target =
        write("b.pts", "Version 1.0\n3\nS000 3 1 0.7\nS001 9999.0 9999.0 9999.0\nC000 0 0 0\n");
    EXPECT_THAT(read_landmarks({source, target}, mesh_, mesh_).vertices, are({{4, 7}, {2, 0}}));
    EXPECT_THAT(logged_notes().back(), HasSubstr("left out: 'S001'"));
    EXPECT_THAT(error_of({write("c.pts", "Version 1.0\n1\n2 0 .4\n"), target}),
                HasSubstr("c.pts:3: expected a name and x y z"));
    EXPECT_THAT(read_landmarks({write("d.pts", "4\n2\n"), write("e.pts", "7\n0\n")}, mesh_, mesh_).vertices,
                are({{4, 7}, {2, 0}}));  // lists of vertices
    EXPECT_THAT(error_of({write("c.pts", "Points\n4\n7\n"), target}),
                HasSubstr("does not begin as Landmark Editor's"));
    for (const char* name : {"a.tps", "a.dta"})
        EXPECT_THAT(error_of({write(name, "LM3=1\n2 0 .4\nID=1\n"), target}),
                    HasSubstr("save the landmarks of each specimen as a .csv"));
}

}  // namespace
}  // namespace varimap
