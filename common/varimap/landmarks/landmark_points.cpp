#include "varimap/landmarks/landmark_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/mesh/closest_point.h"

namespace varimap {

namespace {

bool ends_with(const std::string& path, std::string_view ending) {
    return path.ends_with(ending);
}

[[noreturn]] void fail(const std::string& path, int line, const std::string& message) {
    throw InputError(fmt::format("{}:{}: {}", path, line, message));
}

double number(std::string_view text, const std::string& path, int line) {
    double value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        fail(path, line, fmt::format("'{}' is not a coordinate", text.substr(0, 40)));
    return value;
}

/// The value of ` name="value"` in a tag.
std::optional<std::string_view> attribute(std::string_view tag, const std::string& name) {
    for (const char* blank : {" ", "\n", "\t"}) {
        const std::size_t at = tag.find(blank + name + "=\"");
        if (at == std::string_view::npos) continue;
        const std::size_t begin = at + name.size() + 3, end = tag.find('"', begin);
        if (end != std::string_view::npos) return tag.substr(begin, end - begin);
    }
    return {};
}

std::vector<PickedPoint> read_pp(const std::string& path, std::string_view bytes) {
    std::vector<PickedPoint> points;
    for (std::size_t at = bytes.find("<point "); at != std::string_view::npos;
         at = bytes.find("<point ", at + 1)) {
        const std::string_view tag = bytes.substr(at, bytes.find('>', at) - at);
        PickedPoint point;
        point.line = 1 + int(std::count(bytes.begin(), bytes.begin() + std::ptrdiff_t(at), '\n'));
        for (int axis = 0; axis < 3; ++axis) {
            const auto text = attribute(tag, std::string(1, "xyz"[axis]));
            if (!text) fail(path, point.line, "a point without x, y or z");
            point.position[axis] = number(*text, path, point.line);
        }
        point.name = attribute(tag, "name").value_or("");
        if (attribute(tag, "active") != "0") points.push_back(std::move(point));
    }
    return points;
}

std::vector<PickedPoint> read_mrk_json(const std::string& path, const std::string& bytes) {
    std::vector<PickedPoint> points;
    try {
        const auto file = nlohmann::json::parse(bytes);
        for (const auto& markup : file.at("markups"))
            for (const auto& control : markup.at("controlPoints")) {
                PickedPoint point;
                point.line = int(points.size()) + 1;
                point.name = control.value("label", "");
                for (int axis = 0; axis < 3; ++axis)
                    point.position[axis] = control.at("position").at(axis).get<double>();
                points.push_back(std::move(point));
            }
    } catch (const nlohmann::json::exception&) {
        throw InputError(path +
                         ": is not a 3D Slicer markups file with markups, controlPoints and positions");
    }
    return points;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
    std::vector<std::string_view> fields;
    while (true) {
        const std::size_t end = line.find(separator);
        fields.push_back(line.substr(0, end));
        if (end == std::string_view::npos) return fields;
        line.remove_prefix(end + 1);
    }
}

/// Columns: id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,...
std::vector<PickedPoint> read_fcsv(const std::string& path, std::string_view bytes) {
    constexpr std::size_t label = 11;
    std::vector<PickedPoint> points;
    int line = 0;
    for (std::string_view text : split(bytes, '\n')) {
        ++line;
        if (text.ends_with('\r')) text.remove_suffix(1);
        if (text.empty() || text.starts_with('#')) continue;
        const auto fields = split(text, ',');
        if (fields.size() < 4) fail(path, line, "expected id,x,y,z,...");
        PickedPoint point{line, fields.size() > label ? std::string(fields[label]) : "", Vec3::Zero()};
        for (std::size_t axis = 0; axis < 3; ++axis)
            point.position[Eigen::Index(axis)] = number(fields[axis + 1], path, line);
        points.push_back(std::move(point));
    }
    return points;
}

}  // namespace

bool is_picked_points(const std::string& path) {
    return ends_with(path, ".pp") || ends_with(path, ".json") || ends_with(path, ".fcsv");
}

std::vector<PickedPoint> read_picked_points(const std::string& path) {
    const std::string bytes = read_file(path);
    const auto points = ends_with(path, ".pp")     ? read_pp(path, bytes)
                        : ends_with(path, ".json") ? read_mrk_json(path, bytes)
                                                   : read_fcsv(path, bytes);
    if (points.empty()) throw InputError(path + ": holds no points");
    return points;
}

Snapped snap(const std::vector<PickedPoint>& picked, const TriangleMesh& mesh) {
    const ClosestPoint closest(mesh);
    const double unit = std::sqrt(surface_area(mesh));
    Snapped snapped;
    for (const PickedPoint& point : picked) {
        const ClosestPoint::Hit hit = closest(point.position);
        int corner;
        hit.point.barycentric.maxCoeff(&corner);
        snapped.points.push_back(hit.point);
        snapped.vertices.push_back(mesh.faces(hit.point.face, corner));
        snapped.distances.push_back(std::sqrt(hit.squared_distance) / unit);
    }
    return snapped;
}

}  // namespace varimap
