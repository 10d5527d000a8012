#pragma once

#include <string>
#include <vector>

#include "stages/partners/params.h"
#include "stages/partners/partners.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// One side of a picture.
struct PicturedDomain {
    const Domain& domain;
    const std::vector<Partner>& partners;
};

/// An SVG: the source in colours of its own, the target's points in those of their partners; what is less
/// certain is paler. Together, lines lead from each point of the source to `centres`, where the plan takes
/// it.
std::string picture_of(const PicturedDomain& source, const PicturedDomain& target, const Points& centres,
                       Layout layout);

}  // namespace varimap
