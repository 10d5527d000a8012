#include "stages/transfer/point_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "varimap/core/file_ending.h"
#include "varimap/core/lower_case.h"
#include "varimap/core/printable.h"
#include "varimap/landmarks/csv_fields.h"
#include "varimap/mesh_files/text_scanner.h"
#include "varimap/mesh_files/xml_tags.h"

namespace varimap {

namespace {

std::string slicer_json(std::string_view bytes, const std::vector<PickedPoint>& points) {
    auto file = nlohmann::ordered_json::parse(bytes);
    auto point = points.begin();
    for (auto& markup : file.at("markups"))
        for (auto& control : markup.at("controlPoints")) {
            if (point->defined)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    control["position"][axis] = point->position[Eigen::Index(axis)];
            ++point;
        }
    return file.dump(4) + "\n";
}

/// The line with its fields 1, 2 and 3 (from 0) replaced.
std::string fcsv_line(std::string_view line, const Vec3& position) {
    std::string text(take_raw_field(line));
    for (int axis = 0; axis < 3; ++axis) {
        take_raw_field(line);
        text += fmt::format(",{}", position[axis]);
    }
    return line.empty() ? text : fmt::format("{},{}", text, line);
}

std::string slicer_fcsv(std::string_view bytes, const std::vector<PickedPoint>& points) {
    std::string text;
    auto point = points.begin();
    while (!bytes.empty()) {
        const std::string_view line = split_off_line(bytes);
        const bool holds_point = !line.empty() && !line.starts_with('#');
        text += holds_point ? fcsv_line(line, (point++)->position) : std::string(line);
        text += '\n';
    }
    return text;
}

/// The coordinates of a point as its tag holds them, in the order in which they stand there.
std::map<std::string_view::const_iterator, std::pair<std::string_view, double>> coordinates_in(
    const XmlTag& tag, const Vec3& position) {
    std::map<std::string_view::const_iterator, std::pair<std::string_view, double>> found;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view text = tag.attribute(std::string(1, "xyz"[axis]));
        found[text.begin()] = {text, position[axis]};
    }
    return found;
}

std::string meshlab(std::string_view bytes, const std::vector<PickedPoint>& points) {
    std::string text;
    auto done = bytes.begin();
    auto point = points.begin();
    XmlTags tags(bytes);
    for (XmlTag tag; tags.next(tag);) {
        if (tag.name != "point") continue;
        const PickedPoint& now = *point++;
        if (!now.defined) continue;
        for (const auto& [begin, coordinate] : coordinates_in(tag, now.position)) {
            text += std::string(done, begin) + fmt::format("{}", coordinate.second);
            done = coordinate.first.end();
        }
    }
    return text + std::string(done, bytes.end());
}

std::string landmark_editor(std::string_view bytes, const std::vector<PickedPoint>& points) {
    std::string text;
    auto done = bytes.begin();
    auto point = points.begin();
    for (TextScanner lines(bytes, "", LineStyle::plain); point != points.end() && lines.next_line();) {
        if (lines.line() != point->line) continue;
        const Vec3& now = (point++)->position;
        const auto &first = lines.words()[1], &last = lines.words()[3];
        text += std::string(done, first.begin()) + fmt::format("{} {} {}", now[0], now[1], now[2]);
        done = last.end();
    }
    return text + std::string(done, bytes.end());
}

/// Whether a column of that name holds the axis: x, or Points:0 as ParaView writes it.
bool names_axis(std::string_view name, std::size_t axis) {
    const std::string lower = lower_case(name);
    return lower == std::string(1, "xyz"[axis]) || lower == fmt::format("points:{}", axis);
}

}  // namespace

bool names_coordinates(const std::vector<std::string>& headings) {
    std::size_t named = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        named += std::ranges::any_of(headings, [&](const auto& name) { return names_axis(name, axis); });
    return named == 3;
}

bool names_normal(std::string_view heading) {
    const std::string lower = lower_case(heading);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const char* before : {"n", "n_", "normal_", "normal "})
            if (lower == before + std::string(1, "xyz"[axis]) || lower == fmt::format("normals:{}", axis))
                return true;
    return false;
}

std::string with_positions(const std::string& path, const std::string& file,
                           const std::vector<PickedPoint>& points) {
    const std::string_view bytes = without_byte_order_mark(file, path);
    return has_ending(path, ".pp")     ? meshlab(bytes, points)
           : has_ending(path, ".json") ? slicer_json(bytes, points)
           : has_ending(path, ".pts")  ? landmark_editor(bytes, points)
                                       : slicer_fcsv(bytes, points);
}

const TextRow& first_complete(const TextRows& rows) {
    const auto lacks_something = [](const TextRow& row) {
        return std::ranges::any_of(row.words, [](const std::string& word) { return is_missing(word); });
    };
    const auto complete = std::ranges::find_if_not(rows.rows, lacks_something);
    return complete == rows.rows.end() ? rows.rows[0] : *complete;
}

std::pair<std::array<std::size_t, 3>, std::size_t> coordinate_columns(const TextRows& rows,
                                                                      const std::string& path) {
    std::array<std::size_t, 3> columns{};
    const auto& first = rows.rows[0].words;
    std::size_t named = 0, numbers = 0;
    for (std::size_t c = 0; c < first.size(); ++c)
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (names_axis(first[c], axis)) columns[axis] = c, ++named;
    if (named == 3 && rows.rows.size() > 1) return {columns, 1};
    const std::vector<std::string>& words = first_complete(rows).words;
    for (std::size_t c = 0; c < words.size(); ++c)
        if (is_number(words[c]) && numbers++ < 3) columns[numbers - 1] = c;
    if (numbers != 3)
        fail_at(path, rows.rows[0].line,
                "expected a vertex number, three coordinates, or a first line that names columns x, y and z");
    return {columns, 0};
}

bool lacks_point(const TextRow& row, const std::array<std::size_t, 3>& columns) {
    return std::ranges::all_of(
        columns, [&](std::size_t c) { return c < row.words.size() && is_missing(row.words[c]); });
}

Vec3 coordinates(const TextRow& row, const std::array<std::size_t, 3>& columns, const std::string& path) {
    Vec3 point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (columns[axis] >= row.words.size())
            fail_at(path, row.line, fmt::format("has no column {}", columns[axis] + 1));
        const std::string& word = row.words[columns[axis]];
        double& value = point[Eigen::Index(axis)];
        if (!to_number(word, value) || !std::isfinite(value))
            fail_at(path, row.line, fmt::format("'{}' is not a coordinate", excerpt(word)));
    }
    return point;
}

}  // namespace varimap
