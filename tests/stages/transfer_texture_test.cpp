#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "fixtures/shapes.h"
#include "fixtures/transfer.h"
#include "stages/transfer/image.h"
#include "stages/transfer/seams.h"

namespace varimap {
namespace {

using namespace transfers;
using ::testing::HasSubstr;
using ::testing::Not;

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
    Correspondence map = identity_onto(square);
    map.to_file = write_skinned("square.obj", square, model, "map_Kd -s .5 .5 1 -o .25 .125 0 skin.png");
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
    TransferRequest request;
    request.texture = write_skinned("a.obj", ball_, unwrapped(ball_), "Kd 1 .5 0\nmap_Kd skin.tga");
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
    ObjModel model = unwrapped(ball_);
    model.materials = {"fur"};
    TransferRequest request;
    request.texture = write_skinned("a.obj", ball_, model);
    EXPECT_THAT(warnings_of(request, identity_onto(ball_)),
                HasSubstr("a.obj: no library (mtllib) describes the materials fur"));
}

TEST_F(Transfer, WritesTexturesAndGlb) {
    write("skin.png", to_png(gradient(8)));
    TransferRequest request;
    request.texture = write_skinned("a.obj", ball_, unwrapped(ball_), "Kd 1 1 1\nmap_Kd skin.png");
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

}  // namespace
}  // namespace varimap
