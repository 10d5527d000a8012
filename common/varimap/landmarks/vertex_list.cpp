#include "varimap/landmarks/vertex_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/core/log.h"
#include "varimap/core/printable.h"
#include "varimap/landmarks/list_rows.h"
#include "varimap/mesh/io/text_scanner.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

constexpr double rounding = 1e-4;  ///< of coordinates in a list, relative to the mesh's bounding box diagonal

constexpr int no_vertex = -1;  ///< of a point that is not defined

/// A vertex that a line of a file names, or a point of one without lines.
struct Named {
    int line, vertex;
    std::string name = {};                   ///< by which it is matched; empty: by its row
    std::optional<SurfacePoint> point = {};  ///< where it was picked, if not at the vertex
};

/// Where a landmark stands in its file: JSON counts points instead of lines.
struct Row {
    const char* unit;  ///< what is counted
    std::string place;
};
Row row_of(const std::string& path, int line) {
    if (has_ending(path, ".json")) return {"point", fmt::format("{}: point {}", path, line)};
    return {"line", fmt::format("{}:{}", path, line)};
}

int to_vertex(const ListRow& row, size_t column, int first, const std::string& path,
              const TriangleMesh* mesh) {
    const double number = row.numbers[column];
    if (number != std::floor(number) || std::abs(number) > 2e9)
        fail_at(path, row.line, fmt::format("{} is not a vertex number", number));
    const int vertex = int(number) - first;
    if (vertex < 0)
        fail_at(path, row.line, fmt::format("vertex {} is out of range: numbers start at {}", number, first));
    if (mesh && vertex >= mesh->vertex_count())
        fail_at(
            path, row.line,
            fmt::format("vertex {} is out of range: the mesh has {} vertices, numbered from {} to {}{}",
                        number, mesh->vertex_count(), first, mesh->vertex_count() - 1 + first,
                        first == 0 && vertex == mesh->vertex_count() ? "; do the numbers start at 1?" : ""));
    return vertex;
}

/// What a coordinate in a list may be off by. Vertices that no face uses may lie far off: they count only in
/// a mesh of points alone.
double coordinate_tolerance(const TriangleMesh& mesh) {
    if (mesh.face_count() == 0)
        return rounding * (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
    const auto [low, high] = bounding_box(mesh);
    return rounding * (high - low).norm();
}

/// Which first number makes more rows' coordinates those of the mesh's vertices; nothing if neither makes
/// half of them.
std::optional<int> base_from_coordinates(const std::vector<ListRow>& rows, const TriangleMesh& mesh) {
    const double tolerance = coordinate_tolerance(mesh);
    size_t matches[2] = {0, 0};
    for (const ListRow& row : rows) {
        if (row.numbers.size() < 4) continue;
        const Vec3 point(row.numbers[1], row.numbers[2], row.numbers[3]);
        for (int base : {0, 1}) {
            const double v = row.numbers[0] - base;
            if (v < 0 || v >= mesh.vertex_count()) continue;
            const double distance = (mesh.vertex(int(v)) - point).norm();
            matches[base] += distance <= tolerance;
        }
    }
    if (2 * std::max(matches[0], matches[1]) < rows.size()) return {};
    return matches[1] > matches[0] ? 1 : 0;
}

/// Coordinates that are all the same (some programs write zeros) say nothing.
bool carries_coordinates(const std::vector<ListRow>& rows) {
    for (const ListRow& row : rows)
        if (row.numbers.size() == 4 && rows[0].numbers.size() == 4 &&
            !std::equal(row.numbers.begin() + 1, row.numbers.end(), rows[0].numbers.begin() + 1))
            return true;
    return false;
}

int first_number(const std::vector<ListRow>& rows, IndexBase base, const TriangleMesh* mesh,
                 const std::string& path) {
    if (base != IndexBase::automatic) return base == IndexBase::one ? 1 : 0;
    const auto found = mesh ? base_from_coordinates(rows, *mesh) : std::nullopt;
    if (found) return *found;
    if (carries_coordinates(rows))
        warn("{}: {}; taking its vertex numbers to start at 0", path,
             mesh ? "the coordinates are not those of the mesh's vertices"
                  : "there is no mesh to compare its coordinates with");
    return 0;
}

std::vector<Named> vertices_of_list(const std::vector<ListRow>& rows, const std::string& path, IndexBase base,
                                    const TriangleMesh* mesh) {
    require_count(rows, path, {1, 4}, "a vertex number, alone or followed by x y z");
    const int first = first_number(rows, base, mesh, path);
    std::vector<Named> list;
    for (const ListRow& row : rows)
        list.push_back({row.line, to_vertex(row, 0, first, path, mesh), row.name});
    return list;
}

/// Points in the mesh's axes, as the vertices nearest to where they lie on the surface.
void place(std::vector<Named>& list, const std::vector<Vec3>& positions, const std::string& path,
           const TriangleMesh& mesh) {
    const Snapped snapped = snap(positions, mesh);
    const auto farthest = std::ranges::max_element(snapped.distances) - snapped.distances.begin();
    require_near(snapped, positions, mesh, row_of(path, list[std::size_t(farthest)].line).place, "landmarks");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string what =
            fmt::format("{}: landmark {}", row_of(path, list[i].line).place, excerpt(list[i].name));
        log("{} lies {:.4f} from the surface, in units of sqrt(area); vertex {}", what, snapped.distances[i],
            snapped.vertices[i]);
        if (snapped.distances[i] > far_from_surface)
            warn("{} lies far from the surface: is the list that of this mesh?", what);
        list[i].vertex = snapped.vertices[i];
        list[i].point = snapped.points[i];
    }
}

