#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>

#include "fixtures/scenes.h"
#include "fixtures/temporary_folder.h"
#include "stages/import/isolated.h"
#include "stages/import/model_parts.h"
#include "stages/import/scene.h"
#include "stages/import/scene_files.h"
#include "stages/import/source_meshes.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_files/obj_model.h"

namespace varimap {
namespace {

using scenes::binary_fbx;
using scenes::collada;
using scenes::points;
using scenes::polygons;
using scenes::raw;
using scenes::text_fbx;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAreArray;
using namespace std::string_literals;

ImportedScene import(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
    const std::string path = folder / name;
    write_file_atomically(path, bytes);
    return read_scene(path);
}

std::vector<std::vector<int>> polygons_of(const PolygonSoup& soup) {
    std::vector<std::vector<int>> result;
    std::size_t corner = 0;
    for (const std::size_t end : soup.ends) {
        result.emplace_back();
        for (; corner < end; ++corner) result.back().push_back(int(soup.corners[corner]));
    }
    return result;
}

/// Points and polygons are those above, moved by (1, 2, 3) after scaling by 2.
void expect_the_file(const ImportedScene& scene, const std::vector<std::vector<int>>& expected) {
    ASSERT_EQ(scene.soup.points.size(), points.size() / 3);
    for (std::size_t v = 0; v < scene.soup.points.size(); ++v)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(scene.soup.points[v][k], 2 * points[3 * v + std::size_t(k)] + k + 1, 1e-12);
    EXPECT_EQ(polygons_of(scene.soup), expected);
}

TEST(Import, ColladaHasItsOwnPointsAndPolygons) {
    const TemporaryFolder folder;
    expect_the_file(import(folder, "a.dae", collada()), {polygons[0], polygons[2], polygons[1]});
}

TEST(Import, FbxHasItsOwnPointsAndPolygons) {
    const TemporaryFolder folder;
    expect_the_file(import(folder, "a.fbx", binary_fbx(true)), polygons);
    expect_the_file(import(folder, "b.fbx", binary_fbx(false)), polygons);
}

TEST(Import, FbxAsTextToo) {
    const TemporaryFolder folder;
    expect_the_file(import(folder, "a.fbx", text_fbx()), polygons);
}

std::string glb_file(std::string json, const std::string& data) {
    json.append((4 - json.size() % 4) % 4, ' ');
    return std::string("glTF") + raw(std::uint32_t(2)) +
           raw(std::uint32_t(12 + 16 + json.size() + data.size())) + raw(std::uint32_t(json.size())) +
           "JSON" + json + raw(std::uint32_t(data.size())) + std::string("BIN\0", 4) + data;
}

/// Two primitives with one accessor of positions, below two nodes of which the second mirrors.
std::string glb() {
    const std::vector<float> place{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::vector<std::uint32_t> corners{0, 2, 1, 0, 1, 3};
    const std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"children":[1,2],"translation":[0,0,5]},{"mesh":0},{"mesh":0,"scale":[-2,1,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},"indices":2}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
{"bufferView":1,"componentType":5125,"count":3,"type":"SCALAR"},
{"bufferView":1,"byteOffset":12,"componentType":5125,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
"buffers":[{"byteLength":72}]})";
    return glb_file(json, raw(place) + raw(corners));
}

/// Three triangles, the first `painted` with texture coordinates: with a material that has an image inside
/// the file, with one that names an image that is not there, and without any.
std::string painted_glb(const std::string& image, int painted = 3) {
    const std::vector<float> place{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, uv{0, 0, 1, 0, 0, 1, 1, 1};
    const std::vector<std::uint32_t> corners{0, 2, 1, 0, 1, 3, 1, 2, 3};
    const std::string data = raw(place) + raw(uv) + raw(corners) + image;
    std::string primitives, accessors;
    for (const int k : {0, 1, 2}) {
        primitives += fmt::format(R"({}{{"attributes":{{"POSITION":0{}}},"indices":{}{}}})", k > 0 ? "," : "",
                                  k < painted ? R"(,"TEXCOORD_0":1)" : "", k + 2,
                                  k < 2 ? fmt::format(R"(,"material":{})", k) : "");
        accessors += fmt::format(
            R"(,{{"bufferView":2,"byteOffset":{},"componentType":5125,"count":3,"type":"SCALAR"}})", 12 * k);
    }
    const std::string json = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{}]}}],
