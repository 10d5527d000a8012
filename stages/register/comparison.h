#pragma once

#include <vector>

#include "stages/register/extent.h"
#include "stages/register/manifest.h"
#include "stages/register/procrustes.h"

namespace varimap {

/// How the specimens differ in shape. The mean shape and the components are of those that are whole, on what
/// they have in common; parts are laid over the mean shape, each by what it has of that. Where all are parts
/// the mean shape is the template's. Mirrored specimens are compared as their mirror images. Lists have one
/// entry per specimen.
struct ShapeComparison {
    Points mean;                  ///< of the common extent
    std::vector<Points> aligned;  ///< each of its own extent
    std::vector<double>
        sizes;  ///< root mean square distance from the centroid; a part's, as if it were whole
    std::vector<double> distances;  ///< from the mean shape, root mean square over the own extent
    std::vector<bool> is_outlier;
    PrincipalComponents components;  ///< scores: a row for each specimen that is whole
};

/// `components`: at most so many. `scale`: bring all to one size first.
ShapeComparison compare_shapes(const Registration& all, const Extents& extents, int components, bool scale);

}  // namespace varimap
