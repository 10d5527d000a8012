#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/mesh/surface.h"
#include "varimap/results/untangling_report.h"

namespace varimap {

/// The dense map in both directions, between the mesh FILES: the artifact of varimap-relax. A_to_B has one
/// row per vertex of A's file, in its order, on faces of B's file; face -1 for vertices that have no image
/// (file_link.h says why).
struct SurfaceMap {
    PointMap A_to_B;
    PointMap B_to_A;
    UntanglingReports untangling;
};

template <>
struct ArtifactType<SurfaceMap> {
    static constexpr const char* kind = "map";
    static constexpr const char* stage = "varimap-relax";
    static constexpr int schema = 2;
};
std::string encode(const SurfaceMap& map);
/// Throws ArtifactError unless points are points and numbers of the reports are finite.
void decode(const std::string& payload, SurfaceMap& map);

/// Throws ArtifactError if the map is not one between the files of these surfaces.
void require_surfaces(const SurfaceMap& map, const Surface& A, const Surface& B);

/// `vertex,face,b0,b1,b2`, one row per vertex; numbers read back exactly, in any locale.
std::string to_csv(const PointMap& map);
/// Throws InputError naming file and line.
PointMap read_csv_map(const std::string& path);
/// Whether the first line is that of such a table.
bool is_csv_map(std::string_view bytes);
PointMap parse_csv_map(std::string_view bytes, const std::string& path);
/// Throws InputError, beginning with `place`, for a point that is neither nowhere nor has barycentric
/// coordinates in [0, 1] of sum 1, to the few digits of other programs; `faces`: their number, if known.
void require_near_surface(const SurfacePoint& point, const std::string& place, int faces = -1);

/// The same as an .npz: `face` (int32), `barycentric` (n x 3), `nearest_vertex` (int32; -1 as of faces), and
/// `format`, `shape`, `data`, `indices`, `indptr` of the sparse matrix (CSR, as SciPy's load_npz reads it)
/// that takes values of the vertices of `target` to the images; rows without an image are empty.
std::string to_npz(const PointMap& map, const TriangleMesh& target);

/// Positions on `target` of a map's images; rows without an image keep the given fallback row.
Points image_positions(const PointMap& map, const TriangleMesh& target, const Points& fallback);

/// The surface's input with the faces of its file alone, without those that a repair added: what maps are
/// measured on.
TriangleMesh without_added_faces(const Surface& surface);

}  // namespace varimap
