#include "stages/domain/polyline_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "stages/domain/point_rows.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"

namespace varimap {

namespace {

/// OBJ numbers vertices from 1, or from the last one backwards.
int obj_vertex(const TextScanner& row, std::size_t word, std::size_t vertices) {
    const long long number = row.integer(word, "vertex number"), count = static_cast<long long>(vertices);
    const long long index = number < 0 ? count + number : number - 1;
    if (index < 0 || index >= count)
        row.fail(fmt::format("vertex {} is none of the {} before this line", number, count));
    return int(index);
}

}  // namespace

DomainFile polyline_from_rows(const std::string& path) {
    std::vector<Vec3> points = rows_of_points(path);
    const bool closed = points.size() > least_points && points.front() == points.back();
    if (closed) points.pop_back();
    DomainFile file{DomainKind::polyline, int(points.size()), to_points(points), {}, false};
    for (int i = 1; i < file.count; ++i) file.edges.push_back(edge_between(i - 1, i));
    if (closed) file.edges.push_back(edge_between(file.count - 1, 0));
    return file;
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

}  // namespace varimap
