#include <fmt/format.h>

#include <cstring>
#include <functional>
#include <optional>

#include "fixtures/shapes.h"
#include "fuzz/target.h"
#include "stages/preprocess/preprocess.h"
#include "varimap/core/error.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/thin_faces.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_repair/bridges.h"

namespace varimap::fuzz {
namespace {

std::string obj(const TriangleMesh& mesh) {
    std::string text = "# SPACE=LPS\nmtllib a.mtl\n";
    for (int v = 0; v < mesh.vertex_count(); ++v)
        text += fmt::format("v {} {} {}\n", mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2));
    for (int f = 0; f < mesh.face_count(); ++f)
        text += fmt::format("f {} {}/1 {}//2\n", mesh.faces(f, 0) + 1, mesh.faces(f, 1) + 1,
                            mesh.faces(f, 2) + 1);
    return text;
}

std::string lists(const TriangleMesh& mesh) {
    std::string text;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        text += fmt::format("{} {} {}\n", mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2));
    for (int f = 0; f < mesh.face_count(); ++f)
        text += fmt::format("3 {} {} {}\n", mesh.faces(f, 0), mesh.faces(f, 1), mesh.faces(f, 2));
    return text;
}

std::string off(const TriangleMesh& mesh) {
    return fmt::format("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.face_count()) + lists(mesh);
}

std::string ascii_ply(const TriangleMesh& mesh) {
    return fmt::format(
               "ply\nformat ascii 1.0\ncomment SPACE=RAS\nelement vertex {}\nproperty float x\nproperty "
               "float y\n"
               "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
               mesh.vertex_count(), mesh.face_count()) +
           lists(mesh);
}

const char* const strips_ply =
    "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
    "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n11 0 1 2 3 -1 2 3 4 4 5 3\n";

std::string binary_stl(const TriangleMesh& mesh) {
    std::string bytes(80, ' ');
    const auto put = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    put(mesh.face_count());
    for (int f = 0; f < mesh.face_count(); ++f) {
        bytes.append(12, '\0');
        for (int s = 0; s < 9; ++s) put(float(mesh.vertices(mesh.faces(f, s / 3), s % 3)));
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string ascii_stl(const TriangleMesh& mesh) {
    std::string text = "solid a\n";
    for (int f = 0; f < mesh.face_count(); ++f) {
        text += "facet normal 0 0 1\n outer loop\n";
        for (int c = 0; c < 3; ++c) {
            const Vec3 p = mesh.vertex(mesh.faces(f, c));
            text += fmt::format("  vertex {} {} {}\n", p[0], p[1], p[2]);
        }
        text += " endloop\nendfacet\n";
    }
    return text + "endsolid a\n";
}

/// What is repaired must not be refused.
void require_good(const std::function<void()>& require) {
    try {
        require();
    } catch (const InputError& error) {
        throw std::logic_error(std::string("a repaired mesh is refused: ") + error.what());
    }
}

/// What the reader lets through keeps its word, and is refused or served by what comes next.
void read(const std::string& bytes, const std::string& name) {
    const TriangleMesh file = parse_mesh(bytes, name);
    if (file.faces.minCoeff() < 0 || file.faces.maxCoeff() >= file.vertex_count())
        throw std::logic_error("the reader gave a bad mesh");
    const TriangleMesh mesh = bridged(repaired(file, {}, name)).mesh;
    require_good([&] { require_manifold(mesh, name); });
    const ThinFaceRemoval repair = remove_thin_faces(mesh, 1e-6);
    if (repair.collapsed + repair.turned > 0) require_good([&] { require_manifold(repair.mesh, name); });
}

/// As varimap-preprocess does; what it writes can be read.
void make_surface(const std::string& bytes) {
    Surface copy;
    decode(encode(preprocess(bridged(repaired(parse_mesh(bytes, "a.off"), {}, "a.off")), {})), copy);
}

}  // namespace

std::vector<Target> mesh_targets() {
    std::vector<std::string> objs, offs, plys, stls;
    int cap;
    for (const TriangleMesh& mesh : {shapes::ellipsoid(0), shapes::square(2),
                                     shapes::with_cap(shapes::ellipsoid(0, {1, 2, 3}), 0, cap)}) {
        objs.push_back(obj(mesh));
        offs.push_back(off(mesh));
        plys.insert(plys.end(), {ascii_ply(mesh), to_ply(mesh), strips_ply});
        stls.insert(stls.end(), {ascii_stl(mesh), binary_stl(mesh)});
    }
    const auto reader = [](const std::string& name) {
        return [=](const std::string& bytes) { read(bytes, name); };
    };
    return {{"obj", objs, {"v", "f", "1/2/3", "1//3", "-1", "\\", "#", "vn", "g"}, reader("a.obj")},
            {"off", offs, {"OFF", "COFF", "NOFF", "4OFF", "nOFF", "BINARY", "#", "\\"}, reader("a.off")},
            {"ply",
             plys,
             {"ply",
              "format",
              "ascii",
              "binary_little_endian",
              "binary_big_endian",
              "1.0",
              "element",
              "vertex",
              "face",
              "tristrips",
              "property",
              "list",
              "uchar",
              "int",
              "uint",
              "float",
              "double",
              "char",
              "x",
              "vertex_indices",
              "vertex_index",
              "end_header",
              "comment",
              "obj_info"},
             reader("a.ply")},
            {"stl", stls, {"solid", "facet", "vertex", "endloop", "endfacet", "endsolid"}, reader("a.stl")},
            // Bisected to 10,000 vertices at most, however small the input: about 1 kB each.
            {"preprocess", offs, {"OFF"}, make_surface, 16 << 20}};
}

}  // namespace varimap::fuzz
