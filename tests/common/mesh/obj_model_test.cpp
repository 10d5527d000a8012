#include "varimap/mesh/io/obj_model.h"

#include <gmock/gmock.h>

#include "fixtures/shapes.h"
#include "varimap/core/error.h"

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
