#include "varimap/landmarks/landmark_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/core/lower_case.h"
#include "varimap/core/parse_number.h"
#include "varimap/core/printable.h"
#include "varimap/core/trimmed.h"
#include "varimap/landmarks/csv_fields.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh_files/text_scanner.h"
#include "varimap/mesh_files/xml_tags.h"

namespace varimap {

namespace {

double number(std::string_view text, const std::string& path, int line) {
    double value = 0;
    if (!parse_number(text, value) || !std::isfinite(value))
        fail_at(path, line, fmt::format("'{}' is not a coordinate", excerpt(text)));
    return value;
}

std::vector<PickedPoint> read_pp(const std::string& path, std::string_view bytes) {
    std::vector<PickedPoint> points;
    std::size_t counted = 0;
    int line = 1;
    XmlTags tags(bytes);
    XmlTag tag;
    while (tags.next(tag)) {
        if (tag.name != "point") continue;
        const auto at = std::size_t(tag.name.data() - bytes.data());
        line += int(std::count(bytes.begin() + counted, bytes.begin() + at, '\n'));
        counted = at;
        PickedPoint point;
        point.line = line;
        point.name = tag.attribute("name");
        point.defined = tag.attribute("active") != "0";
        for (int axis = 0; axis < 3 && point.defined; ++axis) {
            const std::string_view text = tag.attribute(std::string(1, "xyz"[axis]));
            if (text.empty()) fail_at(path, point.line, "a point without x, y or z");
            point.position[axis] = number(text, path, point.line);
        }
        points.push_back(std::move(point));
    }
    return points;
}

/// The words of 3D Slicer's files; 0 and 1 are those of its versions before 4.11.
Space space_from(std::string_view word, const std::string& path) {
    if (word == "LPS" || word == "1") return Space::lps;
    if (word == "RAS" || word == "0") return Space::ras;
    throw InputError(
        fmt::format("{}: its coordinate system '{}' is neither LPS nor RAS", path, excerpt(word)));
}

PickedPoint control_point(const nlohmann::json& control, Space space) {
    PickedPoint point;
    point.name = control.value("label", "");
    point.space = space;
    point.defined = control.value("positionStatus", "defined") == "defined";
    for (int axis = 0; axis < 3 && point.defined; ++axis)
        point.position[axis] = control.at("position").at(std::size_t(axis)).get<double>();
    return point;
}

std::vector<PickedPoint> read_mrk_json(const std::string& path, std::string_view bytes) {
    std::vector<PickedPoint> points;
    try {
        const auto file = nlohmann::json::parse(bytes);
        for (const auto& markup : file.at("markups")) {
            // LPS is the default of the format.
            const Space space = space_from(markup.value("coordinateSystem", "LPS"), path);
            for (const auto& control : markup.at("controlPoints")) {
                points.push_back(control_point(control, space));
                points.back().line = int(points.size());
            }
        }
    } catch (const nlohmann::json::exception&) {
        throw InputError(path +
                         ": is not a 3D Slicer markups file with markups, controlPoints and positions");
    }
    return points;
}

/// `# CoordinateSystem = LPS`
void read_fcsv_comment(std::string_view text, const std::string& path, Space& space) {
    const std::size_t equals = text.find('=');
    if (equals != text.npos && trimmed(text.substr(1, equals - 1)) == "CoordinateSystem")
        space = space_from(trimmed(text.substr(equals + 1)), path);
}

/// Landmark Editor's: a line `Version 1.0`, one with the count, then lines `S000 x y z`. 9999 stands for what
/// is missing.
std::vector<PickedPoint> read_pts(const std::string& path, std::string_view bytes) {
    constexpr double missing = 9999;
    std::vector<PickedPoint> points;
    TextScanner lines(bytes, path, LineStyle::plain);
    if (!lines.next_line() || lower_case(lines.words()[0]) != "version" || !lines.next_line())
        throw InputError(path +
                         ": does not begin as Landmark Editor's .pts files do, with a line 'Version 1.0' and "
                         "the count; lists of other kinds end in .txt or .csv");
    while (lines.next_line()) {
        const auto& words = lines.words();
        if (words.size() != 4) lines.fail("expected a name and x y z");
        PickedPoint point{lines.line(), std::string(words[0])};
        for (std::size_t axis = 0; axis < 3; ++axis)
            point.position[Eigen::Index(axis)] = number(words[axis + 1], path, lines.line());
        point.defined = (point.position.array() != missing).any();
        points.push_back(std::move(point));
    }
    return points;
}

/// Columns: id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,...
std::vector<PickedPoint> read_fcsv(const std::string& path, std::string_view bytes) {
    constexpr std::size_t label = 11;
    std::vector<PickedPoint> points;
    Space space = Space::unstated;
    int line = 0;
    while (!bytes.empty()) {
        ++line;
        const std::string_view text = split_off_line(bytes);
        if (text.starts_with('#')) read_fcsv_comment(text, path, space);
        if (text.empty() || text.starts_with('#')) continue;
        const auto read = csv_fields(text);
        if (!read) fail_at(path, line, "a quote has no end, or more than a comma behind it");
        const std::vector<std::string>& fields = *read;
        if (fields.size() < 4) fail_at(path, line, "expected id,x,y,z,...");
        PickedPoint point{line, fields.size() > label ? fields[label] : "", Vec3::Zero(), space};
        for (std::size_t axis = 0; axis < 3; ++axis)
            point.position[Eigen::Index(axis)] = number(fields[axis + 1], path, line);
        points.push_back(std::move(point));
    }
    return points;
}

/// Lists of vertices are called .pts, too; Landmark Editor's begin with a word.
bool begins_with_number(const std::string& path) {
    std::ifstream file(path);
    char first = 0;
    return file >> first && first >= '0' && first <= '9';
}

}  // namespace

bool is_picked_points(const std::string& path) {
    return has_ending(path, ".pp") || has_ending(path, ".json") || has_ending(path, ".fcsv") ||
           (has_ending(path, ".pts") && !begins_with_number(path));
}

std::vector<PickedPoint> read_picked_points(const std::string& path) {
    return parse_picked_points(read_file(path), path);
}

std::vector<PickedPoint> parse_picked_points(std::string_view bytes, const std::string& path) {
    bytes = without_byte_order_mark(bytes, path);
    const auto points = has_ending(path, ".pp")     ? read_pp(path, bytes)
                        : has_ending(path, ".json") ? read_mrk_json(path, bytes)
                        : has_ending(path, ".pts")  ? read_pts(path, bytes)
                                                    : read_fcsv(path, bytes);
    if (points.empty()) throw InputError(path + ": holds no points");
    return points;
}

Vec3 in_axes_of(const TriangleMesh& mesh, const PickedPoint& point, LandmarkSpace how) {
    const Space space = how == LandmarkSpace::stated ? point.space
                        : how == LandmarkSpace::lps  ? Space::lps
                        : how == LandmarkSpace::ras  ? Space::ras
                                                     : Space::unstated;
    const Space of_mesh = mesh.space == Space::unstated ? Space::lps : mesh.space;
    const Vec3& p = point.position;
    return space == Space::unstated || space == of_mesh ? p : Vec3(-p[0], -p[1], p[2]);
}

Snapped snap(const std::vector<Vec3>& positions, const TriangleMesh& mesh) {
    const ClosestPoint closest(mesh);
    const double unit = std::sqrt(surface_area(mesh));
    Snapped snapped;
    for (const Vec3& position_in_space : positions) {
        const SurfacePoint point = closest(position_in_space).point;
        snapped.points.push_back(point);
        snapped.vertices.push_back(nearest_vertex(mesh, point));
        snapped.distances.push_back((position_in_space - position(mesh, point)).stableNorm() / unit);
    }
    return snapped;
}

void require_near(const Snapped& snapped, const std::vector<Vec3>& positions, const TriangleMesh& mesh,
                  const std::string& place, const char* what) {
    const std::vector<double>& distances = snapped.distances;
    const auto far = std::ranges::count_if(distances, [](double d) { return d > far_from_surface; });
    if (2 * std::size_t(far) <= distances.size()) return;
    throw InputError(
        fmt::format("{}: {} of {} {} lie farther than {} from the surface, the farthest {:.3g}, in units of "
                    "sqrt(area); {}",
                    place, far, distances.size(), what, far_from_surface, std::ranges::max(distances),
                    likely_cause(positions, mesh)));
}

}  // namespace varimap
