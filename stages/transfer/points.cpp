#include "stages/transfer/points.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <ranges>

#include "stages/transfer/point_files.h"
#include "stages/transfer/text_rows.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/counted.h"
#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/core/listed.h"
#include "varimap/core/log.h"
#include "varimap/core/lower_case.h"
#include "varimap/core/parallel.h"
#include "varimap/core/printable.h"
#include "varimap/landmarks/csv_fields.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

namespace {

void warn_of_far_points(const std::vector<double>& distances, const std::string& path) {
    for (std::size_t i = 0; i < distances.size(); ++i)
        if (distances[i] > far_from_surface)
            warn("{}: point {} (from 1) lies {:.3g} from the surface, in units of sqrt(area)", path, i + 1,
                 distances[i]);
}

/// Positions in the axes of `from`, carried, in the axes of `to`; nothing where there is no image.
std::vector<std::optional<Vec3>> carried(const std::vector<Vec3>& positions, const std::string& path,
                                         const Correspondence& map, const PointCarrier& there) {
    const Snapped snapped = snap(positions, map.from);
    require_near(snapped, positions, map.from, path, "points");
    warn_of_far_points(snapped.distances, path);
    std::vector<std::optional<Vec3>> result;
    for (const SurfacePoint& point : snapped.points) {
        const SurfacePoint image = there(point);
        result.push_back(image.face < 0 ? std::nullopt : std::optional(position(map.to, image)));
    }
    return result;
}

/// Throws InputError where there is anything without an image, with the first of their numbers. `one`,
/// `several`: what is numbered.
void refuse_those_without_image(const std::vector<std::string>& without, const std::string& path,
                                const char* one, const char* several) {
    if (!without.empty())
        throw InputError(fmt::format("{}: without an image on the other mesh: {} {}; leave out what has none",
                                     path, without.size() == 1 ? one : several, listed(without)));
}

std::vector<Vec3> require_images(const std::vector<std::optional<Vec3>>& images, const std::string& path) {
    std::vector<Vec3> positions;
    std::vector<std::string> without;
    for (std::size_t i = 0; i < images.size(); ++i)
        if (images[i])
            positions.push_back(*images[i]);
        else
            without.push_back(std::to_string(i + 1));
    refuse_those_without_image(without, path, "point (from 1)", "points (from 1)");
    return positions;
}

/// Of points, or vertices, that are missing, switched off, or not defined.
void warn_of_those_that_stay(std::ptrdiff_t missing, std::ptrdiff_t all, const std::string& path) {
    if (missing > 0)
        warn("{}: {} of {} are missing, not defined, or switched off; they stay as they are", path, missing,
             counted(all, "point", "points"));
}

std::string carry_picked(const std::string& path, const std::string& bytes, LandmarkSpace space,
                         const Correspondence& map, const PointCarrier& there) {
    std::vector<PickedPoint> points = parse_picked_points(bytes, path);
    std::vector<Vec3> positions;
    for (const PickedPoint& point : points)
        if (point.defined) positions.push_back(in_axes_of(map.from, point, space));
    if (positions.empty()) throw InputError(path + ": none of its points is defined");
    warn_of_those_that_stay(std::ssize(points) - std::ssize(positions), std::ssize(points), path);
    const std::vector<Vec3> images = require_images(carried(positions, path, map, there), path);
    auto image = images.begin();
    for (PickedPoint& point : points) {
        if (!point.defined) continue;
        point.position = *image++;
        // Changing axes there and back is the same.
        point.position = in_axes_of(map.to, point, space);
    }
    return with_positions(path, bytes, points);
}

bool is_vertex_name(const std::string& heading) {
    return lower_case(heading) == "vertex";
}

/// A list of numbers may have a name.
bool has_name(const TextRows& list) {
    const std::string& first = list.rows[0].words[0];
    return !first.empty() && is_index_name(first);
}

/// A line, with the comment that stood behind it.
std::string with_comment(std::string line, const TextRow& row) {
    return std::move(line) + (row.comment.empty() ? "" : " " + row.comment) + "\n";
}

std::string to_text(const TextRows& rows) {
    std::string text;
    for (const TextRow& row : rows.rows)
        text += row.before + with_comment(join(row.words, rows.separator), row);
    return text + rows.behind;
}

/// The name of a list as a line, if it has one.
std::string name_line(const TextRows& list) {
    return has_name(list) ? with_comment(join(list.rows[0].words, list.separator), list.rows[0]) : "";
}

/// A number in a column, from 0. `first`: the number of the first one in the file.
int number_of(const TextRow& row, std::size_t column, const std::string& path, int first, int count,
              const char* what) {
    const std::string word = column < row.words.size() ? row.words[column] : "";
    long long number = -1;
    if (!to_index(word, number) || number < first || number >= count + first)
        fail_at(path, row.line,
                fmt::format("'{}' is not one of the mesh's {} {}, counted from {}", excerpt(word), count,
                            what, first));
    return int(number) - first;
}

/// Where the numbers of vertices stand in rows that hold one each.
struct VertexColumn {
    std::size_t column = 0, first_row = 0;
};

/// None of rows of points: rows of one word hold vertices, those with a column of that name and none of
/// coordinates, and those that begin with one number beside words that are none.
std::optional<VertexColumn> vertex_column(const TextRows& rows) {
    if (std::ranges::all_of(rows.rows, [](const TextRow& row) { return row.words.size() == 1; }))
        return VertexColumn{0, has_name(rows) ? 1u : 0u};
    const std::vector<std::string>& first = first_complete(rows).words;
    const auto place = [&](const auto& found) { return std::size_t(found - first.begin()); };
    if (const auto number = std::ranges::find_if(first, is_number); number != first.end())
        return std::ranges::count_if(first, is_number) == 1 ? std::optional(VertexColumn{place(number), 0})
                                                            : std::nullopt;
    const auto named = std::ranges::find_if(first, is_vertex_name);
    if (named == first.end() || names_coordinates(first)) return {};
    return VertexColumn{place(named), 1};
}

/// `first`: the number of the first vertex.
std::string carry_vertices(TextRows rows, const std::string& path, const VertexColumn& at, int first,
                           const Correspondence& map, const PointCarrier& there) {
    const PointMap at_vertex = points_at_vertices(map.from);
    std::vector<std::string> without;
    std::ptrdiff_t missing = 0;
    for (std::size_t i = 0; i < rows.rows.size(); ++i) {
        TextRow& row = rows.rows[i];
        if (row.words.size() > rows.rows[0].words.size())
            fail_at(path, row.line, "holds more than a vertex and what the first line holds besides");
        if (at.column < row.words.size() && is_missing(row.words[at.column])) {
            ++missing;
        } else if (i >= at.first_row) {
            const int v = number_of(row, at.column, path, first, map.from.vertex_count(), "vertices");
            const SurfacePoint image = there(at_vertex[std::size_t(v)]);
            if (image.face < 0)
                without.push_back(std::to_string(v + first));
            else
                row.words[at.column] = std::to_string(nearest_vertex(map.to, image) + first);
        }
    }
    refuse_those_without_image(without, path, "vertex", "vertices");
    warn_of_those_that_stay(missing, std::ssize(rows.rows) - std::ptrdiff_t(at.first_row), path);
    return to_text(rows);
}

/// The normals of points are those of the surface they were picked on.
void drop_normals(TextRows& rows, const std::string& path) {
    const std::vector<std::string> headings = rows.rows[0].words;
    if (std::ranges::none_of(headings, names_normal)) return;
    for (TextRow& row : rows.rows)
        for (std::size_t c = std::min(headings.size(), row.words.size()); c-- > 0;)
            if (names_normal(headings[c])) row.words.erase(row.words.begin() + std::ptrdiff_t(c));
    warn("{}: its normals are those of this surface, and are left out", path);
}

std::string carry_rows(TextRows rows, const std::string& path, const Correspondence& map,
                       const PointCarrier& there) {
    drop_normals(rows, path);
    const auto [columns, first] = coordinate_columns(rows, path);
    if (first > 0 && std::ranges::any_of(rows.rows[0].words, is_vertex_name))
        fail_at(path, rows.rows[0].line,
                "the numbers of the column 'vertex' are those of this mesh, not of the other one; leave out "
                "that column, or the coordinates");
    std::vector<TextRow*> points;
    std::vector<Vec3> positions;
    for (TextRow& row : rows.rows | std::views::drop(std::ptrdiff_t(first))) {
        if (lacks_point(row, columns)) continue;
        points.push_back(&row);
        positions.push_back(coordinates(row, columns, path));
    }
    if (points.empty()) throw InputError(path + ": all of its points are missing");
    warn_of_those_that_stay(std::ssize(rows.rows) - std::ptrdiff_t(first) - std::ssize(points),
                            std::ssize(rows.rows) - std::ptrdiff_t(first), path);
    const std::vector<Vec3> images = require_images(carried(positions, path, map, there), path);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            points[i]->words[columns[axis]] = fmt::format("{}", images[i][Eigen::Index(axis)]);
    return to_text(rows);
}

}  // namespace

