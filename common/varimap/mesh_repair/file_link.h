#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "varimap/core/enum_names.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// What a repair (mesh_repair.h) made of a vertex of a mesh file. From `unused` on it has no vertex any more.
enum class VertexFate : std::uint8_t {
    kept,
    welded,             ///< shares its vertex with others in the same place
    split,              ///< several sheets meet there, each with a vertex of its own; it goes with the first
    unused,             ///< no face names it
    not_finite,         ///< a coordinate is not a number
    faces_dropped,      ///< all its faces were degenerate, duplicates, or had corners that are not finite
    component_dropped,  ///< it lies on a component that is not mapped
    outside_part,       ///< it lies outside of the part that is mapped (part_region.h)
};

template <>
struct EnumNames<VertexFate> {
    static constexpr std::array names{
        "kept",        "welded", "split", "unused", "not_finite", "faces_dropped", "component_dropped",
        "outside_part"};
};

/// Why no face of the mesh has a vertex of the file, in words: "no face of the file names it".
const char* reason_without_face(VertexFate fate);

/// The way from a repaired mesh back to its file, whose vertices and faces users count. Where nothing was
/// repaired the mesh is as the file has it, and all of this is empty.
struct FileLink {
    TriangleMesh file;             ///< as read
    std::vector<int> vertex;       ///< per vertex of the file: its vertex of the mesh; -1: none
    std::vector<VertexFate> fate;  ///< per vertex of the file
    std::vector<int> origin;       ///< per vertex of the mesh: the vertex of the file it was
    std::vector<int> face;         ///< per face of the mesh: the face of the file; -1: added by the repair
    std::vector<char> turned;  ///< per face of the mesh: its last two corners are exchanged (1), or not (0)

    bool is_identity() const { return vertex.empty(); }
};

/// That of a mesh that is as its file has it, written out so that faces may be added to it.
FileLink link_to_itself(const TriangleMesh& mesh);

/// A map between repaired meshes as one between their files: a row per vertex of the source's file, on faces
/// of the target's file. Points on faces that a repair added go to the closest of the others. `target_mesh`:
/// that of the target's link.
PointMap to_file(const PointMap& map, const FileLink& source, const FileLink& target,
                 const TriangleMesh& target_mesh);

/// The opposite: a map between files as one between their repaired meshes. A vertex that was split has one
/// row in the file, and so one image; images on faces that were dropped are nowhere.
PointMap from_file(const PointMap& map, const FileLink& source, const FileLink& target);

/// The file's vertices, and the faces of `mesh` in their order, named by the vertices of the file.
TriangleMesh in_numbers_of_file(const TriangleMesh& mesh, const FileLink& link);
/// The number of a vertex of the mesh in the file.
int number_in_file(int vertex, const FileLink& link);
/// A face of the mesh by its number in the file: "face 12", or "a face that a repair added".
std::string face_in_words(int face, const FileLink& link);

}  // namespace varimap
