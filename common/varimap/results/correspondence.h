#pragma once

#include <string>

#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// A map between two meshes as files hold it, in the direction in which things are carried.
struct Correspondence {
    std::string from_file, to_file;
    TriangleMesh from, to;
    PointMap there;  ///< per vertex of `from`: where it lies on `to`
    PointMap back;   ///< per vertex of `to`: where it lies on `from`
};

/// The files of a map, source first.
struct MapFiles {
    std::string source, target, source_to_target, target_to_source;
};

/// Throws ArtifactError where a mesh is no longer the one whose content had that hash (file_hash): vertices
/// and faces of a map would be other places. An empty hash is not asked about.
void require_unchanged(const std::string& path, const std::string& hash);

/// Throws InputError where a table, read from `path`, is not one of these meshes, naming the files.
void require_fit(const PointMap& map, const std::string& path, const TriangleMesh& from,
                 const std::string& from_file, const TriangleMesh& to, const std::string& to_file);

/// What to do with faces that have a corner which is not finite; maps leave them out.
enum class UnplacedFaces { refuse, collapse };

/// Reads a map from source to target, or, where `reverse`, from target to source. Faces that have a corner
/// which is not finite are refused, or become points on a finite vertex, so that the others keep their
/// numbers. Throws InputError for these, and where a table is not one of these meshes; IoError.
Correspondence read_correspondence(const MapFiles& files, bool reverse,
                                   UnplacedFaces unplaced = UnplacedFaces::refuse);

/// Carries points of one surface to another through a map of its vertices: linearly in space between the
/// images of a face's corners, then to the closest point that faces as these images do, so that the other
/// side of a thin part does not attract. A vertex goes exactly to its image. Thread-safe; keeps references to
/// the meshes and the map.
class PointCarrier {
  public:
    PointCarrier(const TriangleMesh& from, const PointMap& map, const TriangleMesh& to);
    /// Nowhere where the point is, or where a corner of its face has no image.
    SurfacePoint operator()(const SurfacePoint& point) const;

  private:
    const TriangleMesh& from_;
    const PointMap& map_;
    const TriangleMesh& to_;
    ClosestPoint closest_;
    TriangleMesh normals_;  ///< normals of `to` at its vertices, in place of positions
};

}  // namespace varimap
