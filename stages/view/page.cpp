#include "stages/view/page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "stages/view/packed_arrays.h"
#include "stages/view/thinning.h"
#include "varimap/core/error.h"
#include "varimap/core/parallel.h"
#include "varimap/core/printable.h"
#include "varimap/core/rotation.h"
#include "varimap/mesh/pattern_axes.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_repair/mesh_repair.h"
#include "varimap/quality/quality.h"
#include "varimap/verification/verification.h"

namespace varimap {

using Json = nlohmann::ordered_json;

static void to_json(Json& json, const ArrayPlace& array) {
    json = {{"at", array.at}, {"count", array.count}, {"type", array.type}};
}

namespace {

constexpr double steps = 65535;    ///< of positions and barycentric coordinates
constexpr double per_octave = 32;  ///< steps of the logarithm of distortions
constexpr double far_back = .05;   ///< sqrt(area) from itself: the end of the scale of what comes back
constexpr const char* place = "<!--varimap-data-->";

std::uint16_t step(double share) {
    if (!std::isfinite(share)) return 0;  // of a vertex that no face uses
    return std::uint16_t(std::lround(std::clamp(share, 0., 1.) * steps));
}

/// log2 of a ratio: 128 is 1; 0: none.
std::uint8_t octaves(double ratio) {
    return std::uint8_t(std::lround(std::clamp(128 + per_octave * std::log2(ratio), 1., 255.)));
}

std::vector<std::uint16_t> rounded_positions(const TriangleMesh& mesh, const Vec3& low, double extent) {
    std::vector<std::uint16_t> rounded;
    for (const auto vertex : mesh.vertices.rowwise())
        for (int axis = 0; axis < 3; ++axis) rounded.push_back(step((vertex[axis] - low[axis]) / extent));
    return rounded;
}

/// Faces as differences of their corners from those before, which deflate well.
std::vector<std::int32_t> corner_differences(const Faces& faces) {
    std::vector<std::int32_t> differences;
    int before = 0;
    for (const auto face : faces.rowwise())
        for (int k = 0; k < 3; ++k) differences.push_back(face[k] - before), before = face[k];
    return differences;
}

Json add_map(const PointMap& map, PackedArrays& arrays) {
    std::vector<std::int32_t> faces;
    std::vector<std::uint16_t> barycentric;
    for (const SurfacePoint& point : map) {
        faces.push_back(point.face);
        barycentric.push_back(step(point.barycentric[0]));
        barycentric.push_back(step(point.barycentric[1]));
    }
    return {{"face", arrays.add(faces, "Int32Array")},
            {"barycentric", arrays.add(barycentric, "Uint16Array")}};
}

/// Per face: change of area and of angles, and whether it is flipped. What the map mirrors on purpose is
/// measured on the mirrored surface.
Json add_distortion(const PointMap& map, TriangleMesh from, const TriangleMesh& to, bool mirrored,
                    PackedArrays& arrays) {
    if (mirrored) from.faces.col(1).swap(from.faces.col(2));
    std::vector<std::uint8_t> area, angle, flipped;
    for (const TriangleDistortion& triangle : measure_triangles(map, from, to)) {
        const bool known = triangle.area > 0;
        area.push_back(known ? octaves(triangle.area_ratio) : 0);
        angle.push_back(known ? octaves(triangle.conformal) : 0);
        flipped.push_back(known && triangle.flipped);
    }
    return {{"area", arrays.add(area, "Uint8Array")},
            {"angle", arrays.add(angle, "Uint8Array")},
            {"flipped", arrays.add(flipped, "Uint8Array")}};
}

/// Per vertex, how far from itself it comes back through both maps: 1 to 255 at `far_back` and beyond; 0:
/// there is no way there or back.
std::vector<std::uint8_t> way_back(const PointMap& map, const TriangleMesh& from, const PointCarrier& back) {
    const double unit = std::sqrt(surface_area(from));
    std::vector<std::uint8_t> quantised(map.size());
    parallel_for_each_index(int(map.size()), 256, [&](int v) {
        const SurfacePoint returned = back(map[std::size_t(v)]);
        if (returned.face < 0) return;
        const double distance = (position(from, returned) - from.vertex(v)).norm() / unit;
        quantised[std::size_t(v)] = std::uint8_t(1 + std::lround(254 * std::min(1., distance / far_back)));
    });
    return quantised;
}

/// Vertices round which the map winds more than once (verification.h); none where the surfaces cannot be
/// judged.
std::vector<std::int32_t> branch_points(const PointMap& map, const TriangleMesh& from, const TriangleMesh& to,
                                        bool mirrored) {
    try {
        RepairedMesh source = repaired(from, {}, "source");
        const RepairedMesh target = repaired(to, {}, "target");
        if (mirrored) source.mesh.faces.col(1).swap(source.mesh.faces.col(2));
        const Verification found =
            verify_map(from_file(map, source.link, target.link), source.mesh, target.mesh);
        std::vector<std::int32_t> vertices;
        for (const int v : found.branch_vertices) vertices.push_back(number_in_file(v, source.link));
        return vertices;
    } catch (const InputError&) {
        return {};
    }
}

struct Side {
    const std::string& file;
    const TriangleMesh& mesh;
    const PointMap &map, &back;
    int vertices;  ///< of the file
};

Json add_side(const Side& side, const TriangleMesh& other, bool mirrored, PackedArrays& arrays) {
    // Vertices that no face uses may lie far off.
    const Box box = bounding_box(side.mesh);
    const double extent = (box.high - box.low).maxCoeff();
    const Vec3 low = (box.low + box.high) / 2 - Vec3::Constant(extent / 2);
    Json json{{"file", printable(side.file)},
              {"name", printable(std::filesystem::path(side.file).stem().string())},
              {"vertices", side.vertices},
              {"shown", side.mesh.vertex_count()},
              {"faces", side.mesh.face_count()},
              {"low", {low[0], low[1], low[2]}},
              {"extent", extent},
              {"size", std::sqrt(surface_area(side.mesh))},
              {"axes", side.mesh.space == Space::ras ? "RAS" : "LPS"}};
    json["position"] = arrays.add(rounded_positions(side.mesh, low, extent), "Uint16Array");
    json["corner"] = arrays.add(corner_differences(side.mesh.faces), "Int32Array");
    json["map"] = add_map(side.map, arrays);
    json["distortion"] = add_distortion(side.map, side.mesh, other, mirrored, arrays);
    json["way_back"] = arrays.add(way_back(side.map, side.mesh, {other, side.back, side.mesh}), "Uint8Array");
    json["branches"] = arrays.add(branch_points(side.map, side.mesh, other, mirrored), "Int32Array");
    return json;
}

/// The rotation that turns the target as the source stands: images on vertices, each in its own unit.
Eigen::Matrix3d target_to_source(const Correspondence& map) {
    // Relative to the first pair: far from the origin the means' products would leave few digits.
    Vec3 from_first = Vec3::Zero(), to_first = Vec3::Zero();
    Vec3 from_mean = Vec3::Zero(), to_mean = Vec3::Zero();
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    int count = 0;
    for (int v = 0; v < map.from.vertex_count(); ++v) {
        const SurfacePoint& image = map.there[std::size_t(v)];
        if (image.face < 0) continue;
        const Vec3 at = map.from.vertex(v), there = position(map.to, image);
        if (count == 0) from_first = at, to_first = there;
        const Vec3 from = at - from_first, to = there - to_first;
        from_mean += from, to_mean += to, ++count;
        products += from * to.transpose();
    }
    if (count > 0) products -= from_mean * to_mean.transpose() / count;
    return nearest_rotation(products);
}

Json position_json(const TriangleMesh& mesh, const SurfacePoint& point) {
    const Vec3 p = position(mesh, point);
    return {p[0], p[1], p[2]};
}

Json landmarks_json(const PageContent& content) {
    Json list = Json::array();
    for (std::size_t i = 0; i < content.landmarks.points.size(); ++i) {
        const auto& [source, target] = content.landmarks.points[i];
        list.push_back({{"name", printable(content.landmarks.names[i])},
                        {"source", position_json(content.map.from, source)},
                        {"target", position_json(content.map.to, target)}});
    }
    return list;
}

Json rows_of(const Eigen::Matrix3d& matrix) {
    Json rows = Json::array();
    for (const auto row : matrix.rowwise()) rows.push_back({row[0], row[1], row[2]});
    return rows;
}

Json add_texture(const PageTexture& texture, PackedArrays& arrays) {
    return {{"image", "data:" + texture.type + ";base64," + base64(texture.image)},
            {"source", arrays.add(texture.source_uv, "Float32Array")},
            {"target", arrays.add(texture.target_uv, "Float32Array")}};
}

/// Text that neither ends nor begins an element or a comment of a page.
std::string inside_page(const std::string& json) {
    std::string text;
    for (const char c : json) text += c == '<' ? "\\u003c" : std::string(1, c);
    return text;
}

}  // namespace

bool is_thinned(const Correspondence& map) {
    return std::max(map.from.vertex_count(), map.to.vertex_count()) > most_shown;
}

std::string viewer_page(const PageContent& content, const std::string& frame) {
    const std::size_t at = frame.find(place);
    if (at == frame.npos) throw InputError("the page's frame has no place for data; build it again");
    const Correspondence map = thinned(content.map, most_shown);
    const int in_source = content.map.from.vertex_count(), in_target = content.map.to.vertex_count();
    PackedArrays arrays;
    Json json;
    json["source"] =
        add_side({map.from_file, map.from, map.there, map.back, in_source}, map.to, content.mirrored, arrays);
    json["target"] =
        add_side({map.to_file, map.to, map.back, map.there, in_target}, map.from, content.mirrored, arrays);
    const bool whole = !is_thinned(content.map);
    if (content.texture && whole) json["texture"] = add_texture(*content.texture, arrays);
    json["candidates"] = Json::array();
    for (const PageCandidate& candidate : content.candidates)
        if (whole)
            json["candidates"].push_back(
                {{"relation", candidate.relation}, {"map", add_map(candidate.back, arrays)}});
    json["pattern"] = pattern_axes(map.from);
    json["up"] = std::string(1, "xyz"[likely_up(map.from)]);
    json["turn"] = rows_of(target_to_source(map));
    json["landmarks"] = landmarks_json(content);
    json["report"] = content.report.empty() ? Json() : Json::parse(content.report);
    const std::string data = "<script type=\"application/json\" id=\"data\">" + inside_page(json.dump()) +
                             "</script>\n<script type=\"text/plain\" id=\"arrays\">" + arrays.text() +
                             "</script>";
    return frame.substr(0, at) + data + frame.substr(at + std::string(place).size());
}

}  // namespace varimap
