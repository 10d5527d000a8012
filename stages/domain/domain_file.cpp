#include "stages/domain/domain_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "varimap/artifact/artifact.h"
#include "varimap/core/counted.h"
#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/core/index_set.h"
#include "varimap/core/lower_case.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

namespace {

constexpr int least_points = 4;

DomainKind kind_by_ending(const std::string& path) {
    if (has_ending(path, ".mtx") || has_ending(path, ".edges")) return DomainKind::graph;
    return has_ending(path, ".obj") ? DomainKind::polyline : DomainKind::points;
}

/// The whole file, with commas and semicolons as blanks.
std::string read_rows(const std::string& path) {
    std::string text(without_byte_order_mark(read_file(path), path));
    for (char& c : text)
        if (c == ',' || c == ';') c = ' ';
    return text;
}

/// A heading without its quotes, in lower case.
std::string plain_heading(std::string_view word) {
    std::string heading;
    for (const char c : word)
        if (c != '"') heading += lower_case(c);
    return heading;
}

/// Rows of numbers, from the second on where the first are names.
class Rows {
  public:
    Rows(std::string_view text, const std::string& path) : scanner(text, path) {}
    bool next() {
        if (!scanner.next_line()) return false;
        const bool names = first_ && !is_number(scanner.words()[0]);
        first_ = false;
        if (!names) return true;
        for (const std::string_view word : scanner.words()) headings.push_back(plain_heading(word));
        return scanner.next_line();
    }
    TextScanner scanner;
    std::vector<std::string> headings;  ///< empty where there are none

