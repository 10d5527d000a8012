#include "varimap/landmarks/vertex_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/core/log.h"
#include "varimap/landmarks/private/named.h"
#include "varimap/mesh/topology.h"

namespace varimap {

Row row_of(const std::string& path, int line) {
    if (has_ending(path, ".json")) return {"point", fmt::format("{}: point {}", path, line)};
    return {"line", fmt::format("{}:{}", path, line)};
}

namespace {

std::vector<PickedPoint> points_of_rows(const std::vector<ListRow>& rows, size_t first_number) {
    std::vector<PickedPoint> points;
    for (const ListRow& row : rows) {
        const double* x = row.numbers.data() + first_number;
        const Vec3 position(x[0], x[1], x[2]);
        points.push_back({row.line, row.name, position, Space::unstated, !position.hasNaN()});
    }
    return points;
}

/// The list of one side: picked points, rows of coordinates, or vertex numbers.
std::vector<Named> read_side(const std::string& path, const TriangleMesh& mesh,
                             const LandmarkReading& reading) {
    if (is_picked_points(path)) return snapped_list(read_picked_points(path), path, mesh, reading.space);
    const auto rows = read_list_rows(path);
    if (rows[0].numbers.size() == 3) {
        require_count(rows, path, {3}, "the three coordinates of a point, as in the first row");
        return snapped_list(points_of_rows(rows, 0), path, mesh, reading.space);
    }
    return vertices_of_list(rows, path, reading.base, &mesh);
}

/// The rows of a file of pairs: of vertices, or of points (x y z x y z).
std::vector<ListRow> read_pair_rows(const std::string& path) {
    if (is_picked_points(path))
        throw UsageError(path + ": holds the points of one surface; give one such file for each");
    auto rows = read_list_rows(path);
    if (rows[0].numbers.size() == 6)
        require_count(rows, path, {6}, "two points, x y z x y z, as in the first row");
    else
        require_count(rows, path, {2}, "two vertex numbers, of the source and of the target");
    return rows;
}

/// Throws where vertex numbers fit the meshes only the other way round.
void require_source_first(const std::vector<ListRow>& rows, const std::string& path, int first,
                          const TriangleMesh* const (&meshes)[2]) {
    if (rows.empty() || rows[0].numbers.size() != 2) return;
    const auto fit = [&](std::size_t source_column) {
        return std::ranges::all_of(rows, [&](const ListRow& row) {
            return !(row.numbers[source_column] - first >= meshes[0]->vertex_count()) &&
                   !(row.numbers[1 - source_column] - first >= meshes[1]->vertex_count());
        });
    };
    if (!fit(0) && fit(1))
        throw InputError(
            path +
            ": source and target look exchanged: only so are there vertices of all its numbers; the "
            "source's stand first");
}

/// One side (0 source, 1 target) of such rows.
std::vector<Named> side_of_pairs(const std::vector<ListRow>& rows, const std::string& path, size_t side,
                                 const TriangleMesh& mesh, const LandmarkReading& reading) {
    if (rows[0].numbers.size() == 6)
        return snapped_list(points_of_rows(rows, 3 * side), path, mesh, reading.space);
    const int first = number_of_first(reading.base);
    std::vector<Named> list;
    for (const ListRow& row : rows)
        list.push_back({row.line, to_vertex(row, side, first, path, &mesh), row.name, {}, first});
    return list;
}

/// `at_vertex`: points_at_vertices of the mesh.
SurfacePoint place_of(const Named& named, const PointMap& at_vertex) {
    return named.point ? *named.point : at_vertex[size_t(named.vertex)];
}

void require_used(const std::vector<Named>& list, const std::string& path, const char* role,
                  const TriangleMesh& mesh, const std::vector<VertexFate>& fates) {
    std::vector<bool> used(size_t(mesh.vertex_count()), mesh.face_count() == 0);  // points of no surface
    for (int v : mesh.faces.reshaped()) used[size_t(v)] = true;
    for (const Named& named : list) {
        const auto v = size_t(named.vertex);
        if (named.vertex == no_vertex || used[v]) continue;
        const VertexFate fate = fates.empty() ? VertexFate::unused : fates[v];
        throw InputError(fmt::format("{}: {} vertex {} belongs to no face that is mapped: {}; choose another",
                                     row_of(path, named.line).place, role, named.number_in_file(),
                                     reason_without_face(fate)));
    }
}

void require_distinct(const std::vector<Named>& list, const std::string& path, const char* role) {
    std::map<int, int> lines;
    for (const Named& named : list) {
        if (named.vertex == no_vertex) continue;
        const auto [it, added] = lines.try_emplace(named.vertex, named.line);
        const Row row = row_of(path, named.line);
        if (!added)
            throw InputError(fmt::format("{}: {} vertex {} is already the landmark of {} {}", row.place, role,
                                         named.number_in_file(), row.unit, it->second));
    }
}

Landmarks to_landmarks(const MatchedLists& matched, const TriangleMesh& source, const TriangleMesh& target) {
    Landmarks landmarks;
    landmarks.left_out = matched.left_out;
    for (const auto& [a, b] : matched.pairs)
        landmarks.vertices.emplace_back(InputVertex{a.vertex}, InputVertex{b.vertex});
    const bool are_points = std::ranges::any_of(
        matched.pairs, [](const auto& pair) { return pair.first.point || pair.second.point; });
    if (!are_points) return landmarks;
    const PointMap at_source = points_at_vertices(source), at_target = points_at_vertices(target);
    for (const auto& [a, b] : matched.pairs)
        landmarks.points.emplace_back(place_of(a, at_source), place_of(b, at_target));
    return landmarks;
}

}  // namespace

std::vector<PlacedLandmark> read_placed_landmarks(const std::string& path, const TriangleMesh& mesh,
                                                  const LandmarkReading& reading) {
    const std::vector<Named> list = read_side(path, mesh, reading);
    require_used(list, path, "landmark", mesh, {});
    const PointMap at_vertex = points_at_vertices(mesh);
    std::vector<PlacedLandmark> landmarks;
    for (const Named& named : list)
        if (named.vertex != no_vertex) landmarks.push_back({named.name, place_of(named, at_vertex)});
    if (landmarks.empty()) throw InputError(path + ": all of its landmarks are missing or switched off");
    if (landmarks.size() < list.size())
        warn("{}: {} of {} landmarks are missing or switched off, and left out", path,
             list.size() - landmarks.size(), list.size());
    return landmarks;
}

PointPairs as_points(const Landmarks& landmarks, const TriangleMesh& source, const TriangleMesh& target) {
    if (!landmarks.points.empty()) return landmarks.points;
    const PointMap at_source = points_at_vertices(source), at_target = points_at_vertices(target);
    PointPairs points;
    for (const auto& [a, b] : landmarks.vertices)
        points.emplace_back(at_source[size_t(a.index)], at_target[size_t(b.index)]);
    return points;
}

bool holds_points(const std::string& path) {
    return is_picked_points(path) || read_list_rows(path)[0].numbers.size() == 3;
}

Landmarks read_landmarks(const std::vector<std::string>& files, const TriangleMesh& source_input,
                         const TriangleMesh& target_input, const LandmarkReading& reading, Repeats repeats,
                         const std::vector<VertexFate>& source_fates,
                         const std::vector<VertexFate>& target_fates) {
    if (files.size() != 1 && files.size() != 2)
        throw UsageError(
            "landmarks: give one file of pairs, or a list for the source and one for the target");
    const TriangleMesh* const meshes[] = {&source_input, &target_input};
    const bool are_pairs = files.size() == 1;
    const auto pairs = are_pairs ? read_pair_rows(files[0]) : std::vector<ListRow>{};
    require_source_first(pairs, files[0], number_of_first(reading.base), meshes);
    std::vector<Named> lists[2];
    for (size_t side : {0, 1}) {
        const std::string& path = files[are_pairs ? 0 : side];
        lists[side] = are_pairs ? side_of_pairs(pairs, path, side, *meshes[side], reading)
                                : read_side(path, *meshes[side], reading);
        const char* role = side == 0 ? "source" : "target";
        require_used(lists[side], path, role, *meshes[side], side == 0 ? source_fates : target_fates);
        if (repeats == Repeats::refuse) require_distinct(lists[side], path, role);
    }
    return to_landmarks(matched(lists, files), source_input, target_input);
}

}  // namespace varimap
