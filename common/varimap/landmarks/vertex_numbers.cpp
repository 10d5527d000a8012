#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "varimap/core/log.h"
#include "varimap/core/whole_number.h"
#include "varimap/landmarks/private/named.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

namespace {

constexpr double rounding = 1e-4;  ///< of coordinates in a list, relative to the mesh's bounding box diagonal

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
            if (!(v >= 0 && v < mesh.vertex_count())) continue;  // NaN is missing
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

/// What is said of the first vertex's number, or coordinates tell.
std::optional<int> told_first(const std::vector<ListRow>& rows, IndexBase base, const TriangleMesh* mesh,
                              const std::string& path) {
    if (base != IndexBase::automatic) return number_of_first(base);
    const auto found = mesh ? base_from_coordinates(rows, *mesh) : std::nullopt;
    if (found || !carries_coordinates(rows)) return found;
    warn("{}: {}; taking its vertex numbers to start at 0", path,
         mesh ? "the coordinates are not those of the mesh's vertices"
              : "there is no mesh to compare its coordinates with");
    return 0;
}

void require_vertex_rows(const std::vector<ListRow>& rows, const std::string& path) {
    require_count(rows, path, {1, 4}, "a vertex number, alone or followed by x y z");
}

bool holds_number(const std::vector<ListRow>& rows, double number) {
    return std::ranges::any_of(rows, [&](const ListRow& row) { return row.numbers[0] == number; });
}

std::vector<Named> vertices_from(int first, const std::vector<ListRow>& rows, const std::string& path,
                                 const TriangleMesh* mesh) {
    std::vector<Named> list;
    for (const ListRow& row : rows)
        list.push_back({row.line, to_vertex(row, 0, first, path, mesh), row.name, {}, first});
    return list;
}

std::vector<ListRow> read_vertex_rows(const std::string& path) {
    std::vector<ListRow> rows = read_list_rows(path);
    require_vertex_rows(rows, path);
    return rows;
}

}  // namespace

int to_vertex(const ListRow& row, size_t column, int first, const std::string& path,
              const TriangleMesh* mesh) {
    const double number = row.numbers[column];
    if (std::isnan(number)) return no_vertex;
    if (!is_whole(number)) fail_at(path, row.line, fmt::format("{} is not a vertex number", number));
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

std::vector<Named> vertices_of_list(const std::vector<ListRow>& rows, const std::string& path, IndexBase base,
                                    const TriangleMesh* mesh) {
    require_vertex_rows(rows, path);
    return vertices_from(told_first(rows, base, mesh, path).value_or(0), rows, path, mesh);
}

std::vector<std::pair<int, int>> read_vertex_pairs(const std::string& source_list,
                                                   const std::string& target_list, IndexBase base,
                                                   const TriangleMesh* source, const TriangleMesh* target,
                                                   int source_count) {
    const std::vector<ListRow> rows_A = read_vertex_rows(source_list), rows_B = read_vertex_rows(target_list);
    const auto told_A = told_first(rows_A, base, source, source_list),
               told_B = told_first(rows_B, base, target, target_list);
    int first = 0;  // where nothing is told
    if ((!told_A || !told_B) && !holds_number(rows_A, 0) && !holds_number(rows_B, 0)) {
        const bool from_1 = holds_number(rows_A, source ? source->vertex_count() : source_count) ||
                            (target && holds_number(rows_B, target->vertex_count()));
        if (!from_1)
            warn(
                "{} and {}: nothing tells whether their vertices are counted from 0 or from 1; taking 0, "
                "which --index-base 0 or 1 decides",
                source_list, target_list);
        first = from_1 ? 1 : 0;
    }
    const std::vector<Named> lists[2]{vertices_from(told_A.value_or(first), rows_A, source_list, source),
                                      vertices_from(told_B.value_or(first), rows_B, target_list, target)};
    std::vector<std::pair<int, int>> pairs;
    for (const auto& [a, b] : matched(lists, {source_list, target_list}).pairs)
        pairs.emplace_back(a.vertex, b.vertex);
    return pairs;
}

}  // namespace varimap