  private:
    bool first_ = true;
};

double finite(const TextScanner& row, std::size_t word, const char* what) {
    const double value = row.number(word, what);
    if (!std::isfinite(value)) row.fail(fmt::format("{} {} is not finite", what, value));
    return value;
}

Vec3 point_from(const TextScanner& row, std::size_t first_word) {
    Vec3 point = Vec3::Zero();
    for (std::size_t k = first_word; k < row.words().size() && k < first_word + 3; ++k)
        point[Eigen::Index(k - first_word)] = finite(row, k, "coordinate");
    return point;
}

Points to_points(const std::vector<Vec3>& list) {
    Points points(list.size(), 3);
    for (std::size_t i = 0; i < list.size(); ++i) points.row(Eigen::Index(i)) = list[i].transpose();
    return points;
}

/// The columns called x, y and, where there is one, z; none where the first two are not there.
std::vector<std::size_t> columns_of_axes(const std::vector<std::string>& headings) {
    std::vector<std::size_t> columns;
    for (const char* axis : {"x", "y", "z"}) {
        const auto found = std::find(headings.begin(), headings.end(), axis);
        if (found != headings.end()) columns.push_back(std::size_t(found - headings.begin()));
        if (columns.size() < 2 && found == headings.end()) return {};
    }
    return columns;
}

Vec3 point_of_columns(const Rows& rows, const std::vector<std::size_t>& columns) {
    const TextScanner& row = rows.scanner;
    if (row.words().size() != rows.headings.size())
        row.fail(fmt::format("{} values, where the first row names {} columns", row.words().size(),
                             rows.headings.size()));
    Vec3 point = Vec3::Zero();
    for (std::size_t k = 0; k < columns.size(); ++k)
        point[Eigen::Index(k)] = finite(row, columns[k], "coordinate");
    return point;
}

/// Coordinates along axes that a row does not name are 0.
std::vector<Vec3> rows_of_points(const std::string& path) {
    const std::string text = read_rows(path);
    Rows rows(text, path);
    std::vector<Vec3> points;
    std::size_t columns = 0;
    while (rows.next()) {
        if (const auto axes = columns_of_axes(rows.headings); !axes.empty()) {
            points.push_back(point_of_columns(rows, axes));
            continue;
        }
        const std::size_t words = rows.scanner.words().size();
        if (words != 2 && words != 3) rows.scanner.fail("a point needs two or three coordinates");
        if (columns != 0 && words != columns)
            rows.scanner.fail(fmt::format("{} coordinates, where rows before have {}", words, columns));
        columns = words;
        points.push_back(point_from(rows.scanner, 0));
    }
    return points;
}

void require_enough(int points, const std::string& path) {
    if (points < least_points)
        throw InputError(fmt::format("{}: {}; at least {} are needed", path,
                                     counted(points, "point", "points"), least_points));
}

void require_distinct(const Points& points, const std::string& path) {
    std::vector<int> order = all_indices(points.rows());
    const auto key = [&](int i) { return std::tuple(points(i, 0), points(i, 1), points(i, 2), i); };
    std::sort(order.begin(), order.end(), [&](int i, int k) { return key(i) < key(k); });
    for (std::size_t n = 1; n < order.size(); ++n)
        if (points.row(order[n]) == points.row(order[n - 1]))
            throw InputError(fmt::format("{}: points {} and {} (from 0) lie at the same place; leave one out",
                                         path, order[n - 1], order[n]));
}

void measure(DomainFile& file) {
    for (DomainEdge& edge : file.edges)
        edge.length = (file.positions.row(edge.a) - file.positions.row(edge.b)).norm();
    file.measured = true;
}

DomainEdge edge_between(int a, int b, double length = 0) {
    return {std::min(a, b), std::max(a, b), length, 0};
}

DomainFile polyline_from_rows(const std::string& path) {
    std::vector<Vec3> points = rows_of_points(path);
    const bool closed = points.size() > least_points && points.front() == points.back();
    if (closed) points.pop_back();
    DomainFile file{DomainKind::polyline, int(points.size()), to_points(points), {}, false};
    for (int i = 1; i < file.count; ++i) file.edges.push_back(edge_between(i - 1, i));
    if (closed) file.edges.push_back(edge_between(file.count - 1, 0));
    return file;
}

/// OBJ numbers vertices from 1, or from the last one backwards.
int obj_vertex(const TextScanner& row, std::size_t word, std::size_t vertices) {
    const long long number = row.integer(word, "vertex number"), count = static_cast<long long>(vertices);
    const long long index = number < 0 ? count + number : number - 1;
    if (index < 0 || index >= count)
        row.fail(fmt::format("vertex {} is none of the {} before this line", number, count));
    return int(index);
}

DomainFile polyline_from_obj(const std::string& path) {
    const std::string bytes = read_file(path);
    TextScanner row(without_byte_order_mark(bytes, path), path);
    std::vector<Vec3> points;
    std::vector<DomainEdge> edges;
    std::set<std::pair<int, int>> known;
    while (row.next_line()) {
        if (row.words()[0] == "v") {
            if (row.words().size() < 4) row.fail("a vertex needs three coordinates");
            points.push_back(point_from(row, 1));
        } else if (row.words()[0] == "l") {
            for (std::size_t k = 2; k < row.words().size(); ++k) {
                const int a = obj_vertex(row, k - 1, points.size()), b = obj_vertex(row, k, points.size());
                if (a == b) row.fail("a line joins a vertex to itself");
                if (known.insert(std::minmax(a, b)).second) edges.push_back(edge_between(a, b));
            }
        }
    }
    if (edges.empty()) throw InputError(path + ": has no lines (l); give a surface to varimap-preprocess");
    return {DomainKind::polyline, int(points.size()), to_points(points), edges, false};
}

/// Edges, each once. Loops, as on a matrix's diagonal, say nothing.
class EdgeCollector {
  public:
    void add(const TextScanner& row, int a, int b, double weight) {
        if (!(weight > 0))
            row.fail(fmt::format("the weight {} is not positive; a graph needs positive weights", weight));
        if (a == b) return;
        const auto [known, is_new] = weight_.emplace(std::minmax(a, b), weight);
        if (!is_new && known->second != weight)
            row.fail(fmt::format("the edge has weight {} here and {} before", weight, known->second));
    }
    std::vector<DomainEdge> edges() const {
        std::vector<DomainEdge> result;
        for (const auto& [ends, weight] : weight_)
            result.push_back(edge_between(ends.first, ends.second, weight));
        return result;
    }

