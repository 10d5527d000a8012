#include "varimap/mesh_files/obj_model.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>

#include "fixtures/shapes.h"
#include "fixtures/temporary_folder.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/mesh_files/mesh_file.h"

namespace varimap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ObjModel, FacesWithoutAMaterialStayWithout) {
    const TriangleMesh mesh = shapes::make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 2, 0}},
                                                {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}});
    ObjModel model;
    model.uv_of = Faces::Constant(3, 3, -1);
    model.material = {1, -1, 0};
    model.materials = {"skin", "horn"};
    const ObjModel read = parse_obj_model(to_obj({mesh, model}, ""), "a.obj");
    EXPECT_THAT(read.material, ElementsAre(-1, 0, 1));
    EXPECT_THAT(read.materials, ElementsAre("horn", "skin"));
}

/// Of a concave polygon too, which is not cut from its first corner.
TEST(ObjModel, CutsTextureCoordinatesAsTheMesh) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv .2 .2 0\nv 0 1 0\n";
    for (int k = 0; k < 5; ++k) text += fmt::format("vt {} 0\n", 4 - k);  // the other way round
    text += "f 3/3 4/2 5/1 1/5 2/4\n";
    const TriangleMesh mesh = parse_mesh(text, "a.obj");
    const ObjModel model = parse_obj_model(text, "a.obj");
    ASSERT_EQ(model.uv_of.rows(), 3);
    constexpr std::array uv_of_vertex{4, 3, 2, 1, 0};
    for (int f = 0; f < 3; ++f) {
        EXPECT_GT(face_normal(mesh, f).z(), 0);
        for (int k = 0; k < 3; ++k) EXPECT_EQ(model.uv_of(f, k), uv_of_vertex[std::size_t(mesh.faces(f, k))]);
    }
}

TEST(ObjModel, NamesRunToTheEndOfTheLine) {
    const ObjModel model = parse_obj_model(
        "mtllib my #1.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl Material #25 \r\nf 1 2 3 # a face\n"
        "usemtl #26\nf 1 2 3\n",
        "a.obj");
    EXPECT_THAT(model.materials, ElementsAre("Material #25", "#26"));
    EXPECT_THAT(model.libraries, ElementsAre("my #1.mtl"));
    EXPECT_THAT(model.material, ElementsAre(0, 1));
}

/// Materials of an OBJ file `a.obj` that names libraries so.
Materials read_from(const TemporaryFolder& folder, const std::string& libraries) {
    ObjModel model;
    model.libraries = {libraries};
    return read_materials(model, folder / "a.obj");
}

TEST(Materials, NamesMayHoldNumberSigns) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "tex#1.png", "");
    write_file_atomically(folder / "a.mtl",
                          "# newmtl none\nnewmtl Material #1\nKd 1 .5 0 # orange\nnewmtl Material #2\n"
                          "map_Kd tex#1.png\n");
    const Materials materials = read_from(folder, "a.mtl");
    ASSERT_EQ(materials.list.size(), 2u);
    ASSERT_NE(materials.find("Material #1"), nullptr);
    EXPECT_EQ(materials.find("Material #1")->colour, Vec3(1, .5, 0));
    EXPECT_EQ(materials.list[1].texture, folder / "tex#1.png");
    EXPECT_THAT(materials.text, HasSubstr("newmtl Material #1\n"));
    EXPECT_THAT(materials.text, HasSubstr("map_Kd tex#1.png\n"));
}

TEST(Materials, ReadsOptionsOfImagesAndKeywordsInEitherCase) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "a b.png", "");
    write_file_atomically(folder / "a.mtl",
                          "NewMtl skin\nkd 1 .5 0\nd 0.5\nmap_kd -s 2 3 1 -clamp on -o .25 0 0 a b.png\n");
    const Materials materials = read_from(folder, "a.mtl");
    const Material* skin = materials.find("skin");
    ASSERT_NE(skin, nullptr);
    EXPECT_EQ(skin->colour, Vec3(1, .5, 0));
    EXPECT_EQ(skin->opacity, .5);
    EXPECT_EQ(skin->texture, folder / "a b.png");
    EXPECT_EQ(skin->texture_scale, Vec2(2, 3));
    EXPECT_EQ(skin->texture_offset, Vec2(.25, 0));
}