"materials":[{{"name":"skin","pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}},
{{"name":"skin","pbrMetallicRoughness":{{"baseColorFactor":[1,0.5,0,1],"baseColorTexture":{{"index":1}}}}}}],
"textures":[{{"source":0}},{{"source":1}}],
"images":[{{"bufferView":3,"mimeType":"image/png"}},{{"uri":"gone.png"}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}},
{{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}}{}],
"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":32}},
{{"buffer":0,"byteOffset":80,"byteLength":36}},{{"buffer":0,"byteOffset":116,"byteLength":{}}}],
"buffers":[{{"byteLength":{}}}]}})",
        primitives, accessors, image.size(), data.size());
    return glb_file(json, data);
}

TEST(Import, SaysWhereTextureCoordinatesAreLeftOut) {
    const TemporaryFolder folder;
    const ImportedScene scene = import(folder, "a.glb", painted_glb("image", 2));
    EXPECT_TRUE(scene.uv.empty());
    EXPECT_THAT(scene.left_out, ElementsAre(HasSubstr("texture coordinates are left out")));
    EXPECT_THAT(import(folder, "b.glb", painted_glb("image")).left_out, IsEmpty());
    EXPECT_THAT(import(folder, "c.glb", painted_glb("image", 0)).left_out, IsEmpty());
}

TEST(Import, MaterialsAndImagesBecomeFilesBesideTheObj) {
    const TemporaryFolder folder;
    const std::string image = "\x89PNG\r\n not really.";
    const ImportedScene scene = import(folder, "a.glb", painted_glb(image));
    EXPECT_THAT(scene.missing_images, ElementsAre("gone.png"));
    const SceneFiles files = to_files(scene, "b");
    ASSERT_EQ(files.size(), 3u);
    EXPECT_EQ(files[1].first, "b.mtl");
    EXPECT_EQ(files[2], std::pair("b.0.png"s, image));
    for (const auto& [name, bytes] : files) write_file_atomically(folder / name, bytes);
    const std::string path = folder / "b.obj";
    const ObjModel model = parse_obj_model(files[0].second, path);
    EXPECT_TRUE(model.has_uv());
    EXPECT_THAT(model.material, ElementsAre(0, 1, 2));
    const Materials materials = read_materials(model, path);
    EXPECT_THAT(materials.images, ElementsAre(std::pair("b.0.png"s, folder / "b.0.png")));
    const Material *skin = materials.find(model.materials[0]), *other = materials.find(model.materials[1]);
    ASSERT_TRUE(skin != nullptr && other != nullptr && skin != other);  // though the file calls both the same
    EXPECT_EQ(skin->texture, folder / "b.0.png");
    EXPECT_EQ(other->texture, "");
    EXPECT_EQ(other->colour, Vec3(1, .5, 0));
    const Material* none = materials.find(model.materials[2]);  // assimp's own for what has none
    ASSERT_NE(none, nullptr);
    EXPECT_EQ(none->texture, "");
}

TEST(Import, GltfNodesPlaceTheirMeshes) {
    const TemporaryFolder folder;
    const ImportedScene scene = import(folder, "a.glb", glb());
    EXPECT_EQ(scene.objects, 2);
    ASSERT_EQ(scene.soup.points.size(), 8u);  // those of the accessor once for each node
    EXPECT_EQ(scene.soup.points[1], Vec3(1, 0, 5));
    EXPECT_EQ(scene.soup.points[5], Vec3(-2, 0, 5));
    EXPECT_THAT(polygons_of(scene.soup), ElementsAre(ElementsAre(0, 2, 1), ElementsAre(0, 1, 3),
                                                     ElementsAre(4, 5, 6), ElementsAre(4, 7, 5)));
}

TEST(Import, ObjReadsBackTheSame) {
    const TemporaryFolder folder;
    const ImportedScene scene = import(folder, "a.fbx", binary_fbx(true));
    const SceneFiles files = to_files(scene, "a");
    EXPECT_EQ(files[0].first, "a.obj");
    const TriangleMesh mesh = parse_mesh(files[0].second, "a.obj");
    ASSERT_EQ(mesh.vertex_count(), 7);
    for (int v = 0; v < 7; ++v) EXPECT_EQ(mesh.vertex(v), scene.soup.points[std::size_t(v)]);
    EXPECT_EQ(mesh.face_count(), 5);
}

