#pragma once

#include <optional>

#include "stages/generate/body.h"

namespace varimap::shapes {

/// Where points of one member's surface (at rest) lie on another's of the same family: at the same place
/// along and around the same limb. The partner's partner is the point itself.
class Partner {
  public:
    Partner(const Body& from, const Body& to);
    /// None where, on either surface, several limbs meet, for there it is not told, or where the limb is
    /// missing.
    std::optional<Vec3> operator()(const Vec3& point) const;

  private:
    std::vector<Limb> limbs_, others_;
    BodyDistance distance_;  ///< of the other's surface
};

}  // namespace varimap::shapes
