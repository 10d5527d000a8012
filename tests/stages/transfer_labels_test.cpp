#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

#include "fixtures/shapes.h"
#include "fixtures/transfer.h"
#include "stages/transfer/values.h"
#include "varimap/artifact/npy.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_files/ply_columns.h"

namespace varimap {
namespace {

using namespace transfers;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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

/// As NumPy writes words: all as long as the longest, in letters of four bytes, or bytes.
TEST_F(Transfer, LabelsOfNumPyMayBeText) {
    std::string letters, bytes;
    for (int v = 0; v < ball_.vertex_count(); ++v) {
        std::u32string word = v % 2 == 0 ? U"Fu\u00df" : U"Knie";
        word.resize(4);
        letters.append(reinterpret_cast<const char*>(word.data()), 16);
        bytes += v % 3 == 0 ? "leg" : std::string("a\0\0", 3);
    }
    const std::string text = npy_header("<U4", {162}) + letters, ascii = npy_header("|S3", {162}) + bytes;
    EXPECT_EQ(kept_labels("a.npy", text), text);
    EXPECT_EQ(kept_labels("a.npy", ascii), ascii);
    const Correspondence middle = onto_middle(ball_, {.1, .2, .7});
    TransferRequest request;
    request.labels = {write("a.npy", text)};
    const std::string carried = carry(request, middle).at("a.npy");
    const auto word = [&](const std::string& file, int v) {
        return file.substr(file.size() - letters.size() + 16 * std::size_t(v), 16);
    };
    EXPECT_EQ(word(carried, ball_.faces(0, 0)), word(text, ball_.faces(0, 2)));
    request.labels = {write("a.npy", npy_header("|O", {162}) + letters)};
    EXPECT_THAT(refusal(request, middle),
                HasSubstr("a.npy: has items of type |O; save it as integers or text"));
    request = {};
    request.values = {write("a.npy", text)};
    EXPECT_THAT(refusal(request, middle), HasSubstr("a.npy: has items of type <U4; save it as float64"));
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

}  // namespace
}  // namespace varimap
