#pragma once

#include "varimap/results/correspondence.h"

namespace varimap {

/// A map for the eye: surfaces of more than `most` vertices are coarsened to so many (coarsening.h), and
/// images go to the closest points of the coarse surfaces that face the same way. Surfaces that are not
/// manifold, and cannot be coarsened, stay as they are.
Correspondence thinned(const Correspondence& map, int most);

}  // namespace varimap