std::string carry_points(const std::string& path, const LandmarkReading& reading, const Correspondence& map,
                         const PointCarrier& there) {
    const std::string bytes = read_file(path);
    if (is_picked_points(path)) return carry_picked(path, bytes, reading.space, map, there);
    for (const char* mesh : {".obj", ".ply", ".off", ".stl"})
        if (has_ending(path, mesh))
            throw InputError(path + ": is a mesh; give its points as lines of x y z (.txt or .csv)");
    TextRows rows = split_rows(bytes, path, Content::numbers);
    if (const auto at = vertex_column(rows))
        return carry_vertices(std::move(rows), path, *at, number_of_first(reading.base), map, there);
    return carry_rows(std::move(rows), path, map, there);
}

std::string carry_region(const std::string& path, const Correspondence& map, const PointCarrier& back) {
    std::vector<bool> inside(std::size_t(map.from.face_count()), false);
    const TextRows rows = split_rows(read_file(path), path, Content::numbers);
    if (has_name(rows) && lower_case(rows.rows[0].words[0]).starts_with("vert"))
        fail_at(path, rows.rows[0].line,
                fmt::format(
                    "'{}' names vertices, and a region is a list of triangles; give a label for each vertex "
                    "as --labels",
                    excerpt(rows.rows[0].words[0])));
    for (std::size_t i = has_name(rows) ? 1 : 0; i < rows.rows.size(); ++i) {
        const TextRow& row = rows.rows[i];
        if (row.words.size() != 1) fail_at(path, row.line, "expected the number of one face");
        inside[std::size_t(number_of(row, 0, path, 0, map.from.face_count(), "faces"))] = true;
    }
    std::vector<char> covered(std::size_t(map.to.face_count()));
    parallel_for_each_index(map.to.face_count(), 256, [&](int f) {
        const SurfacePoint at = back({f, Vec3::Constant(1 / 3.)});
        covered[std::size_t(f)] = at.face >= 0 && inside[std::size_t(at.face)];
    });
    std::string text;
    for (std::size_t f = 0; f < covered.size(); ++f)
        if (covered[f]) text += fmt::format("{}\n", f);
    if (text.empty())
        warn(
            "{}: no face of the other mesh has its centroid on this region: it is smaller than faces there, "
            "or nothing is mapped to it",
            path);
    return name_line(rows) + text;
}

}  // namespace varimap