/// Points that are not defined keep their place in the list, so that rows still match, without a vertex.
std::vector<Named> snapped_list(const std::vector<PickedPoint>& picked, const std::string& path,
                                const TriangleMesh& mesh, LandmarkSpace space) {
    std::vector<Named> defined, list;
    std::vector<Vec3> positions;
    for (const PickedPoint& point : picked) {
        if (!point.defined) continue;
        defined.push_back({point.line, no_vertex, point.name});
        positions.push_back(in_axes_of(mesh, point, space));
    }
    if (defined.empty()) throw InputError(path + ": none of its points is defined");
    place(defined, positions, path, mesh);
    auto next = defined.begin();
    for (const PickedPoint& point : picked)
        list.push_back(point.defined ? *next++ : Named{point.line, no_vertex, point.name});
    if (defined.size() < picked.size())
        warn("{}: {} of {} points are not defined, or switched off, and are left out", path,
             picked.size() - defined.size(), picked.size());
    return list;
}

std::vector<PickedPoint> points_of_rows(const std::vector<ListRow>& rows, size_t first_number) {
    std::vector<PickedPoint> points;
    for (const ListRow& row : rows) {
        const double* x = row.numbers.data() + first_number;
        points.push_back({row.line, row.name, {x[0], x[1], x[2]}});
    }
    return points;
}

/// The list of one side: picked points, rows of coordinates, or vertex numbers.
std::vector<Named> read_side(const std::string& path, const TriangleMesh& mesh, LandmarkSpace space) {
    if (is_picked_points(path)) return snapped_list(read_picked_points(path), path, mesh, space);
    const auto rows = read_list_rows(path);
    if (rows[0].numbers.size() == 3) {
        require_count(rows, path, {3}, "the three coordinates of a point, as in the first row");
        return snapped_list(points_of_rows(rows, 0), path, mesh, space);
    }
    const bool may_start_at_1 = has_ending(path, ".vts") || has_ending(path, ".csv");
    return vertices_of_list(rows, path, may_start_at_1 ? IndexBase::automatic : IndexBase::zero, &mesh);
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

/// One side (0 source, 1 target) of such rows.
std::vector<Named> side_of_pairs(const std::vector<ListRow>& rows, const std::string& path, size_t side,
                                 const TriangleMesh& mesh, LandmarkSpace space) {
    if (rows[0].numbers.size() == 6) return snapped_list(points_of_rows(rows, 3 * side), path, mesh, space);
    std::vector<Named> list;
    for (const ListRow& row : rows)
        list.push_back({row.line, to_vertex(row, side, 0, path, &mesh), row.name});
    return list;
}

bool have_distinct_names(const std::vector<Named>& list) {
    std::set<std::string> names;
    for (const Named& named : list)
        if (named.name.empty() || !names.insert(named.name).second) return false;
    return true;
}

/// Names that one of two lists lacks, the first few of them.
std::string names_in_one(const std::vector<Named> (&lists)[2]) {
    constexpr size_t most = 12;
    std::map<std::string, int> count;
    for (const auto& list : lists)
        for (const Named& named : list) ++count[named.name];
    std::vector<std::string> names;
    for (const auto& [name, times] : count)
        if (times == 1) names.push_back(fmt::format("'{}'", excerpt(name)));
    const size_t shown = std::min(names.size(), most);
    const std::string list =
        fmt::format("{}", fmt::join(names.begin(), names.begin() + std::ptrdiff_t(shown), ", "));
    return names.size() > shown ? fmt::format("{} and {} more", list, names.size() - shown) : list;
}

/// A name that stands twice must not shift the others' partners in silence.
void warn_of_other_names(const std::vector<std::pair<Named, Named>>& rows,
                         const std::vector<std::string>& files) {
    const auto other = std::find_if(rows.begin(), rows.end(), [](const std::pair<Named, Named>& row) {
        return !row.first.name.empty() && !row.second.name.empty() && row.first.name != row.second.name;
    });
    if (other != rows.end())
        warn(
            "{} and {} are matched row by row, since a name is missing or stands twice, but row {} is '{}' "
            "and '{}'",
            files[0], files[1], other - rows.begin() + 1, excerpt(other->first.name),
            excerpt(other->second.name));
}

/// Row by row, or by name where all have one; names that only one list has are left out.
std::vector<std::pair<Named, Named>> matched(const std::vector<Named> (&lists)[2],
                                             const std::vector<std::string>& files) {
    std::vector<std::pair<Named, Named>> pairs;
    if (have_distinct_names(lists[0]) && have_distinct_names(lists[1])) {
        std::map<std::string, Named> target;
        for (const Named& named : lists[1]) target[named.name] = named;
        for (const Named& named : lists[0])
            if (const auto found = target.find(named.name); found != target.end())
                pairs.emplace_back(named, found->second);
        if (pairs.empty())
            throw InputError(fmt::format("{} and {} have no name in common", files[0], files[1]));
        if (pairs.size() < std::max(lists[0].size(), lists[1].size()))
            warn("{} landmarks are in both {} and {}; left out are {}", pairs.size(), files[0], files[1],
                 names_in_one(lists));
        return pairs;
    }
    if (lists[0].size() != lists[1].size())
        throw InputError(fmt::format("{} names {} vertices but {} names {}; landmarks are matched row by row",
                                     files[0], lists[0].size(), files[1], lists[1].size()));
    for (size_t i = 0; i < lists[0].size(); ++i) pairs.emplace_back(lists[0][i], lists[1][i]);
    warn_of_other_names(pairs, files);
    return pairs;
}

SurfacePoint place_of(const Named& named, const TriangleMesh& mesh) {
    return named.point ? *named.point : point_at_vertex(mesh, named.vertex);
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
                                     row_of(path, named.line).place, role, named.vertex,
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
                                         named.vertex, row.unit, it->second));
    }
}

}  // namespace

