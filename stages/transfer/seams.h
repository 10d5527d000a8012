#pragma once

#include "varimap/mesh_files/obj_model.h"
#include "varimap/results/correspondence.h"

namespace varimap {

/// Texture coordinates of a mesh as a function on it.
class Atlas {
  public:
    /// Every face must have texture coordinates. Keeps references.
    Atlas(const TriangleMesh& mesh, const ObjModel& model) : mesh_(mesh), model_(model) {}
    Vec2 operator()(const SurfacePoint& point) const;
    /// Whether one goes from a face into the other without leaving their neighbourhood or crossing a seam:
    /// they are the same, or share places of vertices and have the same coordinates there, and the same
    /// material. Files often list a vertex once for each of its faces.
    bool joined(int f, int g) const;
    int material(int f) const { return model_.material[std::size_t(f)]; }

  private:
    const TriangleMesh& mesh_;
    const ObjModel& model_;
};

/// The mesh `map.to` with the texture coordinates of `model`, which belongs to `map.from`: faces that a seam
/// (or a border of materials) crosses are cut there, so that none spans it; cuts of faces side by side meet
/// where both have as many. New vertices stand behind the others. Faces without an image have no coordinates.
TexturedMesh cut_at_seams(const Correspondence& map, const PointCarrier& back, const ObjModel& model);

}  // namespace varimap
