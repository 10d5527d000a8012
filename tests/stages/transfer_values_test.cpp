#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <sstream>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fixtures/transfer.h"
#include "stages/transfer/values.h"
#include "varimap/artifact/npy.h"
#include "varimap/core/error.h"
#include "varimap/core/logged.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_files/ply_columns.h"

namespace varimap {
namespace {

using namespace transfers;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Largest y^2 + z^2, the squared gradient of y z.
double truth_radius(const TriangleMesh& mesh) {
    return mesh.vertices.rightCols<2>().rowwise().squaredNorm().maxCoeff();
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

}  // namespace
}  // namespace varimap
