#include "stages/remesh/remesh.h"

#include <fmt/format.h>

#include <algorithm>

#include "varimap/core/error.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh_files/polygon_cutting.h"

namespace varimap {

TriangleMesh file_as_read(const Surface& surface) {
    return surface.link.is_identity() ? input_as_read(surface) : surface.link.file;
}

namespace {

/// Places for vertices without an image.
Points fallback_positions(const TriangleMesh& file, const Surface& source, const Surface& target) {
    Points places = file.vertices;
    places.rowwise() -= source.centre.transpose();
    places *= source.scale / target.scale;
    places.rowwise() += target.centre.transpose();
    for (Eigen::Index v = 0; v < places.rows(); ++v)
        if (!places.row(v).allFinite()) places.row(v) = target.centre.transpose();
    return places;
}

Faces faces_with_images(const Faces& faces, const PointMap& map) {
    std::vector<int> left;
    for (int f = 0; f < int(faces.rows()); ++f) {
        bool has_images = true;
        for (const int v : faces.row(f)) has_images = has_images && map[std::size_t(v)].face >= 0;
        if (has_images) left.push_back(f);
    }
    return faces(left, Eigen::all);
}

/// Adds a polygon unless a corner of it has no image; whether it did.
bool add_if_mapped(std::vector<long long> corners, const PointMap& map, bool reversed, PolygonSoup& soup) {
    for (const long long v : corners)
        if (map[std::size_t(v)].face < 0) return false;
    if (reversed) std::reverse(corners.begin() + 1, corners.end());
    soup.corners.insert(soup.corners.end(), corners.begin(), corners.end());
    soup.end_polygon();
    return true;
}

}  // namespace

TriangleMesh cross_remesh(const PointMap& map, const Surface& source, const Surface& target) {
    const TriangleMesh file = file_as_read(source);
    Faces faces = faces_with_images(file.faces, map);
    if (source.mirrored != target.mirrored) faces.col(1).swap(faces.col(2));
    return {image_positions(map, file_as_read(target), fallback_positions(file, source, target)), faces,
            target.input.space};
}

PolygonSoup cross_remeshed_polygons(const TriangleMesh& moved, const PolygonSoup& polygons,
                                    const PointMap& map, const Surface& source, const Surface& target) {
    if (triangulated(polygons) != file_as_read(source).faces)
        throw InputError("the polygons are not those of the mesh that the surface was made from");
    PolygonSoup result;
    result.space = moved.space;
    for (const auto vertex : moved.vertices.rowwise()) result.points.push_back(vertex.transpose());
    const bool reversed = source.mirrored != target.mirrored;
    const std::vector<long long>& corners = polygons.corners;
    const auto triangles = triangle_corners(polygons);
    std::size_t first = 0, triangle = 0;
    for (const std::size_t end : polygons.ends) {
        const std::size_t triangles_end = triangle + (end - first) - 2;
        const std::vector<long long> polygon(corners.begin() + std::ptrdiff_t(first),
                                             corners.begin() + std::ptrdiff_t(end));
        const bool is_whole = add_if_mapped(polygon, map, reversed, result);
        for (std::size_t t = triangle; t < triangles_end && !is_whole; ++t) {
            const auto& [a, b, c] = triangles[t];
            add_if_mapped({corners[a], corners[b], corners[c]}, map, reversed, result);
        }
        first = end;
        triangle = triangles_end;
    }
    return result;
}

std::string masses_csv(const Surface& surface, const std::vector<int>& samples,
                       const Eigen::VectorXd& transported, const Eigen::VectorXd& mass) {
    std::vector<int> sample_at(std::size_t(surface.mesh.vertex_count()), -1);
    for (std::size_t k = 0; k < samples.size(); ++k) sample_at[std::size_t(samples[k])] = int(k);
    std::string text = "vertex,ratio\n";
    for (int i = 0; i < file_of(surface).vertex_count(); ++i) {
        const int vertex = surface.link.is_identity() ? i : surface.link.vertex[std::size_t(i)];
        if (vertex < 0) continue;
        const SurfacePoint& point = surface.on_mesh[std::size_t(vertex)];
        if (point.face < 0) continue;
        double ratio = 0;
        bool known = true;
        for (const auto [corner, weight] : WeightedCorners(surface.mesh, point)) {
            const int k = sample_at[std::size_t(corner)];
            known = known && k >= 0;
            if (known) ratio += weight * transported[k] / mass[k];
        }
        if (known) text += fmt::format("{},{}\n", i, ratio);
    }
    return text;
}

std::string vertices_csv(const Surface& surface) {
    std::string text = "vertex,fate,twin\n";
    const FileLink& link = surface.link;
    for (std::size_t v = 0; v < surface.on_mesh.size() && link.is_identity(); ++v)
        if (surface.on_mesh[v].face < 0) text += fmt::format("{},{},\n", v, name_of(VertexFate::unused));
    for (std::size_t v = 0; v < link.vertex.size(); ++v) {
        if (link.fate[v] == VertexFate::kept) continue;
        const bool has_twin = link.fate[v] == VertexFate::welded;
        text += fmt::format("{},{},{}\n", v, name_of(link.fate[v]),
                            has_twin ? std::to_string(link.origin[std::size_t(link.vertex[v])]) : "");
    }
    return text;
}

}  // namespace varimap
