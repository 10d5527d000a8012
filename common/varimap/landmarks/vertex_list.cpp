#include "varimap/landmarks/vertex_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/core/log.h"
#include "varimap/core/printable.h"
#include "varimap/landmarks/csv_fields.h"
#include "varimap/landmarks/landmark_points.h"
#include "varimap/mesh/io/text_scanner.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

constexpr double rounding = 1e-4;  ///< of coordinates in a list, relative to the mesh's bounding box diagonal

struct Row {
    int line;
    std::vector<double> numbers;
    std::string name = {};  ///< of a line with commas, where it holds one
};

constexpr int no_vertex = -1;  ///< of a point that is not defined

/// A vertex that a line of a file names.
struct Named {
    int line, vertex;
    std::string name = {};                   ///< by which it is matched; empty: by its row
    std::optional<SurfacePoint> point = {};  ///< where it was picked, if not at the vertex
};

bool has_commas(const TextScanner& scanner) {
    return std::ranges::any_of(scanner.words(), [](auto word) { return word.find(',') != word.npos; });
}

/// What stands between the commas of a line.
std::vector<std::string> split_at_commas(const TextScanner& scanner) {
    const auto fields = csv_fields(fmt::format("{}", fmt::join(scanner.words(), " ")));
    if (!fields)
        scanner.fail(
            "a quote has no end before the line or, with #, its comment, or more than a comma behind it");
    return *fields;
}

/// Whether a column of that heading names landmarks, though they may be called 1, 2, 3. Tables are often
/// written with a first column of row numbers that has no heading.
bool is_heading_of_names(std::string heading) {
    std::ranges::transform(heading, heading.begin(), [](unsigned char c) { return std::tolower(c); });
    constexpr std::array headings{"", "name", "label", "id", "landmark", "point"};
    return std::ranges::find(headings, heading) != headings.end();
}

std::vector<double> numbers_of(std::span<const std::string> fields, const TextScanner& scanner) {
    std::vector<double> numbers;
    for (const std::string& field : fields) {
        double number;
        if (!to_number(field, number) || !std::isfinite(number))
            scanner.fail(fmt::format("'{}' is not a number", excerpt(field)));
        numbers.push_back(number);
    }
    return numbers;
}

/// A line with commas, whose first or last field may be a name.
Row row_with_commas(std::span<const std::string> fields, bool first_is_name, const TextScanner& scanner) {
    Row row{scanner.line(), {}};
    if (first_is_name || !is_number(fields.front())) {
        row.name = fields.front();
        fields = fields.subspan(1);
    } else if (!is_number(fields.back())) {
        row.name = fields.back();
        fields = fields.first(fields.size() - 1);
    }
    row.numbers = numbers_of(fields, scanner);
    return row;
}

/// The lines that hold something, without the headings of a table.
std::vector<Row> read_rows(const std::string& path) {
    const std::string bytes = read_file(path);
    TextScanner scanner(without_byte_order_mark(bytes, path), path);
    std::vector<Row> rows;
    bool first_is_name = false;
    for (bool first = true; scanner.next_line(); first = false) {
        if (!has_commas(scanner)) {
            const std::vector<std::string> words(scanner.words().begin(), scanner.words().end());
            rows.push_back({scanner.line(), numbers_of(words, scanner)});
            continue;
        }
        const std::vector<std::string> fields = split_at_commas(scanner);
        if (first && std::ranges::none_of(fields, is_number))
            first_is_name = is_heading_of_names(fields.front());
        else
            rows.push_back(row_with_commas(fields, first_is_name, scanner));
    }
    if (rows.empty()) throw InputError(path + ": holds no vertex numbers");
    return rows;
}

void require_count(const std::vector<Row>& rows, const std::string& path, size_t count, size_t other_count,
                   const char* expected) {
    for (const Row& row : rows)
        if (row.numbers.size() != count && row.numbers.size() != other_count)
            fail_at(path, row.line,
                    fmt::format("expected {}, found {} number(s)", expected, row.numbers.size()));
}

/// Lines that each have one of the two counts of numbers.
std::vector<Row> read_rows(const std::string& path, size_t count, size_t other_count, const char* expected) {
    auto rows = read_rows(path);
    require_count(rows, path, count, other_count, expected);
    return rows;
}

