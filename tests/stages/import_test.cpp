#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <functional>

#include "fixtures/scenes.h"
#include "fixtures/temporary_folder.h"
#include "stages/import/isolated.h"
#include "stages/import/scene.h"
#include "stages/import/source_meshes.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/mesh/io/mesh_file.h"
#include "varimap/mesh/io/obj_model.h"

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

/// Three triangles: with a material that has an image inside the file, with one that names an image that is
/// not there, and without any.
std::string painted_glb(const std::string& image) {
    const std::vector<float> place{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, uv{0, 0, 1, 0, 0, 1, 1, 1};
    const std::vector<std::uint32_t> corners{0, 2, 1, 0, 1, 3, 1, 2, 3};
    const std::string data = raw(place) + raw(uv) + raw(corners) + image;
    std::string primitives, accessors;
    for (const int k : {0, 1, 2}) {
        primitives += fmt::format(R"({}{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":{}{}}})",
                                  k > 0 ? "," : "", k + 2, k < 2 ? fmt::format(R"(,"material":{})", k) : "");
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

TEST(SourceMeshes, EndWhereTheFileIsCutShort) {
    for (const std::string& whole_file : {binary_fbx(true), binary_fbx(false)})
        for (std::size_t size = 0; size <= whole_file.size(); ++size)
            for (const PolygonSoup& soup : fbx_meshes(std::string_view(whole_file).substr(0, size)))
                for (const long long v : soup.corners)
                    ASSERT_LT(v, static_cast<long long>(soup.points.size()));
    const std::string text = collada();
    for (std::size_t size = 0; size <= text.size(); ++size)
        for (const PolygonSoup& soup : collada_meshes(std::string_view(text).substr(0, size)))
            for (const long long v : soup.corners) ASSERT_LT(v, static_cast<long long>(soup.points.size()));
}

TEST(SourceMeshes, EndWhereTheFileIsDamaged) {
    const std::string fbx = binary_fbx(true), dae = collada();
    for (std::size_t at = 0; at < std::max(fbx.size(), dae.size()); ++at)
        for (const char byte : {'\0', '\xff', '9'}) {
            std::string bytes = fbx;
            if (at < bytes.size()) bytes[at] = byte;
            fbx_meshes(bytes);
            bytes = dae;
            if (at < bytes.size()) bytes[at] = byte;
            collada_meshes(bytes);
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