/// A glTF file piece by piece: one triangle, in one node, without positions yet.
struct Gltf {
    nlohmann::json json = nlohmann::json::parse(
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{}}]}],"accessors":[],"bufferViews":[]})");
    std::string data;

    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }
    template <class T>
    int accessor(const std::vector<T>& values, const std::string& type, int component_type,
                 bool normalized = false) {
        data.append((4 - data.size() % 4) % 4, '\0');
        const std::size_t components = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : type[3] - '0';
        const std::size_t size = values.size() * sizeof(T);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", size}});
        data += raw(values);
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", component_type},
                                     {"count", values.size() / components},
                                     {"type", type}});
        if (normalized) json["accessors"].back()["normalized"] = true;
        return int(json["accessors"].size()) - 1;
    }
    template <class T>
    void attribute(const char* name, const std::vector<T>& values, const std::string& type,
                   int component_type, bool normalized = false) {
        const int number = accessor(values, type, component_type, normalized);
        primitive()["attributes"][name] = number;
    }
    std::string bytes() {
        json["buffers"] = {{{"byteLength", data.size()}}};
        return glb_file(json.dump(), data);
    }
};

constexpr int of_bytes = 5121, of_shorts = 5122, of_ushorts = 5123, of_floats = 5126;
const std::vector<float> corner_places{0, 0, 0, 1, 0, 0, 0, 1, 0};

Gltf triangle() {
    Gltf gltf;
    gltf.attribute("POSITION", corner_places, "VEC3", of_floats);
    return gltf;
}

/// The triangle's texture coordinates, v downwards as in the file.
void expect_uv(const ImportedScene& scene, const std::vector<double>& expected) {
    ASSERT_EQ(scene.uv.size(), expected.size() / 2);
    for (std::size_t k = 0; k < scene.uv.size(); ++k) {
        EXPECT_NEAR(scene.uv[k][0], expected[2 * k], 1e-6);
        EXPECT_NEAR(1 - scene.uv[k][1], expected[2 * k + 1], 1e-6);
    }
}

std::string refusal(const std::string& name, const std::string& bytes) {
    const TemporaryFolder folder;
    try {
        import(folder, name, bytes);
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr(name));
        return error.what();
    }
    return "none";
}

TEST(Import, IntegersOfGltfBecomeWhatTheyStandFor) {
    const TemporaryFolder folder;
    Gltf gltf;
    // Four shorts a vertex, of which the last fills up.
    gltf.attribute("POSITION", std::vector<std::int16_t>{0, 0, -32768, 7, 32767, 0, 0, 7, 0, -32767, 0, 7},
                   "VEC3", of_shorts, true);
    gltf.json["accessors"][0]["count"] = 3;
    gltf.json["bufferViews"][0]["byteStride"] = 8;
    gltf.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    gltf.attribute("TEXCOORD_0", std::vector<std::uint16_t>{0, 0, 65535, 0, 13107, 65535}, "VEC2", of_ushorts,
                   true);
    const ImportedScene shorts = import(folder, "a.glb", gltf.bytes());
    EXPECT_THAT(shorts.soup.points, ElementsAre(Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, -1, 0)));
    expect_uv(shorts, {0, 0, 1, 0, .2, 1});
    gltf.json["accessors"][0].erase("normalized");
    gltf.attribute("TEXCOORD_0", std::vector<std::uint8_t>{0, 0, 255, 0, 51, 255}, "VEC2", of_bytes, true);
    const ImportedScene bytes = import(folder, "b.glb", gltf.bytes());
    EXPECT_EQ(bytes.soup.points[1], Vec3(32767, 0, 0));
    expect_uv(bytes, {0, 0, 1, 0, .2, 1});
}

TEST(Import, SparseIntegersOfGltfToo) {
    const TemporaryFolder folder;
    Gltf gltf;
    gltf.attribute("POSITION", std::vector<std::uint16_t>{0, 0, 0, 1, 0, 0, 9, 9, 9}, "VEC3", of_ushorts);
    gltf.accessor(std::vector<std::uint8_t>{2}, "SCALAR", of_bytes);
    gltf.accessor(std::vector<std::uint16_t>{0, 3, 0}, "VEC3", of_ushorts);
    gltf.json["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", 1}, {"componentType", of_bytes}}},
                                           {"values", {{"bufferView", 2}}}};
    EXPECT_EQ(import(folder, "a.glb", gltf.bytes()).soup.points[2], Vec3(0, 3, 0));
    gltf.json["accessors"][0]["sparse"]["indices"]["bufferView"] = 0;
    gltf.json["accessors"][0]["sparse"]["count"] = 9;
    EXPECT_THAT(refusal("b.glb", gltf.bytes()), HasSubstr("goes beyond"));
}

