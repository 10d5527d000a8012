#pragma once

#include <string>
#include <vector>

#include "stages/generate/body.h"
#include "stages/generate/params.h"
#include "stages/generate/random.h"

namespace varimap::shapes {

/// Kinds of shapes whose members have the same parts in other proportions.
const std::vector<std::string>& family_names();

/// A member of the family of that number (of family_names): its limbs are those of all other members, in the
/// same order; some may be missing. Of the parameters all but `vertices` count. Deterministic. Its surface
/// should be that of a ball, but limbs drawn too close may touch: Body::sphere_mesh tells.
Body family_member(int family, const GenerateParams& params, Random& random);

}  // namespace varimap::shapes
