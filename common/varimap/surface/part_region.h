#pragma once

#include <limits>
#include <string>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/core/indexed.h"
#include "varimap/mesh_repair/mesh_repair.h"

namespace varimap {

/// Where a part lies on the whole that it belongs to: the artifact of varimap-locate, by which
/// varimap-preprocess cuts the whole and varimap-diffuse and varimap-relax begin.
struct PartRegion {
    int face_count = 0;           ///< of the whole's input (Surface)
    std::vector<int> faces;       ///< those of them that the part covers, ascending
    bool part_is_source = false;  ///< else the target is the part
    PointMap placed;              ///< per vertex of the part's file: where it lies on the whole's file
    /// Mean robust excess energy of the part as placed; infinite if it is not.
    double strain = std::numeric_limits<double>::infinity();

    /// Whether the place is doubtful: stages/locate/README.md has what right and wrong ones are strained by.
    bool is_strained() const { return strain > much_strain; }
    static constexpr double much_strain = 0.12;
};

template <>
struct ArtifactType<PartRegion> {
    static constexpr const char* kind = "region";
    static constexpr const char* stage = "varimap-locate";
    static constexpr int schema = 3;
};
std::string encode(const PartRegion& region);
void decode(const std::string& payload, PartRegion& region);

/// Throws ArtifactError unless `placed` has a point for each vertex of the part's file, on a face of the
/// whole's.
void require_places(const PartRegion& region, const TriangleMesh& part_file, const TriangleMesh& whole_file);

/// Marks strips of `between`'s faces that join marked patches to the largest of them, where there are such:
/// the shortest, in faces, on the way from there.
void join_patches(const TriangleMesh& mesh, const FaceData<char>& between, FaceData<char>& marked);

/// The marked faces of a manifold mesh, of which at least one is marked, as a surface with boundary: unmarked
/// patches of less than a thousandth of the mesh's area are added, marked ones of less than a twentieth of
/// the marked area are left out unless there is no larger one, and where marked faces meet in a vertex alone,
/// all faces there are added. Ascending.
std::vector<int> tidy_region(const TriangleMesh& mesh, FaceData<char> marked);

/// The whole without the faces outside of the region; vertices of the file that have none any more are
/// `outside_part`. Throws ArtifactError where the region has not the mesh's number of faces.
RepairedMesh cropped(RepairedMesh whole, const PartRegion& region);

}  // namespace varimap
