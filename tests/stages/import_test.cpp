#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <functional>

#include "fixtures/temporary_folder.h"
#include "stages/import/isolated.h"
#include "stages/import/scene.h"
#include "stages/import/source_meshes.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/mesh/io/mesh_file.h"

namespace varimap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class T>
std::string raw(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}
template <class T>
std::string raw(T value) {
    return raw(std::vector<T>{value});
}

/// Seven points, the third of which nothing names: two quads and a triangle that share an edge each.
const std::vector<double> points{0, 0, 0, 1, 0, 0, 9, 9, 9, 1, 1, 0, 0, 1, 0, 2, 0, .1, 2, 1.1, 0};
const std::vector<std::vector<int>> polygons{{0, 1, 3, 4}, {1, 5, 3}, {5, 6, 3, 1}};

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

std::string joined(const std::vector<double>& values) {
    return fmt::format("{}", fmt::join(values, " "));
}

/// The polygons of each material in a list of their own, as exporters write them.
std::string collada() {
    return fmt::format(
        R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="21">{0}</float_array><technique_common>
<accessor source="#pa" count="7" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<source id="n"><float_array id="na" count="3">0 0 1</float_array><technique_common>
<accessor source="#na" count="1" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><!-- <p>7 7 7</p> -->
<polylist material="a" count="2"><input semantic="NORMAL" source="#n" offset="1"/><input semantic="VERTEX" source="#v" offset="0"/>
<vcount>4 4</vcount><p>0 0 1 0 3 0 4 0 5 0 6 0 3 0 1 0</p></polylist>
<triangles material="b" count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>1 5 3</p></triangles>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node id="n1"><translate>1 2 3</translate>
<scale>2 2 2</scale><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)",
        joined(points));
}

TEST(Import, ColladaHasItsOwnPointsAndPolygons) {
    const TemporaryFolder folder;
    expect_the_file(import(folder, "a.dae", collada()), {polygons[0], polygons[2], polygons[1]});
}

std::vector<int> fbx_corners() {
    std::vector<int> corners;
    for (const auto& polygon : polygons) {
        corners.insert(corners.end(), polygon.begin(), polygon.end());
        corners.back() = -1 - corners.back();
    }
    return corners;
}

/// Nodes of binary FBX 7.4.
struct FbxNode {
    std::string name;
    std::vector<std::string> properties;
    std::vector<FbxNode> children = {};

    std::string bytes(std::size_t at) const {
        std::string list;
        for (const std::string& property : properties) list += property;
        std::string body;
        const std::size_t inside = at + 13 + name.size() + list.size();
        for (const FbxNode& child : children) body += child.bytes(inside + body.size());
        if (!children.empty()) body += std::string(13, '\0');
        return raw(std::uint32_t(inside + body.size())) + raw(std::uint32_t(properties.size())) +
               raw(std::uint32_t(list.size())) + char(name.size()) + name + list + body;
    }
};
std::string text(const std::string& value) {
    return "S" + raw(std::uint32_t(value.size())) + value;
}
std::string whole(int value) {
    return "I" + raw(std::int32_t(value));
}
std::string id(int value) {
    return "L" + raw(std::int64_t(value));
}
template <class T>
std::string array(char type, const std::vector<T>& values, bool deflated) {
    std::string stored = raw(values);
    if (deflated) {
        std::string packed(compressBound(uLong(stored.size())), '\0');
        auto size = uLongf(packed.size());
        compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                 reinterpret_cast<const Bytef*>(stored.data()), uLong(stored.size()));
        stored = packed.substr(0, size);
    }
    return type + raw(std::uint32_t(values.size())) + raw(std::uint32_t(deflated)) +
           raw(std::uint32_t(stored.size())) + stored;
}
FbxNode vector_property(const std::string& name, double x, double y, double z) {
    const auto number = [](double value) { return "D" + raw(value); };
    return {"P", {text(name), text(name), text(""), text("A"), number(x), number(y), number(z)}};
}

