#include "common/mapping/vertex_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "common/artifact/artifact.h"
#include "common/stage/error.h"
#include "common/stage/log.h"

namespace varimap {

namespace {

/// A coordinate in a list may be rounded by this much, relative to the mesh's bounding box diagonal.
constexpr double coordinate_tolerance = 1e-4;

struct Row {
    int line;
    std::vector<double> numbers;
};

/// A vertex that a line of a file names.
struct Named {
    int line, vertex;
};

[[noreturn]] void fail(const std::string& path, int line, const std::string& message) {
    throw InputError(fmt::format("{}:{}: {}", path, line, message));
}

std::vector<double> parse_numbers(std::string_view text, const std::string& path, int line) {
    constexpr std::string_view blank = " \t\r\v\f";
    std::vector<double> numbers;
    text = text.substr(0, text.find('#'));
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(blank), text.size()));
        if (text.empty()) return numbers;
        const std::string_view token = text.substr(0, text.find_first_of(blank));
        double number = 0;
        const auto [end, status] = std::from_chars(token.data(), token.data() + token.size(), number);
        if (status != std::errc() || end != token.data() + token.size() || !std::isfinite(number))
            fail(path, line, fmt::format("'{}' is not a number", token.substr(0, 40)));
        numbers.push_back(number);
        text.remove_prefix(token.size());
    }
}

/// The lines that hold something. Each must have one of the two counts of numbers.
std::vector<Row> read_rows(const std::string& path, size_t count, size_t other_count, const char* expected) {
    const std::string bytes = read_file(path);
    std::string_view text = bytes;
    std::vector<Row> rows;
    for (int line = 1; !text.empty(); ++line) {
        const size_t end = std::min(text.find('\n'), text.size());
        auto numbers = parse_numbers(text.substr(0, end), path, line);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (numbers.empty()) continue;
        if (numbers.size() != count && numbers.size() != other_count)
            fail(path, line, fmt::format("expected {}, found {} number(s)", expected, numbers.size()));
        rows.push_back({line, std::move(numbers)});
    }
    if (rows.empty()) throw InputError(path + ": holds no vertex numbers");
    return rows;
}

int to_vertex(const Row& row, size_t column, int first, const std::string& path, const TriangleMesh* mesh) {
    const double number = row.numbers[column];
    if (number != std::floor(number) || std::abs(number) > 2e9)
        fail(path, row.line, fmt::format("{} is not a vertex number", number));
    const int vertex = int(number) - first;
    if (vertex < 0)
        fail(path, row.line, fmt::format("vertex {} is out of range: numbers start at {}", number, first));
    if (mesh && vertex >= mesh->vertex_count())
        fail(path, row.line,
             fmt::format("vertex {} is out of range: the mesh has {} vertices, numbered from {} to {}{}",
                         number, mesh->vertex_count(), first, mesh->vertex_count() - 1 + first,
                         first == 0 && vertex == mesh->vertex_count() ? "; do the numbers start at 1?" : ""));
    return vertex;
}

/// Which first number makes more rows' coordinates those of the mesh's vertices; nothing if neither makes
/// half of them.
std::optional<int> base_from_coordinates(const std::vector<Row>& rows, const TriangleMesh& mesh) {
    const Vec3 extent = mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
    size_t matches[2] = {0, 0};
    for (const Row& row : rows) {
        if (row.numbers.size() < 4) continue;
        const Vec3 point(row.numbers[1], row.numbers[2], row.numbers[3]);
        for (int base : {0, 1}) {
            const double v = row.numbers[0] - base;
            if (v < 0 || v >= mesh.vertex_count()) continue;
            const double distance = (mesh.vertex(int(v)) - point).norm();
            matches[base] += distance <= coordinate_tolerance * extent.norm();
        }
    }
    if (2 * std::max(matches[0], matches[1]) < rows.size()) return {};
    return matches[1] > matches[0] ? 1 : 0;
}

/// Coordinates that are all the same (some programs write zeros) say nothing.
bool carries_coordinates(const std::vector<Row>& rows) {
    for (const Row& row : rows)
        if (row.numbers.size() == 4 && rows[0].numbers.size() == 4 &&
            !std::equal(row.numbers.begin() + 1, row.numbers.end(), rows[0].numbers.begin() + 1))
            return true;
    return false;
}

