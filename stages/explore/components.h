#pragma once

#include <optional>
#include <vector>

#include "stages/explore/appraisal.h"

namespace varimap {

/// The components of what was mapped, which hang together by thin bridges (bridges.h). Keeps a reference to
/// the surface.
class Components {
  public:
    explicit Components(const Surface& surface);

    bool are_several() const { return areas_.size() > 1; }
    int count() const { return int(areas_.size()); }
    int largest() const;
    double area(int component) const { return areas_[std::size_t(component)]; }
    const TriangleMesh& mesh() const { return surface_.mesh; }
    const std::vector<int>& vertices(int component) const { return vertices_[std::size_t(component)]; }
    bool holds(int component, int vertex) const { return of_[std::size_t(vertex)] == component; }
    /// Those with all corners on it.
    std::vector<int> faces(int component) const;

    /// Mean of what the vertices of a component have.
    Vec3 mean(int component, const Points& points) const;
    /// The rotation, or the best reflection, that takes a component nearest to images of the vertices.
    Eigen::Matrix3d turn(int component, const Points& images, bool mirrored) const;
    /// The component of another surface that holds the images of most of one; none if none does.
    std::optional<int> partner(int component, const PointMap& map, const Components& to) const;

  private:
    const Surface& surface_;
    std::vector<int> of_;  ///< per vertex of the mesh: its component; -1 where a repair added what is there
    std::vector<std::vector<int>> vertices_;
    std::vector<double> areas_;
};

/// Turns the components of a pair of surfaces as a map turns the largest ones. Over the bridges hardly
/// anything tells how the others lie: a bar beside a body may end up end for end, a foot turned under its
/// pole.
class ComponentTurns {
  public:
    /// Keeps references to both.
    ComponentTurns(const PairContext& context, const Appraisal& appraisal);

    /// Left as they are are components that lie as the rest does, to within 20 degrees, that have no partner,
    /// or that have landmarks, and those with which the map fits clearly better as it is.
    void as_the_rest(MapPair& maps) const;

  private:
    const PairContext& context_;
    const Appraisal& appraisal_;
    Components A_, B_;
};

}  // namespace varimap
