#pragma once

#include <optional>
#include <vector>

#include "stages/explore/appraisal.h"
#include "stages/explore/surface_components.h"

namespace varimap {

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
    /// Of each component of A that has a partner, where the middle goes as the largest one is taken there.
    std::vector<Vec3> places_beside_largest(const std::vector<std::optional<int>>& partner,
                                            const Points& images, bool opposed) const;
    /// `images`: as above.
    int exchange(MapPair& maps, const Points& images, Rest& rest) const;
    int turn(MapPair& maps, Rest& rest) const;
    /// Whether the map with components laid anew fits not worse by `much`, in rough score; then it is kept.
    bool keep(MapPair& maps, MapPair laid, double much, Rest& rest) const;

    const PairContext& context_;
    const Appraisal& appraisal_;
    const SurfaceComponents &A_, &B_;
};

}  // namespace varimap
