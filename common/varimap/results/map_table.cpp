#include "varimap/results/map_table.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/shortest_text.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

namespace {

constexpr std::string_view csv_header = "vertex,face,b0,b1,b2";
constexpr double barycentric_tolerance = 1e-3;  ///< files of other programs may carry few digits

/// Reads one number and the comma behind it (or the end of the line) off the front of `line`.
template <class Number>
bool take(std::string_view& line, Number& number, bool last = false) {
    const auto [end, status] = std::from_chars(line.data(), line.data() + line.size(), number);
    line.remove_prefix(std::size_t(end - line.data()));
    if (status != std::errc()) return false;
    if (last) return line.empty();
    if (line.empty() || line.front() != ',') return false;
    line.remove_prefix(1);
    return true;
}

SurfacePoint parse_row(std::string_view line, int vertex, const std::string& place) {
    SurfacePoint point;
    int number = 0;
    Vec3& b = point.barycentric;
    if (!take(line, number) || !take(line, point.face) || !take(line, b[0]) || !take(line, b[1]) ||
        !take(line, b[2], true))
        throw InputError(place + ": expected five numbers " + std::string(csv_header));
    if (number != vertex)
        throw InputError(place + ": vertex " + std::to_string(number) + " where vertex " +
                         std::to_string(vertex) + " should stand; rows must be in the vertices' order");
    require_near_surface(point, place);
    return point;
}

bool is_near_surface(const SurfacePoint& point) {
    const Vec3& b = point.barycentric;
    if (point.face < -1 || !b.allFinite()) return false;
    if (point.face < 0) return true;
    return std::abs(b.sum() - 1) <= barycentric_tolerance && b.minCoeff() >= -barycentric_tolerance;
}

}  // namespace

std::string to_csv(const PointMap& map) {
    std::string text(csv_header);
    text += '\n';
    for (std::size_t vertex = 0; vertex < map.size(); ++vertex) {
        text += shortest_text(vertex);
        text += ',';
        text += shortest_text(map[vertex].face);
        for (int k = 0; k < 3; ++k) {
            text += ',';
            text += shortest_text(map[vertex].barycentric[k]);
        }
        text += '\n';
    }
    return text;
}

void require_near_surface(const SurfacePoint& point, const std::string& place, int faces) {
    const Vec3& b = point.barycentric;
    if (!is_near_surface(point))
        throw InputError(
            fmt::format("{}: barycentric coordinates {} {} {} on face {}: they must be from 0 to 1 and sum "
                        "to 1, and the face at least -1",
                        place, b[0], b[1], b[2], point.face));
    if (faces >= 0 && point.face >= faces)
        throw InputError(
            fmt::format("{}: face {}, but the target mesh has {} faces", place, point.face, faces));
}

PointMap read_csv_map(const std::string& path) {
    return parse_csv_map(read_file(path), path);
}

bool is_csv_map(std::string_view bytes) {
    return split_off_line(bytes) == csv_header;
}

PointMap parse_csv_map(std::string_view text, const std::string& path) {
    if (split_off_line(text) != csv_header)
        throw InputError(path + ":1: not a map of varimap, whose first line is " + std::string(csv_header));
    PointMap map;
    while (!text.empty()) {
        const std::string_view line = split_off_line(text);
        if (line.empty() && text.empty()) break;
        const int vertex = int(map.size());
        map.push_back(parse_row(line, vertex, path + ":" + std::to_string(vertex + 2)));
    }
    return map;
}

}  // namespace varimap