int to_vertex(const Row& row, size_t column, int first, const std::string& path, const TriangleMesh* mesh) {
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
std::optional<int> base_from_coordinates(const std::vector<Row>& rows, const TriangleMesh& mesh) {
    const double tolerance = coordinate_tolerance(mesh);
    size_t matches[2] = {0, 0};
    for (const Row& row : rows) {
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
    for (const Row& row : rows) list.push_back({row.line, to_vertex(row, 0, first, path, mesh), row.name});
    return list;
}

/// One column (0 source, 1 target) of a file of pairs of vertices.
std::vector<Named> read_column(const std::string& path, size_t column, const TriangleMesh* mesh) {
    std::vector<Named> list;
    for (const Row& row : read_rows(path, 2, 2, "two vertex numbers, of the source and of the target"))
        list.push_back({row.line, to_vertex(row, column, 0, path, mesh), row.name});
    return list;
}

/// Most of a list's points far from the surface: it is read wrongly, or belongs elsewhere.
void refuse_far_list(const std::vector<Named>& list, const std::vector<Vec3>& positions,
                     const std::vector<double>& distances, const std::string& path,
                     const TriangleMesh& mesh) {
    const auto far = std::count_if(distances.begin(), distances.end(),
                                   [](double distance) { return distance > far_from_surface; });
    if (2 * std::size_t(far) <= distances.size()) return;
    const auto farthest = std::max_element(distances.begin(), distances.end()) - distances.begin();
    throw InputError(
        fmt::format("{}:{}: {} of {} landmarks lie farther than {} from the surface, in units of sqrt(area), "
                    "this one {:.3g}; {}",
                    path, list[std::size_t(farthest)].line, far, list.size(), far_from_surface,
                    distances[std::size_t(farthest)], likely_cause(positions, mesh)));
}

/// Points in the mesh's axes, as the vertices nearest to where they lie on the surface.
void place(std::vector<Named>& list, const std::vector<Vec3>& positions, const std::string& path,
           const TriangleMesh& mesh) {
    const Snapped snapped = snap(positions, mesh);
    refuse_far_list(list, positions, snapped.distances, path, mesh);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string what = fmt::format("{}:{}: landmark {}", path, list[i].line, excerpt(list[i].name));
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

std::vector<PickedPoint> points_of_rows(const std::vector<Row>& rows, size_t first_number) {
    std::vector<PickedPoint> points;
    for (const Row& row : rows) {
        const double* x = row.numbers.data() + first_number;
        points.push_back({row.line, row.name, {x[0], x[1], x[2]}});
    }
    return points;
}

/// The list of one side: picked points, rows of coordinates, or vertex numbers.
std::vector<Named> read_side(const std::string& path, const TriangleMesh& mesh, LandmarkSpace space) {
    if (is_picked_points(path)) return snapped_list(read_picked_points(path), path, mesh, space);
    const auto rows = read_rows(path);
    if (rows[0].numbers.size() == 3) {
        require_count(rows, path, 3, 3, "the three coordinates of a point, as in the first row");
        return snapped_list(points_of_rows(rows, 0), path, mesh, space);
    }
    const bool may_start_at_1 = has_ending(path, ".vts") || has_ending(path, ".csv");
    return read_list(path, may_start_at_1 ? IndexBase::automatic : IndexBase::zero, &mesh);
}

/// One column (0 source, 1 target) of a file of pairs: of vertices, or of points (x y z x y z).
std::vector<Named> read_pair_side(const std::string& path, size_t column, const TriangleMesh& mesh,
                                  LandmarkSpace space) {
    const auto rows = is_picked_points(path) ? std::vector<Row>{} : read_rows(path);
    if (rows.empty())
        throw UsageError(path + ": holds the points of one surface; give one such file for each");
    if (rows[0].numbers.size() != 6) return read_column(path, column, &mesh);
    require_count(rows, path, 6, 6, "two points, x y z x y z, as in the first row");
    return snapped_list(points_of_rows(rows, 3 * column), path, mesh, space);
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

void require_distinct_used(const std::vector<Named>& list, const std::string& path, const char* role,
                           const TriangleMesh& mesh) {
    std::vector<bool> used(size_t(mesh.vertex_count()), mesh.face_count() == 0);  // points of no surface
    for (int v : mesh.faces.reshaped()) used[size_t(v)] = true;
    std::map<int, int> lines;
    for (const auto& [line, vertex, name, point] : list) {
        if (vertex == no_vertex) continue;
        const auto [it, added] = lines.try_emplace(vertex, line);
        if (!added)
            fail_at(path, line,
                    fmt::format("{} vertex {} is already the landmark of line {}", role, vertex, it->second));
        if (!used[size_t(vertex)])
            fail_at(path, line, fmt::format("{} vertex {} belongs to no face of the mesh", role, vertex));
    }
}

}  // namespace

std::vector<int> read_vertex_list(const std::string& path, IndexBase base, const TriangleMesh* mesh) {
    std::vector<int> vertices;
    for (const Named& named : read_list(path, base, mesh)) vertices.push_back(named.vertex);
    return vertices;
}

bool holds_points(const std::string& path) {
    return is_picked_points(path) || read_rows(path)[0].numbers.size() == 3;
}

Landmarks read_landmarks(const std::vector<std::string>& files, const TriangleMesh& source_input,
                         const TriangleMesh& target_input, LandmarkSpace space) {
    if (files.size() != 1 && files.size() != 2)
        throw UsageError(
            "landmarks: give one file of pairs, or a list for the source and one for the target");
    const TriangleMesh* meshes[] = {&source_input, &target_input};
    std::vector<Named> lists[2];
    for (size_t side : {0, 1}) {
        const std::string& path = files[files.size() == 1 ? 0 : side];
        lists[side] = files.size() == 1 ? read_pair_side(path, side, *meshes[side], space)
                                        : read_side(path, *meshes[side], space);
        require_distinct_used(lists[side], path, side == 0 ? "source" : "target", *meshes[side]);
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
