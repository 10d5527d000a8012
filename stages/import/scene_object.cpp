#include "stages/import/scene_object.h"

#include <algorithm>
#include <map>
#include <utility>

namespace varimap {

namespace {

struct LessByCoordinates {
    bool operator()(const Vec3& a, const Vec3& b) const {
        return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    }
};

bool every_corner_has_a_vertex(const PolygonSoup& soup) {
    std::vector<char> used(soup.points.size(), 0);
    for (const long long v : soup.corners)
        if (std::exchange(used[std::size_t(v)], 1)) return false;
    return true;
}

/// Corners in the same place become one vertex.
void join_corners(PolygonSoup& soup) {
    std::map<Vec3, long long, LessByCoordinates> number;
    std::vector<Vec3> points;
    for (long long& corner : soup.corners) {
        const Vec3& place = soup.points[std::size_t(corner)];
        if (!place.allFinite()) {  // equal to nothing
            points.push_back(place);
            corner = static_cast<long long>(points.size()) - 1;
            continue;
        }
        const auto [entry, added] = number.try_emplace(place, static_cast<long long>(points.size()));
        if (added) points.push_back(place);
        corner = entry->second;
    }
    soup.points = std::move(points);
}

/// Assimp's numbers are of single precision, and it reads decimal ones in a way of its own.
bool same_place(const Vec3& a, const Vec3& b) {
    if (!a.allFinite() || !b.allFinite()) return a.allFinite() == b.allFinite();
    return (a - b).cwiseAbs().maxCoeff() <= 1e-5 * std::max(a.cwiseAbs().maxCoeff(), 1e-30);
}

bool same_polygon(const PolygonSoup& a, std::size_t i, const PolygonSoup& b, std::size_t j) {
    const std::size_t at = polygon_begin(a, i), other = polygon_begin(b, j), size = a.ends[i] - at;
    if (b.ends[j] - other != size) return false;
    for (std::size_t k = 0; k < size; ++k)
        if (!same_place(a.points[std::size_t(a.corners[at + k])],
                        b.points[std::size_t(b.corners[other + k])]))
            return false;
    return true;
}

/// Which polygon of the file's mesh each of the object's is: those of one material after those of another,
/// each in the file's order. Empty where they are not the same.
std::vector<std::size_t> polygons_in(const PolygonSoup& file, const PolygonSoup& object) {
    if (file.ends.size() != object.ends.size()) return {};
    std::vector<char> taken(file.ends.size(), 0);
    std::vector<std::size_t> result;
    std::size_t next = 0, passes = 0;
    for (std::size_t p = 0; p < object.ends.size(); ++p) {
        while (next < taken.size() && (taken[next] || !same_polygon(object, p, file, next))) ++next;
        if (next == taken.size()) {  // another material begins
            constexpr std::size_t most_materials = 1000;
            if (++passes > most_materials) return {};
            next = 0;
            while (next < taken.size() && (taken[next] || !same_polygon(object, p, file, next))) ++next;
            if (next == taken.size()) return {};
        }
        taken[next] = 1;
        result.push_back(next++);
    }
    return result;
}

/// The object with the points and polygons of the file's mesh that it is; false where it is none of these.
bool take_from(const std::vector<PolygonSoup>& meshes, SceneObject& object) {
    for (const PolygonSoup& mesh : meshes) {
        const std::vector<std::size_t> place = polygons_in(mesh, object.soup);
        if (place.empty()) continue;
        std::vector<unsigned> material(place.size());
        for (std::size_t p = 0; p < place.size(); ++p) material[place[p]] = object.material[p];
        std::vector<Eigen::Vector2d> uv(object.uv.empty() ? 0 : mesh.corners.size());
        for (std::size_t p = 0; p < place.size() && !uv.empty(); ++p)
            std::copy(object.uv.begin() + std::ptrdiff_t(polygon_begin(object.soup, p)),
                      object.uv.begin() + std::ptrdiff_t(object.soup.ends[p]),
                      uv.begin() + std::ptrdiff_t(polygon_begin(mesh, place[p])));
        object = {mesh, std::move(uv), std::move(material)};
        return true;
    }
    return false;
}

}  // namespace

std::size_t polygon_begin(const PolygonSoup& soup, std::size_t polygon) {
    return polygon == 0 ? 0 : soup.ends[polygon - 1];
}

void share_vertices(const std::vector<PolygonSoup>& meshes, SceneObject& object) {
    if (!take_from(meshes, object) && every_corner_has_a_vertex(object.soup)) join_corners(object.soup);
}

}  // namespace varimap
