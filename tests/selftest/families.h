#pragma once

#include <optional>
#include <string>
#include <vector>

#include "selftest/body.h"

namespace varimap::shapes {

/// Kinds of shapes whose members have the same parts in other proportions.
const std::vector<std::string>& family_names();

/// A member of the family of that number: its limbs are those of all other members, in the same order.
/// `variation`: 0 for the typical member, 1 for proportions as different as those of animals of several
/// species. `bending`: 0 for the posture at rest.
Body family_member(int family, double variation, double bending, Random& random);

/// Where the point of one member's surface (at rest) lies on another member's: at the same place along and
/// around the same limb. None where several limbs meet, for there it is not told.
std::optional<Vec3> partner(const Body& from, const Body& to, const Vec3& point);

}  // namespace varimap::shapes
