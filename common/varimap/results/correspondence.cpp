#include "varimap/results/correspondence.h"

#include <fmt/format.h>

#include <utility>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/results/map_table.h"

namespace varimap {

namespace {

bool is_finite(const TriangleMesh& mesh, int f) {
    return mesh.vertex(mesh.faces(f, 0)).allFinite() && mesh.vertex(mesh.faces(f, 1)).allFinite() &&
           mesh.vertex(mesh.faces(f, 2)).allFinite();
}

/// Maps leave such faces out, but a surface with holes that no file tells of is none to carry things on.
TriangleMesh read_finite_mesh(const std::string& path, UnplacedFaces unplaced) {
    TriangleMesh mesh = read_mesh(path);
    int anchor = 0;
    while (anchor < mesh.face_count() && !is_finite(mesh, anchor)) ++anchor;
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (is_finite(mesh, f)) continue;
        if (unplaced == UnplacedFaces::refuse || anchor == mesh.face_count())
            throw InputError(
                fmt::format("{}: face {} (from 0) has a corner that is not finite; mend the file to carry "
                            "things through its map",
                            path, f));
        mesh.faces.row(f).setConstant(mesh.faces(anchor, 0));
    }
    return mesh;
}

}  // namespace

void require_fit(const PointMap& map, const std::string& path, const TriangleMesh& from,
                 const std::string& from_file, const TriangleMesh& to, const std::string& to_file) {
    if (int(map.size()) != from.vertex_count())
        throw InputError(fmt::format("{}: {} rows, but {} has {} vertices: this is a map of another mesh",
                                     path, map.size(), from_file, from.vertex_count()));
    for (std::size_t v = 0; v < map.size(); ++v)
        if (map[v].face >= to.face_count())
            throw InputError(fmt::format("{}:{}: face {}, but {} has {} faces: this is a map to another mesh",
                                         path, v + 2, map[v].face, to_file, to.face_count()));
}

void require_unchanged(const std::string& path, const std::string& hash) {
    if (!hash.empty() && file_hash(path) != hash)
        throw ArtifactError(path + ": changed since the map was made; make the map again");
}

Correspondence read_correspondence(const MapFiles& files, bool reverse, UnplacedFaces unplaced) {
    Correspondence map{files.source,
                       files.target,
                       read_finite_mesh(files.source, unplaced),
                       read_finite_mesh(files.target, unplaced),
                       read_csv_map(files.source_to_target),
                       read_csv_map(files.target_to_source)};
    require_fit(map.there, files.source_to_target, map.from, files.source, map.to, files.target);
    require_fit(map.back, files.target_to_source, map.to, files.target, map.from, files.source);
    if (!reverse) return map;
    return {map.to_file,         map.from_file,       std::move(map.to),
            std::move(map.from), std::move(map.back), std::move(map.there)};
}

PointCarrier::PointCarrier(const TriangleMesh& from, const PointMap& map, const TriangleMesh& to)
    : from_(from), map_(map), to_(to), closest_(to), normals_{vertex_normals(to), to.faces, to.space} {}

SurfacePoint PointCarrier::operator()(const SurfacePoint& point) const {
    if (point.face < 0) return {};
    Vec3 place = Vec3::Zero(), normal = Vec3::Zero(), on_one_face = Vec3::Zero();
    bool one_face = true;
    int first = -1;
    for (const auto [vertex, weight] : WeightedCorners(from_, point)) {
        const SurfacePoint& image = map_[std::size_t(vertex)];
        if (image.face < 0) return {};
        if (first < 0) first = image.face;
        one_face = one_face && image.face == first;
        on_one_face += weight * image.barycentric;
        place += weight * position(to_, image);
        normal += weight * position(normals_, image);
    }
    if (one_face) return {first, on_one_face};
    return closest_(place, normal).point;
}

}  // namespace varimap