TEST(Materials, NumbersThatAreNotFinitePlaceNoImage) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "a.png", "");
    write_file_atomically(folder / "a.mtl", "newmtl skin\nmap_Kd -s inf 2 -o 1 nan a.png\n");
    const Materials materials = read_from(folder, "a.mtl");
    ASSERT_EQ(materials.list.size(), 1u);
    EXPECT_EQ(materials.list[0].texture, folder / "a.png");
    EXPECT_EQ(materials.list[0].texture_scale, Vec2(1, 2));
    EXPECT_EQ(materials.list[0].texture_offset, Vec2(1, 0));
}

TEST(Materials, LibrariesMayShareALine) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "a.mtl", "newmtl a\n");
    write_file_atomically(folder / "b.mtl", "newmtl b\n");
    write_file_atomically(folder / "a b.mtl", "newmtl both\n");
    EXPECT_EQ(read_from(folder, "a.mtl b.mtl").list.size(), 2u);
    EXPECT_EQ(read_from(folder, "a b.mtl").list[0].name, "both");
    EXPECT_EQ(read_from(folder, ".\\a.mtl").list[0].name, "a");
    EXPECT_THROW(read_from(folder, "a.mtl c.mtl"), IoError);
    EXPECT_THROW(read_from(folder, ""), IoError);
}

TEST(ObjModel, RefusesTextureCoordinatesThatAreNotFinite) {
    for (const std::string line : {"vt nan 0", "vt 0 inf", "vt 1e999 0"}) {
        try {
            parse_obj_model("v 0 0 0\n" + line + "\n", "a.obj");
            ADD_FAILURE() << line;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("a.obj:2: "));
        }
    }
}

/// Lines that end with \r alone, a byte order mark, a comment that ends with a backslash.
TEST(ObjModel, ReadsAndRewritesOddText) {
    const std::string texts[] = {"v 0 0 0\rv 1 0 0\rv 0 1 0\rvt .5 1\rf 1/1 2/1 3/1\r",
                                 "\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nvt .5 1\nf 1/1 2/1 3/1\n",
                                 "# C:\\\nv 0 0 0\nv 1 0 0 # \\\nv 0 1 0\nvt .5 1\nf 1/1 2/1 3/1\n"};
    for (const std::string& text : texts) {
        const TriangleMesh mesh = parse_mesh(text, "a.obj");
        ASSERT_EQ(mesh.vertex_count(), 3);
        EXPECT_EQ(mesh.vertex(1), Vec3(1, 0, 0));
        EXPECT_EQ(mesh.face_count(), 1);
        EXPECT_THAT(parse_obj_model(text, "a.obj").uv, ElementsAre(Vec2(.5, 1)));
        const Points moved = 2 * mesh.vertices;
        const std::string rewritten = with_vertices(text, moved, Space::unstated, "", "a.obj");
        EXPECT_EQ(parse_mesh(rewritten, "b.obj").vertices, moved);
        EXPECT_EQ(parse_obj_model(rewritten, "b.obj").uv.size(), 1u);
    }
    EXPECT_THROW(with_vertices("v 0 0 \\\n0\n", Points::Zero(1, 3), Space::unstated, "", "a.obj"),
                 InputError);
}

TEST(ObjModel, TurnsPolygonsWhenAsked) {
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1 4/1\n";
    const Points vertices = parse_mesh(square, "a.obj").vertices;
    EXPECT_EQ(with_vertices(square, vertices, Space::unstated, "", "a.obj"), square);
    EXPECT_THAT(with_vertices(square, vertices, Space::unstated, "", "a.obj", true),
                HasSubstr("\nf 1/1 4/1 3/1 2/1\n"));
}

TEST(ObjModel, TellsImagesByTheirFirstBytes) {
    EXPECT_EQ(media_type("\x89PNG\r\n"), "image/png");
    EXPECT_EQ(media_type("\xff\xd8\xff\xe0"), "image/jpeg");
    EXPECT_EQ(media_type("GIF89a"), "");
}

}  // namespace
}  // namespace varimap