std::vector<int> read_vertex_list(const std::string& path, IndexBase base, const TriangleMesh* mesh) {
    std::vector<int> vertices;
    for (const Named& named : vertices_of_list(read_list_rows(path), path, base, mesh))
        vertices.push_back(named.vertex);
    return vertices;
}

std::vector<PlacedLandmark> read_placed_landmarks(const std::string& path, const TriangleMesh& mesh,
                                                  LandmarkSpace space) {
    const std::vector<Named> list = read_side(path, mesh, space);
    require_used(list, path, "landmark", mesh, {});
    std::vector<PlacedLandmark> landmarks;
    for (const Named& named : list)
        if (named.vertex != no_vertex) landmarks.push_back({named.name, place_of(named, mesh)});
    return landmarks;
}

PointPairs as_points(const Landmarks& landmarks, const TriangleMesh& source, const TriangleMesh& target) {
    if (!landmarks.points.empty()) return landmarks.points;
    PointPairs points;
    for (const auto& [a, b] : landmarks.vertices)
        points.emplace_back(point_at_vertex(source, a.index), point_at_vertex(target, b.index));
    return points;
}

bool holds_points(const std::string& path) {
    return is_picked_points(path) || read_list_rows(path)[0].numbers.size() == 3;
}

Landmarks read_landmarks(const std::vector<std::string>& files, const TriangleMesh& source_input,
                         const TriangleMesh& target_input, LandmarkSpace space, Repeats repeats,
                         const std::vector<VertexFate>& source_fates,
                         const std::vector<VertexFate>& target_fates) {
    if (files.size() != 1 && files.size() != 2)
        throw UsageError(
            "landmarks: give one file of pairs, or a list for the source and one for the target");
    const TriangleMesh* meshes[] = {&source_input, &target_input};
    const bool are_pairs = files.size() == 1;
    const auto pairs = are_pairs ? read_pair_rows(files[0]) : std::vector<ListRow>{};
    std::vector<Named> lists[2];
    for (size_t side : {0, 1}) {
        const std::string& path = files[are_pairs ? 0 : side];
        lists[side] = are_pairs ? side_of_pairs(pairs, path, side, *meshes[side], space)
                                : read_side(path, *meshes[side], space);
        const char* role = side == 0 ? "source" : "target";
        require_used(lists[side], path, role, *meshes[side], side == 0 ? source_fates : target_fates);
        if (repeats == Repeats::refuse) require_distinct(lists[side], path, role);
    }
    Landmarks landmarks;
    bool picked = false;
    for (const auto& [source, target] : matched(lists, files)) {
        if (source.vertex == no_vertex || target.vertex == no_vertex) continue;
        landmarks.vertices.emplace_back(InputVertex{source.vertex}, InputVertex{target.vertex});
        landmarks.points.emplace_back(place_of(source, source_input), place_of(target, target_input));
        picked = picked || source.point || target.point;
    }
    if (landmarks.vertices.empty()) throw InputError(files[0] + ": no landmark is defined on both surfaces");
    if (!picked) landmarks.points.clear();
    return landmarks;
}

}  // namespace varimap
