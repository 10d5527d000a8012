#include <fmt/format.h>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fuzz/scratch_file.h"
#include "fuzz/target.h"
#include "stages/transfer/points.h"
#include "stages/transfer/values.h"
#include "varimap/artifact/npy.h"
#include "varimap/mesh_files/obj_model.h"
#include "varimap/mesh_files/ply_columns.h"

namespace varimap::fuzz {
namespace {

/// A small surface mapped onto itself.
struct Fixture {
    const TriangleMesh mesh = shapes::ellipsoid(0);
    const Correspondence map{
        "a.obj", "b.obj", mesh, mesh, shapes::at_vertices(mesh), shapes::at_vertices(mesh)};
    const PointCarrier carrier{map.from, map.there, map.to};
};

const Fixture& fixture() {
    static const Fixture made;
    return made;
}

/// Read as each kind of value, carried, and written.
Target values(const std::string& name, const std::string& ending, const std::vector<std::string>& seeds,
              const std::vector<std::string>& dictionary) {
    return {name, seeds, dictionary, [=](const std::string& bytes) {
                const ScratchFile file(bytes, ending);
                const auto kind = ValueKind(bytes.size() % 3);
                const Correspondence& map = fixture().map;
                const ValueFile read = read_values(file.path(), kind, map.from, map.from_file);
                std::vector<ValueTable> carried;
                for (const ValueTable& table : read.tables)
                    carried.push_back(carry_values(table, kind, map, fixture().carrier));
                read.write(carried, map.to);
            }};
}

Target points(const std::string& name, const std::string& ending, const std::vector<std::string>& seeds,
              const std::vector<std::string>& dictionary) {
    return {name, seeds, dictionary, [=](const std::string& bytes) {
                const ScratchFile file(bytes, ending);
                carry_points(file.path(), {}, fixture().map, fixture().carrier);
            }};
}

std::string csv() {
    std::string text = "vertex;heat\n";
    for (int v = 0; v < fixture().map.from.vertex_count(); ++v) text += fmt::format("{};{}\n", v, .5 * v);
    return text;
}

std::string ply() {
    const TriangleMesh& mesh = fixture().map.from;
    PlyColumns columns;
    columns.vertex = {{"red", "uchar", std::vector<double>(std::size_t(mesh.vertex_count()), 7)}};
    columns.face = {{"part", "int", std::vector<double>(std::size_t(mesh.face_count()), -1)}};
    return to_ply(mesh, columns, PlyFormat::binary);
}

std::string textured_obj() {
    const TriangleMesh& mesh = fixture().map.from;
    ObjModel model;
    model.uv = {{0, 0}, {1, 0}, {0, 1}};
    model.uv_of = Faces(mesh.face_count(), 3);
    model.uv_of.rowwise() = Eigen::RowVector3i(0, 1, 2);
    model.material.assign(std::size_t(mesh.face_count()), 0);
    model.materials = {"skin"};
    return to_obj({mesh, model}, "a.mtl");
}

}  // namespace

std::vector<Target> transfer_targets() {
    const std::string npy = to_npy("<f8", {12, 1}, std::vector<double>(12, .25)) + std::string(8, '\0');
    const Target model{"obj_model",
                       {textured_obj()},
                       {"f 1/1 2/2 3/-1", "vt 0 nan", "usemtl", "mtllib ", "\\\n"},
                       [](const std::string& bytes) {
                           parse_obj_model(bytes, "a.obj");
                           with_vertices(bytes, fixture().map.to.vertices, Space::ras, "b.mtl", "a.obj");
                       }};
    return {
        values("npy_values", ".npy", {npy}, {"'<i4'", "True", "(12,)", "(0, 0)", "'shape': "}),
        values("text_values", ".csv", {csv()}, {";", ",", "\t", "nan", "1e400", "\"", "#"}),
        values("ply_values", ".ply", {ply()},
               {"property uchar red\n", "element face 0\n", "list ", "double"}),
        points("text_points", ".csv",
               {"0\n5\n11\n", "name,x,y,z\nnose,0,.526,.851\ntail,.526,.851,0\n", "0 .526 .851\n"},
               {",", "x", "y", "z", "nan", "#"}),
        points("fcsv_points", ".fcsv",
               {"\xef\xbb\xbf# CoordinateSystem = LPS\n1,0,.526,.851,0,0,0,1,1,1,0,tail,,\r\n"},
               {",", "#", "\xef\xbb\xbf"}),
        points("pp_points", ".pp",
               {"<PickedPoints>\n <point x=\"0\" y=\".526\" z=\".851\" name=\"nose\"/>\n</PickedPoints>\n"},
               {"<point ", "x=\"1\"", "active=\"0\"", ">", "\""}),
        points("json_points", ".mrk.json",
               {R"({"markups": [{"controlPoints": [{"label": "ear", "position": [0, 0.526, 0.851]},
                    {"label": "x", "positionStatus": "undefined"}]}]})"},
               {"null", "[]", "{}", "\"markups\"", "\"position\""}),
        model};
}

}  // namespace varimap::fuzz
