#include "varimap/results/surface_map.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "varimap/artifact/cereal_eigen.h"
#include "varimap/core/error.h"
#include "varimap/core/shortest_text.h"
#include "varimap/mesh/io/text_scanner.h"
#include "varimap/results/checks.h"

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

}  // namespace

/// A point map as two arrays, the form in which artifacts hold it.
struct PackedPointMap {
    Eigen::VectorXi faces;
    Points barycentric;
};

template <class Archive>
void serialize(Archive& archive, PackedPointMap& map) {
    archive(map.faces, map.barycentric);
}

namespace {

PackedPointMap pack(const PointMap& map) {
    const auto n = Eigen::Index(map.size());
    PackedPointMap packed{Eigen::VectorXi(n), Points(n, 3)};
    for (Eigen::Index i = 0; i < n; ++i) {
        packed.faces[i] = map[std::size_t(i)].face;
        packed.barycentric.row(i) = map[std::size_t(i)].barycentric.transpose();
    }
    return packed;
}

PointMap unpack(const PackedPointMap& packed) {
    if (packed.faces.size() != packed.barycentric.rows())
        throw ArtifactError("a map artifact has arrays of unequal length; rerun varimap-relax");
    PointMap map(std::size_t(packed.faces.size()));
    for (std::size_t i = 0; i < map.size(); ++i)
        map[i] = {packed.faces[Eigen::Index(i)], packed.barycentric.row(Eigen::Index(i)).transpose()};
    return map;
}

}  // namespace

template <class Archive>
void serialize(Archive& archive, UntanglingReport& r) {
    archive(r.flipped_before, r.flipped_after, r.flipped_area_percent_before, r.flipped_area_percent_after,
            r.global_steps, r.sweeps, r.parts_tried, r.parts_replaced, r.replaced_area_percent,
            r.mirrored_parts, r.gated_area_percent, r.disagreeing_before, r.disagreeing_after);
}

/// SurfaceMap as it is archived.
struct PackedSurfaceMap {
    PackedPointMap A_to_B, B_to_A;
    UntanglingReports untangling;
};

template <class Archive>
void serialize(Archive& archive, PackedSurfaceMap& map) {
    archive(map.A_to_B, map.B_to_A, map.untangling.A_to_B, map.untangling.B_to_A);
}

namespace {

bool is_finite(const UntanglingReport& report) {
    return std::isfinite(report.flipped_area_percent_before) &&
           std::isfinite(report.flipped_area_percent_after) && std::isfinite(report.replaced_area_percent) &&
           std::isfinite(report.gated_area_percent);
}

}  // namespace

std::string encode(const SurfaceMap& map) {
    return cereal_encode(PackedSurfaceMap{pack(map.A_to_B), pack(map.B_to_A), map.untangling});
}

void decode(const std::string& payload, SurfaceMap& map) {
    PackedSurfaceMap packed;
    cereal_decode(payload, packed);
    map = {unpack(packed.A_to_B), unpack(packed.B_to_A), packed.untangling};
    require<SurfaceMap>(are_points(map.A_to_B) && are_points(map.B_to_A), "points");
    require<SurfaceMap>(is_finite(map.untangling.A_to_B) && is_finite(map.untangling.B_to_A),
                        "untangling reports");
}

void require_surfaces(const SurfaceMap& map, const Surface& A, const Surface& B) {
    const TriangleMesh &file_A = file_of(A), &file_B = file_of(B);
    if (!is_map_between(map.A_to_B, file_A, file_B) || !is_map_between(map.B_to_A, file_B, file_A))
        throw ArtifactError("the map is not one between these surfaces; rerun varimap-relax");
}

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

namespace {

bool is_near_surface(const SurfacePoint& point) {
    const Vec3& b = point.barycentric;
    if (point.face < -1 || !b.allFinite()) return false;
    if (point.face < 0) return true;
    return std::abs(b.sum() - 1) <= barycentric_tolerance && b.minCoeff() >= -barycentric_tolerance;
}

}  // namespace

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

Points image_positions(const PointMap& map, const TriangleMesh& target, const Points& fallback) {
    Points positions = fallback;
    for (std::size_t i = 0; i < map.size(); ++i)
        if (map[i].face >= 0) positions.row(Eigen::Index(i)) = position(target, map[i]).transpose();
    return positions;
}

TriangleMesh without_added_faces(const Surface& surface) {
    std::vector<int> left;
    for (int f = 0; f < int(surface.link.face.size()); ++f)
        if (surface.link.face[std::size_t(f)] >= 0) left.push_back(f);
    if (left.size() == surface.link.face.size()) return surface.input;
    return {surface.input.vertices, surface.input.faces(left, Eigen::all), surface.input.space};
}

}  // namespace varimap