TEST(Import, TextureCoordinatesAreThoseThatTheMaterialUses) {
    const TemporaryFolder folder;
    Gltf gltf = triangle();
    gltf.attribute("TEXCOORD_0", std::vector<float>{7, 7, 7, 7, 7, 7}, "VEC2", of_floats);
    gltf.attribute("TEXCOORD_1", std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", of_floats);
    gltf.primitive()["material"] = 0;
    gltf.json["materials"] =
        nlohmann::json::parse(R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}}])");
    gltf.json["textures"] = nlohmann::json::parse(R"([{"source":0}])");
    gltf.json["images"] = nlohmann::json::parse(R"([{"uri":"gone.png"}])");
    expect_uv(import(folder, "a.glb", gltf.bytes()), {0, 0, 1, 0, 0, 1});
    // The extension's own example: the lower left quarter of the image, turned.
    gltf.json["extensionsRequired"] = {"KHR_texture_transform"};
    gltf.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
             ["KHR_texture_transform"] = {{"offset", {0, 1}}, {"rotation", M_PI / 2}, {"scale", {.5, .5}}};
    expect_uv(import(folder, "b.glb", gltf.bytes()), {0, 1, 0, .5, .5, 1});
}

TEST(Import, UrisOfGltfHaveEscapes) {
    const TemporaryFolder folder;
    Gltf gltf = triangle();
    write_file_atomically(folder / "d \xc3\xa4.bin", gltf.data);
    write_file_atomically(folder / "tex one.png", "\x89PNG\r\n not really.");
    gltf.json["buffers"] = nlohmann::json::parse(R"([{"byteLength":36,"uri":"d%20%C3%A4.bin"}])");
    gltf.primitive()["material"] = 0;
    gltf.json["materials"] =
        nlohmann::json::parse(R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])");
    gltf.json["textures"] = nlohmann::json::parse(R"([{"source":0}])");
    gltf.json["images"] = nlohmann::json::parse(R"([{"uri":"tex%20one.png"}])");
    const ImportedScene scene = import(folder, "a.gltf", gltf.json.dump());
    EXPECT_EQ(scene.soup.points[1], Vec3(1, 0, 0));
    EXPECT_TRUE(scene.missing_images.empty());
    EXPECT_EQ(scene.images.size(), 1u);
    gltf.json["buffers"][0]["uri"] = "data:application/octet-stream;base64,AACAPw==";
    gltf.json["buffers"][0]["byteLength"] = 4;
    EXPECT_THAT(refusal("b.gltf", gltf.json.dump()), HasSubstr("is the file truncated?"));
    gltf.json["buffers"][0]["uri"] = "gone.bin";
    EXPECT_THAT(refusal("b.gltf", gltf.json.dump()), HasSubstr("its buffer gone.bin is not there"));
}

/// As the format says, the joints alone place a skin.
TEST(Import, SkinsOfGltfStandAsTheirJointsDo) {
    const TemporaryFolder folder;
    Gltf gltf = triangle();
    gltf.attribute("JOINTS_0", std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4",
                   of_bytes);
    gltf.attribute("WEIGHTS_0", std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 51, 204, 0, 0}, "VEC4",
                   of_bytes, true);
    std::vector<float> inverses(32, 0);
    for (const int k : {0, 5, 10, 15}) inverses[std::size_t(k)] = inverses[std::size_t(16 + k)] = 1;
    inverses[12] = -2;  // the first joint stands at x = 2 when it is bound
    gltf.json["skins"] = {
        {{"joints", {1, 2}}, {"inverseBindMatrices", gltf.accessor(inverses, "MAT4", of_floats)}}};
    // Both joints have one name, and the mesh is shown without its skin too.
    gltf.json["nodes"] = nlohmann::json::parse(
        R"([{"mesh":0,"skin":0,"translation":[100,0,0]},{"name":"j","translation":[2,0,0],"children":[2]},
{"name":"j","translation":[-2,0,5]},{"mesh":0,"translation":[0,0,50]}])");
    gltf.json["scenes"][0]["nodes"] = {0, 1, 3};
    const ImportedScene scene = import(folder, "a.glb", gltf.bytes());
    ASSERT_EQ(scene.soup.points.size(), 6u);
    EXPECT_EQ(scene.soup.points[0], Vec3(0, 0, 0));
    EXPECT_EQ(scene.soup.points[1], Vec3(1, 0, 5));
    EXPECT_LT((scene.soup.points[2] - Vec3(0, 1, 4)).norm(), 1e-6);
    EXPECT_EQ(scene.soup.points[4], Vec3(1, 0, 50));
}

