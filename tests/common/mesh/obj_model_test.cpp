#include "varimap/mesh/io/obj_model.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>

#include "fixtures/shapes.h"
#include "varimap/core/error.h"
#include "varimap/mesh/io/mesh_file.h"

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

TEST(ObjModel, TellsImagesByTheirFirstBytes) {
    EXPECT_EQ(media_type("\x89PNG\r\n"), "image/png");
    EXPECT_EQ(media_type("\xff\xd8\xff\xe0"), "image/jpeg");
    EXPECT_EQ(media_type("GIF89a"), "");
}

}  // namespace
}  // namespace varimap
