#include <gmock/gmock.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fixtures/shapes.h"
#include "fixtures/transfer.h"
#include "stages/transfer/image.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

using namespace transfers;
using ::testing::HasSubstr;

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

TEST_F(Transfer, BakesWhatTheIdentityShows) {
    // The image comes out as it went in.
    const TriangleMesh square = shapes::square(8);
    const ObjModel model = in_its_own_plane(square);
    write("skin.png", to_png(gradient(64)));
    Correspondence map = identity_onto(square);
    map.to_file = write_skinned("square.obj", square, model, "map_Kd -s 1 1 1 skin.png");
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
    ObjModel outside = unwrapped(ball_);
    outside.uv[0] = {1.5, .5};
    TransferRequest request;
    request.texture = write_skinned("a.obj", ball_, unwrapped(ball_));
    request.bake = {16, 1};
    request.onto = write("outside.obj", obj_of(ball_, outside));
    EXPECT_THAT(refusal(request, identity_onto(ball_)),
                HasSubstr("outside.obj: texture coordinates (1.5, 0.5)"));
}

TEST_F(Transfer, SaysWhereMemoryDoesNotSufficeToBake) {
    const TriangleMesh square = shapes::square(8);
    Correspondence map = identity_onto(square);
    map.to_file = write_skinned("a.obj", square, in_its_own_plane(square));
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

/// A square whose second half lies where its first does, and in one point: what is said of baking onto these.
TEST_F(Transfer, SaysWhereFacesOverlapInTextureCoordinates) {
    const TriangleMesh square = shapes::square(8);
    ObjModel model = in_its_own_plane(square);
    TransferRequest request;
    request.texture = write_skinned("a.obj", square, model);
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
    TransferRequest request;
    request.texture = write_skinned("fine.obj", fine, in_its_own_plane(fine));
    request.onto = request.texture;
    request.bake = {4, 0};
    EXPECT_EQ(warnings_of(request, identity_onto(fine)), "");
}

TEST_F(Transfer, AGlbIsBakedToo) {
    const TriangleMesh square = shapes::square(2);
    Correspondence map = identity_onto(square);
    map.to_file = write_skinned("square.obj", square, in_its_own_plane(square),
                                "map_Kd skin.png\nnewmtl unused\nmap_Kd glass.png");
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

}  // namespace
}  // namespace varimap
