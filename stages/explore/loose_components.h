#pragma once

#include <optional>
#include <vector>

#include "stages/explore/appraisal.h"

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
    double area(int component) const { return areas_[std::size_t(component)]; }
    const TriangleMesh& mesh() const { return surface_.mesh; }
    const std::vector<int>& vertices(int component) const { return vertices_[std::size_t(component)]; }
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

/// Lays the components of a pair of surfaces as a map lays the largest one of A. Over the bridges hardly
/// anything tells how they lie: two eyes may be exchanged, a bar beside a body end up end for end, a foot
/// turned under its pole.
class LooseComponents {
  public:
    /// Keeps references to both.
    LooseComponents(const PairContext& context, const Appraisal& appraisal);

    /// Exchanges the partners of two components that are alike, and that lie to each other as their partners
    /// do once these are exchanged, as the largest component is taken where they are nearest to it. Then
    /// turns components. Left as they are are those that lie as the rest does, to within 20 degrees, that
    /// have no partner, or that have landmarks, and those with which the map fits clearly better as it is.
    /// Returns how many were exchanged or turned.
    int lay_as_the_rest(MapPair& maps) const;

  private:
    struct Rest;
    struct Neighbourhood;
    /// `images`: of the vertices of A.
    Neighbourhood neighbourhood(const Vec3& place, const Points& images, bool opposed) const;
    /// Of each component of A the one of B that a map and its inverse lead to, where both may be laid anew.
    std::vector<std::optional<int>> partners(const MapPair& maps) const;
    /// The component of B that a map and its inverse lead to from one of A, if both can be laid.
    std::optional<int> counterpart(int component, const MapPair& maps) const;
    /// `images`: as above.
    int exchange(MapPair& maps, const Points& images, Rest& rest) const;
    int turn(MapPair& maps, Rest& rest) const;
    /// Whether the map with components laid anew fits not worse by `much`, in rough score; then it is kept.
    bool keep(MapPair& maps, MapPair laid, double much, Rest& rest) const;

    const PairContext& context_;
    const Appraisal& appraisal_;
    SurfaceComponents A_, B_;
};

}  // namespace varimap