TEST(Import, SkinsOfGltfNeedNoBindMatrices) {
    const TemporaryFolder folder;
    Gltf gltf = triangle();
    gltf.attribute("JOINTS_0", std::vector<std::uint8_t>(12, 0), "VEC4", of_bytes);
    gltf.attribute("WEIGHTS_0", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", of_floats);
    gltf.json["skins"] = {{{"joints", {1}}}};
    gltf.json["nodes"] = nlohmann::json::parse(R"([{"mesh":0,"skin":0},{"translation":[0,0,5]}])");
    gltf.json["scenes"][0]["nodes"] = {0, 1};
    EXPECT_THAT(import(folder, "a.glb", gltf.bytes()).soup.points,
                ElementsAre(Vec3(0, 0, 5), Vec3(1, 0, 5), Vec3(0, 1, 5)));
}

TEST(Import, GltfWithoutScenesIsOneOfAllNodes) {
    const TemporaryFolder folder;
    Gltf gltf = triangle();
    gltf.json.erase("scene");
    gltf.json.erase("scenes");
    gltf.json["nodes"] = nlohmann::json::parse(R"([{"mesh":0},{"children":[0],"translation":[0,0,3]}])");
    const ImportedScene scene = import(folder, "a.glb", gltf.bytes());
    EXPECT_THAT(scene.soup.points, ElementsAre(Vec3(0, 0, 3), Vec3(1, 0, 3), Vec3(0, 1, 3)));
}

TEST(Import, SaysThatColoursBlendShapesAndOtherImagesAreLeftOut) {
    const TemporaryFolder folder;
    Gltf gltf = triangle();
    gltf.attribute("COLOR_0", std::vector<std::uint8_t>(12, 128), "VEC4", of_bytes, true);
    gltf.json["textures"] = nlohmann::json::parse(R"([{"extensions":{"KHR_texture_basisu":{"source":0}}}])");
    EXPECT_THAT(import(folder, "a.glb", gltf.bytes()).left_out,
                ElementsAre(HasSubstr("KHR_texture_basisu"), "colours of vertices are left out"));
    Gltf smiling = triangle();
    smiling.primitive()["targets"] = {{{"POSITION", 0}}};
    EXPECT_THAT(import(folder, "b.glb", smiling.bytes()).left_out, ElementsAre("blend shapes are left out"));
}

TEST(Import, RefusesGltfThatNeedsWhatIsNotRead) {
    Gltf gltf = triangle();
    gltf.json["extensionsRequired"] = {"KHR_materials_unlit", "FOO_unknown"};
    EXPECT_THAT(refusal("a.glb", gltf.bytes()), HasSubstr("needs the extension FOO_unknown"));
    gltf.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    EXPECT_THAT(refusal("b.glb", gltf.bytes()), HasSubstr("compressed (EXT_meshopt_compression)"));
    gltf.json["extensionsRequired"] = 7;
    EXPECT_THAT(refusal("c.glb", gltf.bytes()), HasSubstr("its JSON is not that of a glTF file"));
    gltf = triangle();
    gltf.primitive()["indices"] = gltf.accessor(std::vector<std::uint8_t>{0, 1, 3}, "SCALAR", of_bytes);
    EXPECT_THAT(refusal("d.glb", gltf.bytes()), HasSubstr("a face names a vertex that is not there"));
    const std::string whole = triangle().bytes();
    for (std::size_t size = 0; size < whole.size(); size += 41)
        EXPECT_NE(refusal("e.glb", whole.substr(0, size)), "none") << size;
}

/// A tetrahedron packed by Draco, its indices of four bytes.
TEST(Import, UnpacksDraco) {
    const TemporaryFolder folder;
    nlohmann::json json = nlohmann::json::parse(
        R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":1},"indices":0,
"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}],
"accessors":[{"componentType":5125,"count":12,"type":"SCALAR"},{"componentType":5126,"count":4,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":76}],"buffers":[{"byteLength":80,
"uri":"data:application/octet-stream;base64,RFJBQ08CAgEBAAAABAQAAwAAAS8BARAB/wAAAQAJAwAAAgEBAQADAwEQATADAFCCJJEEAAAAAP8HAAAAAAAAAAAAAAAAAAAAAIA/CwAAAAA="}],
"extensionsRequired":["KHR_draco_mesh_compression"],"extensionsUsed":["KHR_draco_mesh_compression"]})");
    ImportedScene scene;
    try {
        scene = import(folder, "a.gltf", json.dump());
    } catch (const InputError&) {
        GTEST_SKIP() << "assimp is built without Draco";
    }
    EXPECT_EQ(scene.soup.ends.size(), 4u);
    ASSERT_EQ(scene.soup.points.size(), 4u);
    double sum = 0;
    for (const Vec3& x : scene.soup.points) sum += x.sum();
    EXPECT_NEAR(sum, 3, .01);  // three corners at 1
    json["accessors"][1]["count"] = 70000;
    EXPECT_THAT(refusal("b.gltf", json.dump()), HasSubstr("KHR_draco_mesh_compression"));
}

