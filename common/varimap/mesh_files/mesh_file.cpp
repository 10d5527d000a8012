#include "varimap/mesh_files/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/mesh_files/ply_columns.h"
#include "varimap/mesh_files/polygon_cutting.h"
#include "varimap/mesh_files/polygon_soup.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {
namespace {

PolygonSoup parse(std::string_view bytes, const std::string& path) {
    if (bytes.empty()) throw InputError(path + ": the file is empty");
    bytes = without_byte_order_mark(bytes, path);
    if (has_ending(path, ".obj")) return parse_obj(bytes, path);
    if (has_ending(path, ".off")) return parse_off(bytes, path);
    if (has_ending(path, ".ply")) return parse_ply(bytes, path);
    if (has_ending(path, ".stl")) return parse_stl(bytes, path);
    throw InputError(
        path +
        ": the name's ending is none of .obj, .ply, .off, .stl; `varimap import` makes an OBJ file "
        "of other formats");
}

void require_valid(const PolygonSoup& soup, const std::string& path) {
    constexpr std::size_t limit = std::numeric_limits<int>::max() / 8;
    if (soup.ends.empty()) throw InputError(path + ": the file holds no faces");
    if (soup.points.size() > limit || soup.corners.size() > limit)
        throw InputError(path + ": the mesh is too large");
    for (std::size_t f = 0, c = 0; f < soup.ends.size(); ++f)
        for (; c < soup.ends[f]; ++c)
            if (soup.corners[c] < 0 || soup.corners[c] >= static_cast<long long>(soup.points.size()))
                throw InputError(
                    fmt::format("{}: face {} names a vertex outside the file's {} vertices (counted from 0)",
                                path, f, soup.points.size()));
}

Points vertices_of(const PolygonSoup& soup) {
    Points vertices(soup.points.size(), 3);
    for (std::size_t v = 0; v < soup.points.size(); ++v) vertices.row(v) = soup.points[v].transpose();
    return vertices;
}

TriangleMesh triangles_of(const PolygonSoup& soup) {
    TriangleMesh mesh;
    mesh.space = soup.space;
    mesh.vertices = vertices_of(soup);
    mesh.faces = triangulated(soup);
    return mesh;
}

std::string bytes_of(const std::string& path) {
    if (std::filesystem::is_directory(path)) throw IoError("cannot read '" + path + "': it is a folder");
    return read_file(path);
}

}  // namespace

Space stated_space(std::string_view comments) {
    if (comments.find("SPACE=LPS") != comments.npos) return Space::lps;
    return comments.find("SPACE=RAS") != comments.npos ? Space::ras : Space::unstated;
}

std::string_view statement_of(Space space) {
    return space == Space::lps ? "SPACE=LPS" : space == Space::ras ? "SPACE=RAS" : "";
}

Faces triangulated(const PolygonSoup& soup) {
    const auto triangles = triangle_corners(soup);
    Faces faces(Eigen::Index(triangles.size()), 3);
    for (std::size_t f = 0; f < triangles.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            faces(Eigen::Index(f), Eigen::Index(k)) = int(soup.corners[triangles[f][k]]);
    return faces;
}

PolygonSoup parse_polygons(std::string_view bytes, const std::string& path) {
    PolygonSoup soup = parse(bytes, path);
    require_valid(soup, path);
    return soup;
}

TriangleMesh read_mesh(const std::string& path) {
    return parse_mesh(bytes_of(path), path);
}

TriangleMesh parse_mesh(std::string_view bytes, const std::string& path) {
    return triangles_of(parse_polygons(bytes, path));
}

Points read_vertices(const std::string& path) {
    return vertices_of(parse(bytes_of(path), path));
}

PolygonSoup read_polygons(const std::string& path) {
    return parse_polygons(bytes_of(path), path);
}

std::string to_ply(const TriangleMesh& mesh, PlyFormat format) {
    return to_ply(mesh, {}, format);
}

}  // namespace varimap