  private:
    std::map<std::pair<int, int>, double> weight_;
};

int point_number(const TextScanner& row, std::size_t word, long long first, long long last) {
    const long long number = row.integer(word, "point number");
    if (number < first || number > last)
        row.fail(fmt::format("there is no point {}; they are numbered from {} to {}", number, first, last));
    return int(number - first);
}

DomainFile graph_from_rows(const std::string& path) {
    const std::string text = read_rows(path);
    Rows rows(text, path);
    constexpr long long most_points = 10'000'000;
    EdgeCollector edges;
    int count = 0;
    while (rows.next()) {
        const TextScanner& row = rows.scanner;
        if (row.words().size() != 2 && row.words().size() != 3)
            row.fail("an edge needs two point numbers, and may have a weight");
        const int a = point_number(row, 0, 0, most_points), b = point_number(row, 1, 0, most_points);
        edges.add(row, a, b, row.words().size() == 3 ? finite(row, 2, "weight") : 1);
        count = std::max({count, a + 1, b + 1});
    }
    return {DomainKind::graph, count, {}, edges.edges(), false};
}

using Entries = std::set<std::pair<int, int>>;

void require_both_halves(const Entries& entries, const std::string& path) {
    for (const auto& [row, column] : entries)
        if (entries.count({column, row}) == 0)
            throw InputError(
                fmt::format("{}: a general matrix with an entry at {} {} (from 1), but none at {} {}; a "
                            "graph needs equal "
                            "halves, or 'symmetric' in the first line where one half stands for both",
                            path, row + 1, column + 1, column + 1, row + 1));
}

/// Not Eigen's unsupported MarketIO: it goes on after lines it cannot read, whose values it makes up.
DomainFile graph_from_matrix_market(const std::string& path) {
    const std::string bytes = read_file(path);
    TextScanner row(bytes, path, LineStyle::plain);
    const auto next_row = [&] {
        while (row.next_line())
            if (row.words()[0][0] != '%') return true;
        return false;
    };
    if (!row.next_line() || row.words()[0] != "%%MatrixMarket" || row.words().size() != 5 ||
        row.words()[1] != "matrix" || row.words()[2] != "coordinate")
        row.fail("a graph needs the first line '%%MatrixMarket matrix coordinate real symmetric'");
    const bool pattern = row.words()[3] == "pattern";
    if (!pattern && row.words()[3] != "real" && row.words()[3] != "integer")
        row.fail("entries of a graph are real, integer or pattern");
    const bool general = row.words()[4] == "general";
    if (row.words()[4] != "symmetric" && !general)
        row.fail("the matrix of a graph is symmetric, or general with equal halves");
    if (!next_row() || row.words().size() != 3)
        row.fail("the numbers of rows, columns and entries are missing");
    const long long count = row.integer(0, "number of rows"), entries = row.integer(2, "number of entries");
    if (count != row.integer(1, "number of columns")) row.fail("the matrix of a graph is square");
    if (count < 1 || count > 10'000'000) row.fail(fmt::format("{} points are none or too many", count));
    EdgeCollector edges;
    Entries given;
    long long read = 0;
    for (; next_row(); ++read) {
        if (row.words().size() != (pattern ? 2 : 3)) row.fail("an entry needs row, column and value");
        const int a = point_number(row, 0, 1, count), b = point_number(row, 1, 1, count);
        if (a != b) edges.add(row, a, b, pattern ? 1 : finite(row, 2, "weight"));
        if (general) given.emplace(a, b);
    }
    if (read != entries) row.fail(fmt::format("{} entries, where its head promises {}", read, entries));
    require_both_halves(given, path);
    return {DomainKind::graph, int(count), {}, edges.edges(), false};
}

/// The edges of a mesh as wires.
DomainFile graph_from_mesh(const std::string& path) {
    const TriangleMesh mesh = read_mesh(path);
    require_plain_faces(mesh, path);
    DomainFile file{DomainKind::graph, mesh.vertex_count(), mesh.vertices, {}, false};
    for (const auto& [a, b] : find_edges(mesh).vertices) file.edges.push_back(edge_between(a, b));
    require_distinct(file.positions, path);
    measure(file);
    return file;
}

bool is_mesh(const std::string& path) {
    return has_ending(path, ".off") || has_ending(path, ".ply") || has_ending(path, ".stl") ||
           has_ending(path, ".obj");
}

/// Of a mesh, or of a point cloud in such a file.
Points vertices_of_mesh(const std::string& path) {
    const Points points = read_vertices(path);
    for (int v = 0; v < points.rows(); ++v)
        if (!points.row(v).allFinite())
            throw InputError(fmt::format("{}: point {} (from 0) is not finite", path, v));
    return points;
}

DomainFile read_as(const std::string& path, DomainKind kind) {
    if (kind == DomainKind::graph)
        return is_mesh(path)              ? graph_from_mesh(path)
               : has_ending(path, ".mtx") ? graph_from_matrix_market(path)
                                          : graph_from_rows(path);
    if (kind == DomainKind::polyline)
        return has_ending(path, ".obj") ? polyline_from_obj(path) : polyline_from_rows(path);
    const Points points = read_positions(path);
    return {DomainKind::points, int(points.rows()), points, {}, false};
}

}  // namespace

Points read_positions(const std::string& path) {
    Points points = is_mesh(path) ? vertices_of_mesh(path) : to_points(rows_of_points(path));
    require_distinct(points, path);
    return points;
}

DomainFile read_domain_file(const std::string& path, DomainKind kind) {
    DomainFile file = read_as(path, kind == DomainKind::automatic ? kind_by_ending(path) : kind);
    require_enough(file.count, path);
    if (file.kind == DomainKind::polyline) {
        require_distinct(file.positions, path);
        measure(file);
    }
    return file;
}

}  // namespace varimap
