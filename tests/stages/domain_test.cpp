#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "fixtures/temporary_folder.h"
#include "stages/domain/make_domain.h"
#include "varimap/core/error.h"
#include "varimap/geodesics/geodesic_coordinates.h"
#include "varimap/spectral/eigenbasis.h"
#include "varimap/spectral/hierarchy.h"
#include "varimap/spectral/laplacian.h"

namespace varimap {
namespace {

using testing::HasSubstr;

class DomainFiles : public testing::Test {
  protected:
    std::string write(const std::string& name, const std::string& text) {
        const std::string path = folder_ / name;
        std::ofstream(path) << text;
        return path;
    }
    Domain make(const std::string& name, const std::string& text, const DomainParams& params = {}) {
        const std::string path = write(name, text);
        return make_domain(read_domain_file(path, params.kind), params, path);
    }
    std::string refusal(const std::string& name, const std::string& text, const DomainParams& params = {}) {
        try {
            make(name, text, params);
        } catch (const Error& error) {
            return error.what();
        }
        return "none";
    }

    TemporaryFolder folder_;
};

DomainParams polyline() {
    DomainParams params;
    params.kind = DomainKind::polyline;
    return params;
}

std::string line_of(int points) {
    std::string text = "x,y\n";
    for (int i = 0; i < points; ++i) text += std::to_string(i * i) + ", 0\n";
    return text;
}

TEST_F(DomainFiles, AnOpenCurveHasItsArcLengthAsCoordinateAndHalfLengthsAsMasses) {
    const Domain bent = make("bent.xyz", "0 0\n1 0\n1 2\n0 2\n-3 2\n", polyline());
    ASSERT_EQ(bent.coordinates.cols(), 1);
    ASSERT_EQ(bent.edges.size(), 4u);
    const double along = bent.coordinates(4, 0) - bent.coordinates(0, 0);
    const double scale = std::abs(along) / 7;  // of the file's lengths
    double length = 0;
    for (int i = 1; i < 5; ++i) {
        length += bent.edges[std::size_t(i - 1)].length;
        EXPECT_NEAR(std::abs(bent.coordinates(i, 0) - bent.coordinates(0, 0)), length, 1e-9);
    }
    EXPECT_NEAR(bent.edges[3].length, 3 * scale, 1e-9);
    EXPECT_NEAR(bent.mass[0], .5 / 7, 1e-12);
    EXPECT_NEAR(bent.mass[1], 1.5 / 7, 1e-12);
    EXPECT_NEAR(bent.mass.sum(), 1, 1e-12);
    const double extent = std::sqrt(bent.mass.dot(bent.coordinates.rowwise().squaredNorm()));
    EXPECT_NEAR(extent, 1 / std::sqrt(4 * M_PI), 1e-12);
}

TEST_F(DomainFiles, ACurveWhoseLastPointIsItsFirstIsClosed) {
    const Domain square = make("square.xyz", "0 0\n1 0\n1 1\n0 1\n0 0\n", polyline());
    EXPECT_EQ(square.mass.size(), 4);
    EXPECT_EQ(square.edges.size(), 4u);
    EXPECT_NEAR((square.mass.array() - .25).abs().maxCoeff(), 0, 1e-12);
}

TEST_F(DomainFiles, ObjLinesArePolylines) {
    const Domain y =
        make("y.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 0 1\nl 1 2 3\nl -3 -1\nl 2 1\n");  // one edge twice
    EXPECT_EQ(y.mass.size(), 4);
    EXPECT_EQ(y.edges.size(), 3u);
}

TEST_F(DomainFiles, EdgesAndMatrixMarketGiveTheSameGraph) {
    const Domain list = make("a.edges", "# ring\n0 1 2\n1 2 2\n2 3 4\n3 0 1\n1 0 2\n");
    const Domain matrix = make("b.mtx",
                               "%%MatrixMarket matrix coordinate real symmetric\n% a ring\n4 4 5\n2 1 2\n3 2 "
                               "2\n4 3 4\n4 1 1\n1 1 9\n");
    EXPECT_EQ(encode(list), encode(matrix));
    ASSERT_EQ(list.edges.size(), 4u);
    EXPECT_NEAR(list.edges[1].length / list.edges[0].length, 2, 1e-12);  // 0 3 of weight 1, 0 1 of weight 2
    DomainParams lengths;
    lengths.weights = EdgeWeights::length;
    const Domain other = make("c.edges", "0 1 2\n1 2 2\n2 3 4\n3 0 1\n", lengths);
    EXPECT_NEAR(other.edges[1].length / other.edges[0].length, .5, 1e-12);
}

TEST_F(DomainFiles, ARowOfNamesTellsWhichColumnsAreCoordinates) {
    const Domain plain = make("a.csv", "0,0\n1,0\n1,2\n0,3\n");
    EXPECT_EQ(encode(make("b.csv", "id,X,\"y\"\n0,0,0\n1,1,0\n2,1,2\n3,0,3\n")), encode(plain));
    EXPECT_EQ(encode(make("c.csv", "name;y;x;z\na;0;0;0\nb;0;1;0\nc;2;1;0\nd;3;0;0\n")), encode(plain));
    EXPECT_EQ(encode(make("d.csv", "lon,lat\n0,0\n1,0\n1,2\n0,3\n")), encode(plain));
    // The first column of a table often has no name.
    EXPECT_THAT(refusal("e.csv", ",x,y\n0,0,0\n1,1,0\n2,1,2\n3,0,3\n"),
                HasSubstr("e.csv:2: 3 values, where the first row names 2"));
}

/// The vertices, not the lines that say how many there are.
TEST_F(DomainFiles, PointsMayBeThoseOfAMeshOrACloud) {
    DomainParams points;
    points.kind = DomainKind::points;
    const Domain plain = make("a.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 2 3\n");
    const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 2 3\n";
    EXPECT_EQ(encode(make("b.off", "OFF\n5 0 0\n" + vertices)), encode(plain));
    EXPECT_EQ(encode(make("c.off", "OFF\n5 1 0\n" + vertices + "3 0 1 2\n", points)), encode(plain));
    EXPECT_EQ(encode(make("d.ply",
                          "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\n"
                          "property double z\nend_header\n" +
                              vertices)),
              encode(plain));
    EXPECT_THAT(refusal("nan.off", "OFF\n5 0 0\n0 0 0\n1 0 0\n0 1 0\nnan 0 1\n1 2 3\n"),
                HasSubstr("point 3 (from 0) is not finite"));
}

TEST_F(DomainFiles, AGeneralMatrixHasEqualHalves) {
    const std::string head = "%%MatrixMarket matrix coordinate real general\n";
    const std::string half = "2 1 1\n3 2 1\n4 3 1\n1 1 9\n";
    const Domain list = make("a.edges", "0 1\n1 2\n2 3\n");
    EXPECT_EQ(encode(make("b.mtx", head + "4 4 7\n" + half + "1 2 1\n2 3 1\n3 4 1\n")), encode(list));
    EXPECT_THAT(refusal("c.mtx", head + "4 4 6\n" + half + "1 2 1\n2 3 1\n"),
                HasSubstr("an entry at 4 3 (from 1), but none at 3 4"));
    EXPECT_THAT(refusal("d.mtx", head + "4 4 7\n" + half + "1 2 1\n2 3 2\n3 4 1\n"),
                HasSubstr("has weight 2 here and 1 before"));
}

TEST_F(DomainFiles, AMeshIsAGraphOfItsEdges) {
    DomainParams params;
    params.kind = DomainKind::graph;
    const Domain wires =
        make("tetrahedron.off",
             "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n", params);
    EXPECT_EQ(wires.edges.size(), 6u);
    EXPECT_FALSE(wires.is_surface());
}

TEST_F(DomainFiles, AmbientDistancesJoinWhatIsNearInSpace) {
    DomainParams params = polyline();
    params.neighbours = 2;
    const std::string hairpin = "0 0\n1 0\n2 0\n3 0\n3 .1\n2 .1\n1 .1\n0 .1\n";
    EXPECT_EQ(make("pin.xyz", hairpin, params).edges.size(), 7u);
    params.distances = Distances::ambient;
    const Domain ambient = make("pin.xyz", hairpin, params);
    EXPECT_GT(ambient.edges.size(), 7u);
    EXPECT_EQ(ambient.coordinates.size(), 0);
}

TEST_F(DomainFiles, LaplaciansHaveRowSumsOfZeroAndLevelsReachEveryPoint) {
    const Domain line = make("line.xyz", line_of(40), polyline());
    const Eigen::VectorXd sums = laplacian(line) * Eigen::VectorXd::Ones(40);
    EXPECT_LT(sums.cwiseAbs().maxCoeff(), 1e-9);
    const Basis basis = compute_eigenbasis(line, {});
    const Hierarchy hierarchy = build_hierarchy(line, basis, {});
    EXPECT_EQ(hierarchy.levels.back().samples.size(), 40u);
    EXPECT_EQ(hierarchy.shape.descriptors.rows(), 40);
    EXPECT_TRUE(hierarchy.shape.descriptors.isZero(0));
}

TEST_F(DomainFiles, ArtifactsComeBackAsTheyWere) {
    const Domain line = make("line.xyz", line_of(12), polyline());
    Domain back;
    decode(encode(line), back);
    EXPECT_EQ(encode(back), encode(line));
    EXPECT_EQ(back.coordinates, line.coordinates);
    back.edges.pop_back();  // of two parts
    Domain bad;
    EXPECT_THROW(decode(encode(back), bad), ArtifactError);
}

TEST_F(DomainFiles, BadInputIsRefusedInOneLineThatNamesIt) {
    EXPECT_THAT(refusal("two.edges", "0 1\n1 2\n2 0\n3 4\n"), HasSubstr("falls into 2 parts: point 3"));
    EXPECT_THAT(refusal("far.edges", "0 1\n1 2\n2 999999\n"),
                HasSubstr("3 edges cannot join 1000000 points"));
    EXPECT_THAT(refusal("tiny.edges", "0 1 1\n1 2 1\n2 3 1e-300\n"), HasSubstr("times as long"));
    EXPECT_THAT(refusal("negative.edges", "0 1 1\n1 2 -3\n"), HasSubstr("negative.edges:2: the weight -3"));
    EXPECT_THAT(refusal("zero.edges", "0 1 0\n"), HasSubstr("not positive"));
    EXPECT_THAT(refusal("differ.edges", "0 1 1\n1 0 2\n"), HasSubstr("has weight 2 here and 1 before"));
    EXPECT_THAT(refusal("nan.edges", "0 1 nan\n"), HasSubstr("nan.edges:1: weight nan is not finite"));
    EXPECT_THAT(refusal("nan.xyz", "0 0 0\n1 0 0\nnan 0 0\n"), HasSubstr("nan.xyz:3: coordinate nan"));
    EXPECT_THAT(refusal("same.xyz", "0 0\n1 0\n1 1\n0 0\n3 3\n"), HasSubstr("points 0 and 3"));
    EXPECT_THAT(refusal("same.xyz", "0 0\n1 0\n1 0\n0 1\n3 3\n", polyline()), HasSubstr("points 1 and 2"));
    EXPECT_THAT(refusal("one.xyz", "1 2 3\n"), HasSubstr("1 point; at least 4"));
    EXPECT_THAT(refusal("none.xyz", "x y z\n"), HasSubstr("0 points; at least 4"));
    EXPECT_THAT(refusal("columns.xyz", "0 0 0\n1 1\n"), HasSubstr("columns.xyz:2: 2 coordinates"));
    EXPECT_THAT(refusal("words.xyz", "0 0 0\n1 one 0\n"), HasSubstr("words.xyz:2"));
    EXPECT_THAT(refusal("far.edges", "0 1\n1 99999999999\n"), HasSubstr("there is no point 99999999999"));
    EXPECT_THAT(refusal("cut.mtx", "%%MatrixMarket matrix coordinate real symmetric\n4 4 3\n2 1 1\n"),
                HasSubstr("1 entries, where its head promises 3"));
    EXPECT_THAT(refusal("array.mtx", "%%MatrixMarket matrix array real general\n2 2\n"),
                HasSubstr("array.mtx:1"));
    EXPECT_THAT(refusal("no_lines.obj", "v 0 0 0\nv 1 0 0\n"), HasSubstr("has no lines"));
    DomainParams ambient;
    ambient.distances = Distances::ambient;
    EXPECT_THAT(refusal("a.edges", "0 1\n1 2\n2 3\n", ambient), HasSubstr("--positions"));
}

TEST(GeodesicCoordinates, OfATreeKeepDistancesAlongItWithinALittle) {
    Domain path;
    path.mesh.vertices = Points::Zero(600, 3);
    for (int i = 1; i < 600; ++i) path.edges.push_back({i - 1, i, 1.0 + i % 3, 1});
    const GeodesicGraph graph(path);
    const RowMatrix x = geodesic_coordinates(graph, 4);
    double length = 0;
    for (const DomainEdge& edge : path.edges) {
        length += edge.length;
        EXPECT_NEAR((x.row(edge.b) - x.row(0)).norm(), length, 1e-6 * length);
    }
}

}  // namespace
}  // namespace varimap