/// The polygons alternate between two materials.
std::string binary_fbx(bool deflated) {
    const std::string separator("\0\x01", 2);
    const FbxNode layer{"LayerElementMaterial",
                        {whole(7)},
                        {{"Version", {whole(101)}},
                         {"MappingInformationType", {text("ByPolygon")}},
                         {"ReferenceInformationType", {text("IndexToDirect")}},
                         {"Materials", {array('i', std::vector<int>{0, 1, 0}, deflated)}}}};
    const FbxNode use{
        "Layer",
        {whole(0)},
        {{"LayerElement", {}, {{"Type", {text("LayerElementMaterial")}}, {"TypedIndex", {whole(7)}}}}}};
    const FbxNode geometry{"Geometry",
                           {id(1001), text("g" + separator + "Geometry"), text("Mesh")},
                           {{"Vertices", {array('d', points, deflated)}},
                            {"PolygonVertexIndex", {array('i', fbx_corners(), deflated)}},
                            layer,
                            use}};
    const FbxNode model{
        "Model",
        {id(2001), text("m" + separator + "Model"), text("Mesh")},
        {{"Version", {whole(232)}},
         {"Properties70",
          {},
          {vector_property("Lcl Translation", 1, 2, 3), vector_property("Lcl Scaling", 2, 2, 2)}}}};
    const auto material = [&](int number) {
        return FbxNode{"Material",
                       {id(number), text("x" + separator + "Material"), text("")},
                       {{"Version", {whole(102)}}}};
    };
    const auto link = [&](int from, int to) { return FbxNode{"C", {text("OO"), id(from), id(to)}}; };
    const std::vector<FbxNode> top{
        {"FBXHeaderExtension", {}, {{"FBXHeaderVersion", {whole(1003)}}, {"FBXVersion", {whole(7400)}}}},
        {"Definitions", {}, {{"Version", {whole(100)}}}},
        {"Objects", {}, {geometry, model, material(3001), material(3002)}},
        {"Connections", {}, {link(2001, 0), link(1001, 2001), link(3001, 2001), link(3002, 2001)}}};
    std::string bytes = "Kaydara FBX Binary  " + std::string("\0\x1a\0", 3) + raw(std::uint32_t(7400));
    for (const FbxNode& node : top) bytes += node.bytes(bytes.size());
    return bytes + std::string(13 + 160, '\0');
}

TEST(Import, FbxHasItsOwnPointsAndPolygons) {
    const TemporaryFolder folder;
    expect_the_file(import(folder, "a.fbx", binary_fbx(true)), polygons);
    expect_the_file(import(folder, "b.fbx", binary_fbx(false)), polygons);
}

TEST(Import, FbxAsTextToo) {
    const std::string fbx = fmt::format(
        R"(; FBX 7.3.0 project file
FBXHeaderExtension:  {{
	FBXHeaderVersion: 1003
	FBXVersion: 7300
}}
Objects:  {{
	Geometry: 1001, "Geometry::Vertices:", "Mesh" {{
		Vertices: *21 {{
			a: {}
		}}
		PolygonVertexIndex: *11 {{
			a: {}
		}}
	}}
	Model: 2001, "Model::m", "Mesh" {{
		Version: 232
		Properties70:  {{
			P: "Lcl Translation", "Lcl Translation", "", "A",1,2,3
			P: "Lcl Scaling", "Lcl Scaling", "", "A",2,2,2
		}}
	}}
}}
Connections:  {{
	C: "OO",2001,0
	C: "OO",1001,2001
}}
)",
        fmt::join(points, ","), fmt::join(fbx_corners(), ","));
    const TemporaryFolder folder;
    expect_the_file(import(folder, "a.fbx", fbx), polygons);
}

/// Two primitives with one accessor of positions, below two nodes of which the second mirrors.
std::string glb() {
    const std::vector<float> place{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::vector<std::uint32_t> corners{0, 2, 1, 0, 1, 3};
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"children":[1,2],"translation":[0,0,5]},{"mesh":0},{"mesh":0,"scale":[-2,1,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},"indices":2}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
{"bufferView":1,"componentType":5125,"count":3,"type":"SCALAR"},
{"bufferView":1,"byteOffset":12,"componentType":5125,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
"buffers":[{"byteLength":72}]})";
    json.append((4 - json.size() % 4) % 4, ' ');
    const std::string data = raw(place) + raw(corners);
    return "glTF" + raw(std::uint32_t(2)) + raw(std::uint32_t(12 + 16 + json.size() + data.size())) +
           raw(std::uint32_t(json.size())) + "JSON" + json + raw(std::uint32_t(data.size())) +
           std::string("BIN\0", 4) + data;
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
    const TriangleMesh mesh = parse_mesh(to_obj(scene), "a.obj");
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
