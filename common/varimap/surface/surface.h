#pragma once

#include <string>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/mesh_repair/file_link.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// A surface ready for the method: the artifact of varimap-preprocess and of varimap-coarsen.
///
/// Masses are Voronoi areas (mass.h), edges and coordinates there are none. `mesh` has unit area and its area
/// centroid at the origin. Of varimap-preprocess, its edges are no longer than the target length (Sec. 5,
/// Limitations: recursive longest-edge bisection), each of its faces lies inside one input face, and the used
/// input vertices are its first vertices, in input order. Where the input has faces too thin for the method
/// (thin_faces.h), these have no counterpart, input vertices that are the same for all purposes share one of
/// `mesh`, and a face may lie off its input face by that little. Of varimap-coarsen, `mesh` has some of those
/// vertices (coarsening.h), and its faces lie near the input.
struct Surface : Domain {
    TriangleMesh input;  ///< the input in its own coordinates, polygons cut, vertex order kept; repaired
    FileLink link;       ///< from `input`, not mirrored, to the file it was read from
    PointMap on_mesh;    ///< per input vertex: where it lies on mesh, one to one; nowhere without a face
    std::vector<int> input_face;  ///< per face of mesh: the input face it lies in; none where mesh is coarser
    PointMap on_input;            ///< per vertex of mesh: where it lies on the input
    Vec3 centre = Vec3::Zero();   ///< x_mesh = (x_input - centre) * scale
    double scale = 1;
};

template <>
struct ArtifactType<Surface> {
    static constexpr const char* kind = "surface";
    static constexpr const char* stage = "varimap-preprocess";
    static constexpr int schema = 5;
};
std::string encode(const Surface& surface);
void decode(const std::string& payload, Surface& surface);

/// The surface with the opposite orientation: faces with their last two corners exchanged, `mirrored`
/// toggled. A map from it that preserves orientation reverses that of the original.
Surface with_reversed_orientation(Surface surface);
/// `surface.input` in the orientation of its file, whether the surface is mirrored or not.
TriangleMesh input_as_read(const Surface& surface);
/// A map from `source.input` to `target.input` as one between their files (file_link.h), and back. Where a
/// surface is mirrored, the last two corners of its file's faces are exchanged.
PointMap to_file(PointMap map, const Surface& source, const Surface& target);
PointMap from_file(const PointMap& map, const Surface& source, const Surface& target);
/// The surface's file as it was read; where nothing was repaired and the surface is mirrored, mirrored too.
const TriangleMesh& file_of(const Surface& surface);

/// Whether it is a part that was cut out of its file (part_region.h).
bool is_cut_out(const Surface& surface);

/// Whether of two surfaces one is inside out, its faces looking inward, and neither was mirrored: all maps
/// that keep the orientation are then those of a mirror image. Not where one has no inside (orientation_sign,
/// boundary.h).
bool one_is_inside_out(const Surface& A, const Surface& B);

/// A point of a mesh as barycentric coordinates of another face that holds it too: exact by the vertices that
/// both faces name; where these are not enough, because a repair moved the point, those of the closest point.
Vec3 barycentric_on(const TriangleMesh& mesh, int face, const SurfacePoint& point);

/// The same point, from a face of `surface.mesh` to the input face that holds it. Coordinates clamped to [0,
/// 1]. For surfaces that were not coarsened; input_locator.h serves all.
SurfacePoint to_input(const Surface& surface, const SurfacePoint& on_mesh);

/// Whether a repair added faces to those of the file: lids on holes, tubes between components.
bool has_added_faces(const Surface& surface);

/// The surface's input with the faces of its file alone, without those that a repair added: what maps are
/// measured on.
TriangleMesh without_added_faces(const Surface& surface);

}  // namespace varimap