/// A zip archive of files that are not compressed.
std::string zip(const std::vector<std::pair<std::string, std::string>>& files) {
    std::string bytes, list;
    for (const auto& [name, content] : files) {
        const auto size = std::uint32_t(content.size());
        const std::uint32_t sum = scenes::crc(content);
        const std::string sizes = raw(sum) + raw(size) + raw(size) + raw(std::uint16_t(name.size()));
        const std::string version = raw(std::uint16_t(20)) + std::string(8, '\0');
        list += "PK\1\2" + raw(std::uint16_t(20)) + version + sizes + std::string(12, '\0') +
                raw(std::uint32_t(bytes.size())) + name;
        bytes += "PK\3\4" + version + sizes + std::string(2, '\0') + name + content;
    }
    const auto count = std::uint16_t(files.size());
    return bytes + list + "PK\5\6" + std::string(4, '\0') + raw(count) + raw(count) +
           raw(std::uint32_t(list.size())) + raw(std::uint32_t(bytes.size())) + std::string(2, '\0');
}

std::string model_3mf(const std::string& resources, const std::string& build) {
    return R"(<?xml version="1.0"?><model unit="millimeter" )"
           R"(xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" )"
           R"(xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06"><resources>)" +
           resources + "</resources><build>" + build + "</build></model>";
}

TEST(Import, NamesTheParts3mfHasInFilesOfTheirOwn) {
    const std::string links =
        R"(<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">)"
        R"(<Relationship Target="/3D/3dmodel.model" Id="rel0" )"
        R"(Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";
    const std::string mesh =
        R"(<object id="1" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>)"
        R"(<vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object>)";
    const std::string item = R"(<item objectid="1"/>)";
    const TemporaryFolder folder;
    const std::string whole = zip({{"_rels/.rels", links}, {"3D/3dmodel.model", model_3mf(mesh, item)}});
    EXPECT_EQ(model_parts_in_3mf(whole), 1);
    const ImportedScene scene = import(folder, "a.3mf", whole);
    EXPECT_EQ(scene.soup.ends.size(), 1u);
    EXPECT_TRUE(scene.left_out.empty());
    const std::string part =
        R"(<object id="1" type="model"><components><component p:path="/3D/Objects/o.model" objectid="1"/></components></object>)";
    const std::string parts = zip({{"_rels/.rels", links},
                                   {"3D/3dmodel.model", model_3mf(part, item)},
                                   {"3D/Objects/o.model", model_3mf(mesh, "")}});
    EXPECT_THAT(refusal("b.3mf", parts), HasSubstr("production extension"));
    for (std::size_t size = 0; size < parts.size(); ++size)
        EXPECT_LE(model_parts_in_3mf(std::string_view(parts).substr(0, size)), 2);
}

TEST(Import, RefusesNodesWithoutMeshes) {
    EXPECT_THAT(refusal("a.ase", "BLENDER junk 123"), HasSubstr("holds no faces"));
}

