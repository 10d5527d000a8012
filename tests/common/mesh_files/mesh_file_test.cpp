#include "varimap/mesh_files/mesh_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <clocale>
#include <filesystem>
#include <fstream>

#include "fixtures/shapes.h"
#include "fixtures/temporary_folder.h"
#include "varimap/core/error.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh_files/obj_model.h"

namespace varimap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class MeshFile : public ::testing::Test {
  protected:
    TriangleMesh read(const std::string& name, const std::string& bytes) {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return read_mesh(folder_ / name);
    }
    /// The one line of the InputError; empty if there was none.
    std::string complaint(const std::string& name, const std::string& bytes) {
        try {
            read(name, bytes);
            return "";
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            EXPECT_THAT(error.what(), HasSubstr(name));
            return error.what();
        }
    }
    TemporaryFolder folder_;
};

template <class T>
std::string raw_bytes(const T& value, bool reversed = false) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    return reversed ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

std::string off(const TriangleMesh& mesh) {
    std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.face_count());
    for (int v = 0; v < mesh.vertex_count(); ++v)
        text += fmt::format("{} {} {}\n", mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2));
    for (int f = 0; f < mesh.face_count(); ++f)
        text += fmt::format("3 {} {} {}\n", mesh.faces(f, 0), mesh.faces(f, 1), mesh.faces(f, 2));
    return text;
}

std::string binary_stl(const TriangleMesh& mesh) {
    std::string bytes("solid but binary all the same");
    bytes.resize(80);
    bytes += raw_bytes(mesh.face_count());
    for (int f = 0; f < mesh.face_count(); ++f) {
        bytes.append(12, '\0');
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < 3; ++i) bytes += raw_bytes(float(mesh.vertices(mesh.faces(f, c), i)));
        bytes.append(2, '\0');
    }
    return bytes;
}

void expect_equal(const TriangleMesh& a, const TriangleMesh& b) {
    ASSERT_EQ(a.vertex_count(), b.vertex_count());
    EXPECT_TRUE(a.vertices == b.vertices);
    ASSERT_EQ(a.face_count(), b.face_count());
    EXPECT_TRUE(a.faces == b.faces);
}

/// A square with a corner pushed in (v4), named from each corner in turn: fans from two of them fold.
TEST_F(MeshFile, CutsConcavePolygonsWithoutFolds) {
    const std::string points = "v 0 0 3\nv 1 0 3\nv 1 1 3\nv .5 .9 3\nv 0 1 3\nv .6 .5 3\n";
    const std::vector<int> corners{1, 2, 3, 4, 5};
    for (std::size_t first = 0; first < corners.size(); ++first) {
        std::string face = "f";
        for (std::size_t k = 0; k < corners.size(); ++k)
            face += fmt::format(" {}", corners[(first + k) % corners.size()]);
        const TriangleMesh mesh = read("a.obj", points + face + "\nf 1 2 6\n");
        ASSERT_EQ(mesh.face_count(), 4);
        double area = 0;
        for (int f = 0; f < 3; ++f) {
            EXPECT_GT(face_normal(mesh, f).z(), 0) << face;
            area += face_normal(mesh, f).norm() / 2;
        }
        EXPECT_NEAR(area, .95, 1e-12);
        EXPECT_EQ(mesh.faces.row(3), Eigen::RowVector3i(0, 1, 5));
    }
}

/// A comb of many teeth, which no corner sees whole.
TEST_F(MeshFile, CutsEarsOfCombs) {
    constexpr int teeth = 50;
    std::string text = fmt::format("v 0 -1 0\nv {} -1 0\n", teeth), face = "f 1 2";
    for (int k = 2 * teeth; k >= 0; --k) {
        text += fmt::format("v {} {} 0\n", k / 2., k % 2);
        face += fmt::format(" {}", 2 * teeth - k + 3);
    }
    const TriangleMesh mesh = read("a.obj", text + face + "\n");
    double area = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        EXPECT_GT(face_normal(mesh, f).z(), 0);
        area += face_normal(mesh, f).norm() / 2;
    }
    EXPECT_NEAR(area, 1.5 * teeth, 1e-9);
}

/// What crosses itself, has no area or corners that are not numbers is fanned.
TEST_F(MeshFile, FansWhatHasNoInside) {
    for (const char* const points :
         {"v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\n", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\n",
          "v 0 0 0\nv nan 1 0\nv 1 0 0\nv 0 1 0\n", "v 0 0 0\nv 1 0 0\nv 0 0 0\nv 1 0 0\n"}) {
        const TriangleMesh mesh = read("a.obj", std::string(points) + "f 1 2 3 4\n");
        EXPECT_EQ(mesh.faces, (Faces{{0, 1, 2}, {0, 2, 3}})) << points;
    }
}

