#include "stages/verify/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "varimap/core/index_set.h"
#include "varimap/mesh_files/mesh_file.h"

namespace varimap {

namespace {

/// Of what was found, faces and vertices by the numbers of the file.
Verification in_file(Verification found, const FileLink& link) {
    if (link.is_identity()) return found;
    for (int& face : found.reversed_faces) face = link.face[std::size_t(face)];
    for (int& vertex : found.branch_vertices) vertex = number_in_file(vertex, link);
    std::sort(found.reversed_faces.begin(), found.reversed_faces.end());
    make_set(found.branch_vertices);  // a vertex that was split counts once
    return found;
}

}  // namespace

Verification verify_files(const std::string& source_mesh, const std::string& target_mesh,
                          const std::string& map, bool mirror, const RepairOptions& options, IndexBase base) {
    RepairedMesh source = repaired(read_mesh(source_mesh), options, source_mesh);
    const RepairedMesh target = repaired(read_mesh(target_mesh), options, target_mesh);
    const PointMap images = read_map_file(map, base, file_of(target), &file_of(source));
    if (mirror) source.mesh.faces.col(1).swap(source.mesh.faces.col(2));
    return in_file(verify_map(from_file(images, source.link, target.link), source.mesh, target.mesh),
                   source.link);
}

std::string as_text(const Verification& found) {
    std::string text;
    const auto row = [&](const char* name, const std::string& value) {
        text += fmt::format("{:<20}{:>10}\n", name, value);
    };
    row("reversed triangles", fmt::format("{}", found.reversed_faces.size()));
    row("reversed area", fmt::format("{:.4f} %", found.reversed_area_percent));
    row("cutting triangles", fmt::format("{}", found.cutting_count));
    row("branch points", fmt::format("{}", found.branch_vertices.size()));
    row("signed area ratio", fmt::format("{:.4f}", found.signed_area_ratio));
    row("degree", found.degree ? fmt::format("{:.4f}", *found.degree) : "none");
    if (found.left_out_count > 0) row("left out", fmt::format("{}", found.left_out_count));
    return text;
}

std::string as_json(const Verification& found) {
    nlohmann::ordered_json json;
    json["reversed_count"] = found.reversed_faces.size();
    json["reversed_area_percent"] = found.reversed_area_percent;
    json["cutting_count"] = found.cutting_count;
    json["branch_points"] = found.branch_vertices.size();
    json["signed_area_ratio"] = found.signed_area_ratio;
    if (found.degree) json["degree"] = *found.degree;
    json["left_out_count"] = found.left_out_count;
    json["reversed_faces"] = found.reversed_faces;
    json["branch_vertices"] = found.branch_vertices;
    return json.dump() + "\n";
}

}  // namespace varimap