int first_number(const std::vector<Row>& rows, IndexBase base, const TriangleMesh* mesh,
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

std::vector<Named> read_list(const std::string& path, IndexBase base, const TriangleMesh* mesh) {
    const auto rows = read_rows(path, 1, 4, "a vertex number, alone or followed by x y z");
    const int first = first_number(rows, base, mesh, path);
    std::vector<Named> list;
    for (const Row& row : rows) list.push_back({row.line, to_vertex(row, 0, first, path, mesh)});
    return list;
}

/// One column (0 source, 1 target) of a file of pairs.
std::vector<Named> read_column(const std::string& path, size_t column, const TriangleMesh* mesh) {
    std::vector<Named> list;
    for (const Row& row : read_rows(path, 2, 2, "two vertex numbers, of the source and of the target"))
        list.push_back({row.line, to_vertex(row, column, 0, path, mesh)});
    return list;
}

void require_distinct_used(const std::vector<Named>& list, const std::string& path, const char* role,
                           const TriangleMesh& mesh) {
    std::vector<bool> used(size_t(mesh.vertex_count()), false);
    for (int v : mesh.faces.reshaped()) used[size_t(v)] = true;
    std::map<int, int> lines;
    for (const auto& [line, vertex] : list) {
        const auto [it, added] = lines.try_emplace(vertex, line);
        if (!added)
            fail(path, line,
                 fmt::format("{} vertex {} is already the landmark of line {}", role, vertex, it->second));
        if (!used[size_t(vertex)])
            fail(path, line, fmt::format("{} vertex {} belongs to no face of the mesh", role, vertex));
    }
}

bool is_vts(const std::string& path) {
    return path.size() >= 4 && path.substr(path.size() - 4) == ".vts";
}

}  // namespace

IndexBase index_base_from(const std::string& text) {
    if (text == "0") return IndexBase::zero;
    if (text == "1") return IndexBase::one;
    if (text == "auto") return IndexBase::automatic;
    throw UsageError("index base '" + text + "': use 0, 1 or auto");
}

std::vector<int> read_vertex_list(const std::string& path, IndexBase base, const TriangleMesh* mesh) {
    std::vector<int> vertices;
    for (const Named& named : read_list(path, base, mesh)) vertices.push_back(named.vertex);
    return vertices;
}

std::vector<std::pair<int, int>> read_landmark_pairs(const std::string& path) {
    const auto sources = read_column(path, 0, nullptr), targets = read_column(path, 1, nullptr);
    std::vector<std::pair<int, int>> pairs;
    for (size_t i = 0; i < sources.size(); ++i) pairs.emplace_back(sources[i].vertex, targets[i].vertex);
    return pairs;
}

std::vector<std::pair<int, int>> read_landmarks(const std::vector<std::string>& files,
                                                const TriangleMesh& source_input,
                                                const TriangleMesh& target_input) {
    if (files.size() != 1 && files.size() != 2)
        throw UsageError(
            "landmarks: give one file of pairs, or a list for the source and one for the target");
    const TriangleMesh* meshes[] = {&source_input, &target_input};
    std::vector<Named> lists[2];
    for (size_t side : {0, 1}) {
        const std::string& path = files[files.size() == 1 ? 0 : side];
        lists[side] =
            files.size() == 1
                ? read_column(path, side, meshes[side])
                : read_list(path, is_vts(path) ? IndexBase::automatic : IndexBase::zero, meshes[side]);
        require_distinct_used(lists[side], path, side == 0 ? "source" : "target", *meshes[side]);
    }
    if (lists[0].size() != lists[1].size())
        throw InputError(fmt::format("{} names {} vertices but {} names {}; landmarks are matched row by row",
                                     files[0], lists[0].size(), files[1], lists[1].size()));
    std::vector<std::pair<int, int>> pairs;
    for (size_t i = 0; i < lists[0].size(); ++i) pairs.emplace_back(lists[0][i].vertex, lists[1][i].vertex);
    return pairs;
}

}  // namespace varimap