const char* const square_obj = "v 0.1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

TriangleMesh square_mesh() {
    return shapes::make_mesh({{.1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

TEST_F(MeshFile, ObjVariants) {
    expect_equal(read("a.obj", square_obj), square_mesh());
    expect_equal(read("A.OBJ", square_obj), square_mesh());
    expect_equal(read("a.obj",
                      "# comment\r\nmtllib x\r\nvn 0 0 1\r\nv .1 0 0 1 0 0\r\n v\t1 0 0 .5 .5 .5\r\n\r\n"
                      "v 1 +1 0e0\r\nv 0 1 0 # last\r\nusemtl y\r\ns off\r\nf 1//2 2/7/3 \\\r\n 3/1 4 # end"),
                 square_mesh());
    expect_equal(read("a.obj", "v .1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1\n"), square_mesh());
}

TEST_F(MeshFile, OffVariants) {
    expect_equal(read("a.off", "OFF\n4 1 0\n.1 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"), square_mesh());
    expect_equal(read("a.Off", "OFF 4 1 0\n.1 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3"), square_mesh());
    expect_equal(read("a.off", "4 1\n.1 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3"), square_mesh());
    expect_equal(read("a.off",
                      "COFF # coloured\r\n# comment\r\n4 1 0\r\n\r\n.1 0 0 255 0 0 255\r\n1 0 0 1 1 1\r\n"
                      "# comment\r\n1 1 0\r\n0 1 0 0 0 0\r\n4 0 1 2 3 255 0 0\r\n"),
                 square_mesh());
}

const char* const ply_vertices = "property double x\nproperty double y\nproperty double z\n";

TEST_F(MeshFile, PlyVariants) {
    const std::string head = "ply\nformat ascii 1.0\ncomment element vertex 9\nelement vertex 4\n";
    const std::string list = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    expect_equal(read("a.ply", head + ply_vertices + list + ".1 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"),
                 square_mesh());
    // Other properties and elements in between; faces first.
    expect_equal(
        read("a.ply",
             "ply\r\nformat ascii 1.0\r\nelement face 1\r\nproperty uchar red\r\n"
             "property list uint8 uint32 vertex_index\r\nelement material 1\r\nproperty list int float w\r\n"
             "element vertex 4\r\nproperty float q\r\nproperty double z\r\nproperty double x\r\n"
             "property double y\r\nend_header\r\n7 4 0 1 2 3\r\n2 .5 .5\r\n"
             "9 0 .1 0\r\n9 0 1 0\r\n9 0 1 1\r\n9 0 0 1\r\n"),
        square_mesh());
}

TEST_F(MeshFile, BinaryPlyOfBothByteOrders) {
    const TriangleMesh mesh = square_mesh();
    for (const bool big : {false, true}) {
        std::string bytes = fmt::format("ply\nformat binary_{}_endian 1.0\nelement vertex 4\n{}",
                                        big ? "big" : "little", ply_vertices);
        bytes += "property short n\nelement face 1\nproperty list ushort uint vertex_indices\nend_header\n";
        for (int v = 0; v < 4; ++v) {
            for (int i = 0; i < 3; ++i) bytes += raw_bytes(mesh.vertices(v, i), big);
            bytes += raw_bytes(short(7), big);
        }
        bytes += raw_bytes(static_cast<unsigned short>(4), big);
        for (unsigned v = 0; v < 4; ++v) bytes += raw_bytes(v, big);
        expect_equal(read("a.ply", bytes), mesh);
    }
}

TEST_F(MeshFile, WrittenPlyReadsBackExactly) {
    const TriangleMesh mesh = shapes::moved(shapes::tube(9, 7, true), 1. / 3, 1, {1, 2, 3});
    expect_equal(read("a.ply", to_ply(mesh)), mesh);
    const std::string ascii = to_ply(mesh, PlyFormat::ascii);
    EXPECT_TRUE(ascii.starts_with("ply\nformat ascii 1.0\n"));
    expect_equal(read("b.ply", ascii), mesh);
}

TEST_F(MeshFile, StlIsWeldedByFirstAppearance) {
    const TriangleMesh mesh = shapes::square(3), from_binary = read("a.stl", binary_stl(mesh));
    EXPECT_EQ(from_binary.vertex_count(), mesh.vertex_count());
    ASSERT_EQ(from_binary.face_count(), mesh.face_count());
    EXPECT_EQ(from_binary.faces.row(0), Faces::Map(std::array{0, 1, 2}.data(), 1, 3));
    std::string text = "solid x vertex\n";
    for (int f = 0; f < mesh.face_count(); ++f) {
        text += "facet normal 0 0 1\n outer loop\n";
        for (int c = 0; c < 3; ++c) {
            const Vec3 p = mesh.vertex(mesh.faces(f, c));
            text += fmt::format("  vertex {} {:e} -0\n", float(p[0]), float(p[1]));
        }
        text += " endloop\nendfacet\n";
    }
    const TriangleMesh from_text = read("b.STL", text + "endsolid x\n");
    EXPECT_TRUE(from_text.faces == from_binary.faces);
    EXPECT_LT((from_text.vertices - from_binary.vertices).cwiseAbs().maxCoeff(), 1e-7);
    std::string capitals = text + "endsolid x\n";
    std::ranges::transform(capitals, capitals.begin(), [](unsigned char c) { return std::toupper(c); });
    expect_equal(read("c.stl", capitals), from_text);
    EXPECT_THAT(complaint("c.stl", text), HasSubstr("endsolid"));
    EXPECT_THAT(complaint("c.stl", text + "vertex 1 2 3\nendsolid x\n"), HasSubstr("facet"));
}

TEST_F(MeshFile, WhatPlyCommentsSayMeansNothing) {
    const TriangleMesh mesh = read("good.ply", to_ply(square_mesh()));
    std::string bytes = to_ply(square_mesh());
    bytes.insert(
        bytes.find("element vertex"),
        "comment texture C:\\dir\\\ncomment before end_header comes data\nobj_info element vertex 9 #\n");
    expect_equal(read("a.ply", bytes), mesh);
}

TEST_F(MeshFile, PlyTriangleStripsAreFaces) {
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n";
    // Two strips; in the second a repeated vertex carries it on.
    const TriangleMesh mesh = read("a.ply", head + "11 0 1 2 3 -1 2 3 4 4 5 3\n");
    ASSERT_EQ(mesh.face_count(), 4);
    EXPECT_EQ(mesh.faces, (Faces(4, 3) << 0, 1, 2, 2, 1, 3, 2, 3, 4, 5, 4, 3).finished());
    EXPECT_THAT(complaint("b.ply", head + "3 0 1 7\n"), HasSubstr("outside"));
    EXPECT_THAT(complaint("c.ply", head + "1 0\n"), HasSubstr("no faces"));
}

TEST_F(MeshFile, OffElementsMayGoOnInTheNextLineOrShareOne) {
    const TriangleMesh mesh = square_mesh();
    const std::string long_lines = ".1 0 0 1 0 0 1 1 0 0 1 0\n", lines = ".1 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    expect_equal(read("a.off", "OFF 4\n2 0\n.1 0\n0\n1 0 0\n1\n1\n0\n0 1 0\n3 0 1\n2\n3\n0 2 3\n"), mesh);
    expect_equal(read("b.off", "OFF\n4 2 0\n" + long_lines + "3 0 1 2\n3 0 2 3\n"), mesh);
    expect_equal(read("c.off", "OFF\n4 2 0\n" + lines + "3 0 1 2 3 0 2 3\n"), mesh);
    const std::string coloured =
        "OFF\n4 2 0\n.1 0 0 5 5 5\n1 0 0 9 9 9\n1 1 0 1 1 1\n0 1 0 0 0 0\n3 0 1 2 7 8\n";
    expect_equal(read("d.off", coloured + "3 0 2 3\n"), mesh);
    EXPECT_NE(complaint("e.off", coloured), "") << "cut short";
    expect_equal(read("f.off", "OFF 4 2 0 .1 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3"), mesh);
    EXPECT_NE(complaint("g.off", "OFF 4 2 0 .1 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2"), "") << "cut short";
}

TEST_F(MeshFile, ByteOrderMarksAndUtf16) {
    expect_equal(read("a.obj", std::string("\xef\xbb\xbf") + square_obj), square_mesh());
    std::string wide;
    for (const char c : off(square_mesh())) wide += std::string{c, '\0'};
    EXPECT_THAT(complaint("a.off", "\xff\xfe" + wide), HasSubstr("UTF-16"));
    EXPECT_THAT(complaint("b.off", wide), HasSubstr("UTF-16"));
    EXPECT_THAT(complaint("c.ply", std::string(1, '\0') + wide), HasSubstr("UTF-16"));
}

TEST_F(MeshFile, AxesThatSlicerStates) {
    EXPECT_EQ(read("a.obj", square_obj).space, Space::unstated);
    EXPECT_EQ(read("b.obj", std::string("# 3D Slicer output. SPACE=RAS\n") + square_obj).space, Space::ras);
    EXPECT_EQ(read("c.obj", std::string(square_obj) + "# SPACE=RAS\n").space, Space::unstated);
    std::string ply = to_ply(square_mesh());
    ply.insert(ply.find("element"), "comment 3D Slicer output. SPACE=LPS\n");
    EXPECT_EQ(read("d.ply", ply).space, Space::lps);
    std::string stl = binary_stl(square_mesh());
    stl.replace(0, 30, "3D Slicer output. SPACE=RAS;  ");
    EXPECT_EQ(read("e.stl", stl).space, Space::ras);
}

TEST_F(MeshFile, WritesTheAxesThatAreStated) {
    TriangleMesh mesh = square_mesh();
    for (const Space space : {Space::lps, Space::ras, Space::unstated})
        for (const PlyFormat format : {PlyFormat::binary, PlyFormat::ascii}) {
            mesh.space = space;
            EXPECT_EQ(read("a.ply", to_ply(mesh, format)).space, space);
            expect_equal(read("a.ply", to_ply(mesh, format)), mesh);
            const std::string obj = to_obj({mesh, parse_obj_model(square_obj, "a.obj")}, "a.mtl");
            EXPECT_EQ(read("a.obj", obj).space, space);
        }
    for (const char* stated : {"", "# 3D Slicer output. SPACE=RAS\n"}) {
        const std::string obj =
            with_vertices(std::string(stated) + square_obj, mesh.vertices, Space::lps, "a.mtl", "a.obj");
        EXPECT_EQ(read("a.obj", obj).space, Space::lps);
        EXPECT_THAT(obj, Not(HasSubstr("RAS")));
    }
}

TEST_F(MeshFile, DoublesAreKeptAndTheLocaleDoesNotMatter) {
    const char* before = std::setlocale(LC_ALL, nullptr);
    const std::string restore = before ? before : "C";
    std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is not installed this tests the precision only
    const TriangleMesh mesh =
        read("a.obj", "v 0.12345678901234567 1e-400 -1.5E2\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::setlocale(LC_ALL, restore.c_str());
    EXPECT_EQ(mesh.vertex(0), Vec3(0.12345678901234567, 0, -150));
}

TEST_F(MeshFile, NumbersOutOfRangeAreTheNearestOnes) {
    const std::string tiny = "0." + std::string(400, '0') + "1", large = std::string(400, '9');
    const TriangleMesh mesh = read("a.obj", "v " + tiny + " -" + tiny + " 1e-400\nv " + large + " -" + large +
                                                " -1e400\nv 0 1 0\nf 1 2 3\n");
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(mesh.vertex(0), Vec3(0, 0, 0));
    EXPECT_EQ(mesh.vertex(1), Vec3(infinity, -infinity, -infinity));
}

TEST_F(MeshFile, NonManifoldFilesAreReadAsTheyStand) {
    const TriangleMesh mesh = read("a.obj",
                                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 9 9 9\n"
                                   "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 1 2\nf 1 2 3\n");
    EXPECT_EQ(mesh.vertex_count(), 6);
    EXPECT_EQ(mesh.face_count(), 5);
    EXPECT_EQ(mesh.faces(3, 1), 0);
}

TEST_F(MeshFile, CoordinatesThatAreNotNumbersAreReadAsTheyStand) {
    const TriangleMesh mesh = read("a.obj", "v 0 0 0\nv 1 0 0\nv nan 0 0\nv 0 inf 0\nf 1 2 3\n");
    EXPECT_TRUE(std::isnan(mesh.vertices(2, 0)));
    EXPECT_TRUE(std::isinf(mesh.vertices(3, 1)));
    EXPECT_TRUE(mesh.vertices.topRows(2).allFinite());
}

TEST_F(MeshFile, FilesThatCannotBeOpened) {
    EXPECT_THROW(read_mesh(folder_ / "missing.off"), IoError);
    std::filesystem::create_directory(folder_ / "folder.off");
    EXPECT_THROW(read_mesh(folder_ / "folder.off"), IoError);
}

TEST_F(MeshFile, BadFilesGetOneClearLine) {
    EXPECT_THAT(complaint("a.off", ""), HasSubstr("empty"));
    EXPECT_THAT(complaint("a.xyz", square_obj), HasSubstr(".obj, .ply, .off, .stl"));
    EXPECT_THAT(complaint("noending", square_obj), HasSubstr(".obj, .ply, .off, .stl"));
    EXPECT_THAT(complaint("a.obj", "v 0 0 0\nv 1 0 0\n"), HasSubstr("no faces"));
    EXPECT_THAT(complaint("a.obj", "v 0 0 0\nv 1 0 0\nv 1 x 0\n"),
                AllOf(HasSubstr("a.obj:3"), HasSubstr("'x'")));
    EXPECT_THAT(complaint("a.obj", "v 0 0\n"), AllOf(HasSubstr(":1"), HasSubstr("z is missing")));
    EXPECT_THAT(complaint("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n"), HasSubstr("face 1"));
    EXPECT_THAT(complaint("a.obj", "v 0 0 0\nf 1 0 1\n"), HasSubstr(":2"));
    EXPECT_THAT(complaint("a.obj", "v 0 0 0\nf -1 -2 -1\n"), HasSubstr(":2"));
    EXPECT_THAT(complaint("a.obj", "v 0 0 0\nf 1 1\n"), HasSubstr("3 corners"));
    EXPECT_THAT(complaint("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n"), HasSubstr("ends before"));
    EXPECT_THAT(complaint("a.off", "OFF\n999999999999 1 0\n0 0 0\n1 0 0\n"), HasSubstr("ends before"));
    EXPECT_THAT(complaint("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"), HasSubstr("ends before"));
    EXPECT_THAT(complaint("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"), HasSubstr("face 0"));
    EXPECT_THAT(complaint("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n"),
                HasSubstr("more follows"));
    EXPECT_THAT(complaint("a.off", "OFF BINARY\n3 1 0\n"), HasSubstr("binary"));
    EXPECT_THAT(complaint("a.off", "hello\n"), HasSubstr(":1"));
    EXPECT_THAT(complaint("a.ply", "ply\nformat ascii 1.0\n"), HasSubstr("end_header"));
    EXPECT_THAT(complaint("a.ply", "ply\nend_header\n"), HasSubstr("format"));
    EXPECT_THAT(complaint("a.stl", "hello"), HasSubstr("STL"));
    std::string truncated = binary_stl(square_mesh());
    truncated.pop_back();
    EXPECT_THAT(complaint("a.stl", truncated), ::testing::Not(""));
}

TEST_F(MeshFile, HugeCountsInPlyHeadersAreRefusedAtOnce) {
    const std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n";
    EXPECT_THAT(complaint("a.ply", head + ply_vertices + "end_header\n" + std::string(100, 'x')),
                HasSubstr("ends before"));
    EXPECT_THAT(complaint("a.ply", "ply\nformat ascii 1.0\nelement nothing 999999999999999\nend_header\n"),
                HasSubstr("no faces"));
    EXPECT_THAT(complaint("a.ply",
                          "ply\nformat binary_little_endian 1.0\nelement face 1\n"
                          "property list uint int vertex_indices\nend_header\n\xff\xff\xff\xff"),
                HasSubstr("length"));
}

/// Every truncation and many changed bytes: a mesh with valid indices, or an Error.
TEST_F(MeshFile, DamagedFilesNeverCrash) {
    const TriangleMesh mesh = square_mesh();
    const std::pair<const char*, std::string> files[] = {
        {"a.obj", square_obj}, {"a.off", off(mesh)}, {"a.ply", to_ply(mesh)}, {"a.stl", binary_stl(mesh)}};
    for (const auto& [name, bytes] : files) {
        const auto attempt = [&](const std::string& damaged) {
            try {
                const TriangleMesh result = read(name, damaged);
                EXPECT_GE(result.faces.minCoeff(), 0);
                EXPECT_LT(result.faces.maxCoeff(), result.vertex_count());
                EXPECT_TRUE(result.vertices.allFinite());
                require_manifold(result, name);
            } catch (const Error&) {
            }
        };
        for (std::size_t n = 0; n < bytes.size(); n += 1 + bytes.size() / 80) attempt(bytes.substr(0, n));
        for (std::size_t i = 0; i < 150; ++i) {
            std::string damaged = bytes;
            damaged[(i * 7919) % bytes.size()] = char(i * 31 + 1);
            damaged[(i * 104729 + 5) % bytes.size()] ^= char(i);
            attempt(damaged);
        }
    }
}

}  // namespace
}  // namespace varimap