TEST(Import, RefusesWhatHoldsNoFaces) {
    const TemporaryFolder folder;
    EXPECT_THROW(import(folder, "a.glb", R"({"asset":{"version":"2.0"}})"), InputError);
    for (const char* ending : {"dae", "fbx", "glb", "gltf", "3mf", "3ds", "x", "lwo"}) {
        const std::string name = fmt::format("noise.{}", ending);
        try {
            import(folder, name, "not a mesh at all\n1 2 3\n");
            FAIL() << name;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(name));
        }
    }
}

TEST(Import, KnowsWhatItCanRead) {
    for (const char* name : {"a.glb", "A.GLTF", "x/a.fbx", "a.dae", "a.3mf"})
        EXPECT_TRUE(is_importable(name)) << name;
    for (const char* name : {"a", "a.", "a.txt", "fbx"}) EXPECT_FALSE(is_importable(name)) << name;
}

/// A file of one mesh, and what reads it.
struct SourceFile {
    std::string bytes;
    std::vector<PolygonSoup> (*read)(std::string_view);
};

std::vector<SourceFile> source_files() {
    return {{binary_fbx(true), fbx_meshes},
            {binary_fbx(false), fbx_meshes},
            {text_fbx(), fbx_meshes},
            {collada(), collada_meshes}};
}

/// Whether a spoiled file gives no more meshes and polygons than the whole one, and corners at points that
/// are there.
bool are_sound(const std::vector<PolygonSoup>& meshes, const std::vector<PolygonSoup>& of_whole) {
    if (meshes.size() > of_whole.size()) return false;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const auto count = static_cast<long long>(meshes[m].points.size());
        if (meshes[m].ends.size() > of_whole[m].ends.size() ||
            !std::ranges::all_of(meshes[m].corners, [&](long long v) { return v >= 0 && v < count; }))
            return false;
    }
    return true;
}

TEST(SourceMeshes, AreReadFromEachFormat) {
    for (const auto& [bytes, read] : source_files()) {
        const std::vector<PolygonSoup> meshes = read(bytes);
        ASSERT_EQ(meshes.size(), 1u);
        EXPECT_EQ(meshes[0].points.size(), points.size() / 3);
        EXPECT_THAT(polygons_of(meshes[0]), UnorderedElementsAreArray(polygons));
    }
}

TEST(SourceMeshes, EndWhereTheFileIsCutShort) {
    for (const auto& [bytes, read] : source_files()) {
        const std::vector<PolygonSoup> whole = read(bytes);
        for (std::size_t size = 0; size <= bytes.size(); ++size)
            ASSERT_TRUE(are_sound(read(std::string_view(bytes).substr(0, size)), whole)) << size;
    }
}

TEST(SourceMeshes, EndWhereTheFileIsDamaged) {
    for (const auto& [bytes, read] : source_files()) {
        const std::vector<PolygonSoup> whole = read(bytes);
        for (std::size_t at = 0; at < bytes.size(); ++at)
            for (const char byte : {'\0', '\xff', '9'}) {
                std::string damaged = bytes;
                damaged[at] = byte;
                ASSERT_TRUE(are_sound(read(damaged), whole)) << at << ": " << int(byte);
            }
    }
}

std::string message_of(const std::function<std::string()>& task, const Limits& limits) {
    try {
        run_isolated(task, limits, "odd.glb");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Isolated, ReturnsWhatTheTaskReturns) {
    const std::string large(5'000'000, 'x');
    EXPECT_EQ(run_isolated([&] { return large; }, {10, 1}, "a.glb"), large);
}

TEST(Isolated, TellsWhatBecameOfTheTask) {
    EXPECT_EQ(message_of([]() -> std::string { throw InputError("a.glb: no"); }, {10, 1}), "a.glb: no");
    EXPECT_THAT(message_of(
                    []() -> std::string {
                        std::raise(SIGSEGV);
                        return "";
                    },
                    {10, 1}),
                HasSubstr("odd.glb: the library that reads such files crashed"));
    EXPECT_THAT(message_of(
                    []() -> std::string {
                        for (volatile double x = 1; x > 0;) x = std::sqrt(x + 1);
                        return "";
                    },
                    {1, 1}),
                HasSubstr("odd.glb: reading it takes more than 1 s"));
#ifndef __SANITIZE_ADDRESS__
    EXPECT_THAT(message_of([] { return std::string(std::size_t(4e9), 'x'); }, {10, 2}),
                HasSubstr("odd.glb: reading it takes more than 2.0 GB"));
#endif
}

}  // namespace
}  // namespace varimap
