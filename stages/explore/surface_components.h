#pragma once

#include <optional>
#include <vector>

#include "varimap/surface/surface.h"

namespace varimap {

/// The components of what was mapped, which hang together by thin bridges (bridges.h). One holds all where
/// nothing was joined, and of a part that was cut out, whose pieces lie as they did. Keeps a reference to the
/// surface.
class SurfaceComponents {
  public:
    explicit SurfaceComponents(const Surface& surface);

    int count() const { return int(areas_.size()); }
    /// Whether there are two or more that matter: of a twentieth of the area.
    bool are_several() const;
    int largest() const;
    /// The component that a vertex lies on; none on a bridge.
    std::optional<int> of(int vertex) const;
    double area(int component) const { return areas_[std::size_t(component)]; }
    const TriangleMesh& mesh() const { return surface_.mesh; }
    const std::vector<int>& vertices(int component) const { return vertices_[std::size_t(component)]; }
    /// Whether it has vertices enough to tell how it lies, and faces.
    bool can_be_laid(int component) const;
    /// Those with all corners on it.
    std::vector<int> faces(int component) const;
    bool holds_any(int component, const std::vector<int>& of_vertices) const;

    /// Mean of what the vertices of a component have.
    Vec3 mean(int component, const Points& points) const;
    /// The rotation, or the best reflection, that takes a component nearest to images of the vertices.
    Eigen::Matrix3d turn(int component, const Points& images, bool mirrored) const;
    /// The component of another surface that holds the images of most of one; none if none does.
    std::optional<int> partner(int component, const PointMap& map, const SurfaceComponents& to) const;

  private:
    bool holds(int component, int vertex) const { return of_[std::size_t(vertex)] == component; }

    const Surface& surface_;
    std::vector<int> of_;  ///< per vertex of the mesh: its component; -1 where a repair added what is there
    std::vector<std::vector<int>> vertices_;
    std::vector<double> areas_;
};

/// Lays components of one surface onto those of another. Keeps references.
class ComponentLaying {
  public:
    /// `opposed`: the faces of one of the surfaces look inward.
    ComponentLaying(const SurfaceComponents& from, const SurfaceComponents& to, bool opposed);

    /// Turned, centre on centre, and as large as the other.
    void lay(PointMap& map, int component, int onto, const Eigen::Matrix3d& turn) const;

  private:
    const SurfaceComponents &from_, &to_;
    Points normals_;  ///< at the vertices
};

}  // namespace varimap
