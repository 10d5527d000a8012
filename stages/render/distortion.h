#pragma once

#include <vector>

#include "stages/render/render.h"
#include "stages/render/view.h"
#include "varimap/quality/quality.h"

namespace varimap {

/// One surface and how the map from it changes masses, areas and angles.
struct DistortedSurface {
    TriangleMesh mesh;  ///< at unit area
    std::vector<TriangleDistortion> triangles;
    Eigen::VectorXd mass_ratio;  ///< per vertex; NaN: not known
    View view;
};

/// The picture of render_distortion() (render.h).
Image draw_distortion(const DistortedSurface& source, const DistortedSurface& target,
                      const RenderParams& params);

}  // namespace varimap
