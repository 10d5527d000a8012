#include "varimap/mesh_files/obj_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "varimap/core/error.h"
#include "varimap/core/index_set.h"
#include "varimap/mesh_files/polygon_cutting.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

namespace {

int number_of(const std::string& name, std::vector<std::string>& names) {
    const auto number = std::find(names.begin(), names.end(), name) - names.begin();
    if (number == std::ssize(names)) names.push_back(name);
    return int(number);
}

/// The texture coordinates of a corner such as 7/2 or 7/2/1: 0-based; -1: none.
int corner_uv(const TextScanner& scanner, std::string_view word, std::size_t count) {
    const std::size_t slash = word.find('/');
    if (slash == word.npos) return -1;
    word.remove_prefix(slash + 1);
    word = word.substr(0, word.find('/'));
    if (word.empty()) return -1;
    long long index;
    const auto limit = static_cast<long long>(count);
    if (!to_integer(word, index) || index == 0 || index > limit || index < -limit)
        scanner.fail("a corner of a face names texture coordinates that are not there");
    return int(index > 0 ? index - 1 : limit + index);
}

double texture_coordinate(const TextScanner& scanner, std::size_t i, const char* what) {
    const double number = scanner.number(i, what);
    if (!std::isfinite(number)) scanner.fail(fmt::format("{} is not finite", what));
    return number;
}

/// What the polygons of an OBJ file say beside their vertices.
struct PolygonUv {
    std::vector<int> uv;             ///< of all corners, one polygon after the other; -1: none
    std::vector<std::size_t> sizes;  ///< per polygon
};

void add_face(const TextScanner& scanner, int material, ObjModel& model, PolygonUv& polygons) {
    const auto& words = scanner.words();
    const std::size_t size = words.size() - 1;
    for (std::size_t i = 1; i < words.size(); ++i)
        polygons.uv.push_back(corner_uv(scanner, words[i], model.uv.size()));
    polygons.sizes.push_back(size);
    if (size > 2) model.material.insert(model.material.end(), size - 2, material);
}

/// Per triangle, as read_mesh cuts polygons.
Faces uv_of_triangles(const PolygonUv& polygons, std::string_view bytes, const std::string& path) {
    const auto is_triangle = [](std::size_t size) { return size == 3; };
    if (std::all_of(polygons.sizes.begin(), polygons.sizes.end(), is_triangle))
        return Faces::Map(polygons.uv.data(), Eigen::Index(polygons.sizes.size()), 3);
    const auto triangles = triangle_corners(parse_polygons(bytes, path));
    Faces uv(Eigen::Index(triangles.size()), 3);
    for (std::size_t f = 0; f < triangles.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            uv(Eigen::Index(f), Eigen::Index(k)) = polygons.uv[triangles[f][k]];
    return uv;
}

/// 7/2/1 as 7/2, 7//1 as 7.
std::string without_normal(std::string_view corner) {
    const std::size_t first = corner.find('/');
    if (first == corner.npos) return std::string(corner);
    const std::size_t second = corner.find('/', first + 1);
    return std::string(corner.substr(0, second == first + 1 ? first : second));
}

std::string vertex_line(const std::vector<std::string_view>& words, const Points& vertices, Eigen::Index v) {
    std::string line = fmt::format("v {} {} {}", vertices(v, 0), vertices(v, 1), vertices(v, 2));
    for (std::size_t i = 4; i < words.size(); ++i) line += fmt::format(" {}", words[i]);  // colours
    return line + "\n";
}

std::string face_line(std::vector<std::string_view> words, bool turned) {
    if (turned && words.size() > 2) std::reverse(words.begin() + 2, words.end());
    std::string line = "f";
    for (std::size_t i = 1; i < words.size(); ++i) line += fmt::format(" {}", without_normal(words[i]));
    return line + "\n";
}

/// What stands first: the axes, which readers look for in front of everything else, and the materials.
std::string head_of(Space space, const std::string& library) {
    std::string text;
    if (space != Space::unstated) text += fmt::format("# {}\n", statement_of(space));
    if (!library.empty()) text += fmt::format("mtllib {}\n", library);
    return text;
}

bool states_space(std::string_view line) {
    return line.starts_with('#') && stated_space(line) != Space::unstated;
}

/// Faces without a material first: behind a `usemtl` every face has one.
std::vector<int> order_of_faces(const std::vector<int>& material) {
    std::vector<int> faces = all_indices(std::ssize(material));
    std::stable_partition(faces.begin(), faces.end(), [&](int f) { return material[std::size_t(f)] < 0; });
    return faces;
}

}  // namespace

ObjModel parse_obj_model(std::string_view bytes, const std::string& path) {
    ObjModel model;
    PolygonUv polygons;
    int material = -1;
    TextScanner scanner(without_byte_order_mark(bytes, path), path);
    while (scanner.next_line()) {
        const std::string_view word = scanner.words()[0];
        if (word == "vt")
            model.uv.emplace_back(texture_coordinate(scanner, 1, "u"),
                                  scanner.words().size() > 2 ? texture_coordinate(scanner, 2, "v") : 0);
        else if (word == "f")
            add_face(scanner, material, model, polygons);
        else if (word == "usemtl")
            material = number_of(std::string(scanner.rest_of_line()), model.materials);
        else if (word == "mtllib")
            number_of(std::string(scanner.rest_of_line()), model.libraries);
    }
    model.uv_of = uv_of_triangles(polygons, bytes, path);
    return model;
}

std::string with_vertices(std::string_view obj, const Points& vertices, Space space,
                          const std::string& library, const std::string& path, bool turned) {
    std::string text = head_of(space, library);
    std::vector<std::string_view> words;
    Eigen::Index v = 0;
    obj = without_byte_order_mark(obj, path);
    while (!obj.empty()) {
        const std::string_view line = take_line(obj);
        const std::string_view statement = line.substr(0, line.find('#'));
        if (statement.ends_with('\\'))
            throw InputError(path + ": has lines joined by a backslash; save it without");
        words.clear();
        add_words(statement, words);
        const std::string_view word = words.empty() ? "" : words[0];
        if (word == "v" && v < vertices.rows()) {
            text += vertex_line(words, vertices, v);
        } else if (word == "f") {
            text += face_line(words, turned);
        } else if (word != "vn" && word != "mtllib" && word != "v" && !states_space(line)) {
            text += std::string(line) + "\n";
        }
        v += word == "v";
    }
    if (v != vertices.rows())
        throw InputError(
            fmt::format("{}: {} vertices, but the mesh of the map has {}", path, v, vertices.rows()));
    return text;
}

std::string to_obj(const TexturedMesh& textured, const std::string& library) {
    const auto& [mesh, model] = textured;
    std::string text = head_of(mesh.space, library);
    for (const auto vertex : mesh.vertices.rowwise())
        text += fmt::format("v {} {} {}\n", vertex[0], vertex[1], vertex[2]);
    for (const Vec2& uv : model.uv) text += fmt::format("vt {} {}\n", uv[0], uv[1]);
    int material = -1;
    for (const int f : order_of_faces(model.material)) {
        const int now = model.material[std::size_t(f)];
        if (now != material) text += fmt::format("usemtl {}\n", model.materials[std::size_t(now)]);
        material = now;
        text += "f";
        for (int k = 0; k < 3; ++k) {
            const int uv = model.uv_of(f, k);
            text += uv < 0 ? fmt::format(" {}", mesh.faces(f, k) + 1)
                           : fmt::format(" {}/{}", mesh.faces(f, k) + 1, uv + 1);
        }
        text += '\n';
    }
    return text;
}

}  // namespace varimap
