#include "stages/remesh/export.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include "stages/remesh/remesh.h"
#include "varimap/artifact/file_status.h"
#include "varimap/core/error.h"
#include "varimap/results/map_arrays.h"
#include "varimap/results/map_table.h"

namespace varimap {

namespace {

/// Whether these are the mesh's, in their order. Compared to the bit: coordinates may be no numbers.
bool are_polygons_of(const PolygonSoup& polygons, const TriangleMesh& mesh) {
    const std::vector<Vec3>& points = polygons.points;
    const Faces faces = triangulated(polygons);
    return int(points.size()) == mesh.vertex_count() && int(faces.rows()) == mesh.face_count() &&
           std::memcmp(points.data(), mesh.vertices.data(), points.size() * sizeof(Vec3)) == 0 &&
           faces == mesh.faces;
}

/// The source on the target, with the polygons of the source's file; `polygons`: none where these are not
/// known.
std::string remeshed_ply(const PointMap& map, const Surface& source, const Surface& target,
                         const PolygonSoup& polygons, PlyFormat format) {
    const TriangleMesh moved = cross_remesh(map, source, target);
    if (polygons.corners.size() == 3 * polygons.ends.size()) return to_ply(moved, format);
    return to_ply(cross_remeshed_polygons(moved, polygons, map, source, target), format);
}

bool would_change(const std::string& path, const std::string& bytes) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored) && read_file(path) != bytes;
}

/// What tells of the tables and meshes of another map goes before the first of them changes, so that a run
/// that ends on the way leaves none beside new ones.
void remove_reports(const std::string& folder) {
    for (const char* name : {"quality.json", "picture.png"}) {
        std::error_code ignored;
        std::filesystem::remove(std::filesystem::path(folder) / name, ignored);
    }
}

}  // namespace

PolygonSoup read_polygons_of(const Surface& surface, const std::string& surface_file,
                             const std::string& file) {
    PolygonSoup polygons = read_polygons(file);
    if (!are_polygons_of(polygons, file_as_read(surface)))
        throw ArtifactError(
            fmt::format("'{}' is not the mesh that '{}' was made from: it has changed since, or is another "
                        "file; run again",
                        file, surface_file));
    return polygons;
}

void export_map(Stage& stage, const std::string& folder, const SurfaceMap& map, const SamplePlan& plan,
                const Surface& A, const Surface& B, const std::array<PolygonSoup, 2>& polygons,
                PlyFormat format) {
    make_folder(folder);
    const std::string there = folder + "/source_to_target.csv", back = folder + "/target_to_source.csv",
                      there_table = to_csv(map.A_to_B), back_table = to_csv(map.B_to_A);
    if (would_change(there, there_table) || would_change(back, back_table)) remove_reports(folder);
    stage.write_file(there, there_table);
    stage.write_file(back, back_table);
    stage.write_file(folder + "/source_to_target.npz", to_npz(map.A_to_B, file_as_read(B)));
    stage.write_file(folder + "/target_to_source.npz", to_npz(map.B_to_A, file_as_read(A)));
    stage.write_file(folder + "/source_masses.csv",
                     masses_csv(A, plan.samples_A, plan.transported_A, plan.mass_A));
    stage.write_file(folder + "/target_masses.csv",
                     masses_csv(B, plan.samples_B, plan.transported_B, plan.mass_B));
    stage.write_file(folder + "/source_vertices.csv", vertices_csv(A));
    stage.write_file(folder + "/target_vertices.csv", vertices_csv(B));
    stage.write_file(folder + "/source_on_target.ply", remeshed_ply(map.A_to_B, A, B, polygons[0], format));
    stage.write_file(folder + "/target_on_source.ply", remeshed_ply(map.B_to_A, B, A, polygons[1], format));
}

}  // namespace varimap
