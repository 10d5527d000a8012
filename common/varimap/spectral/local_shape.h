#pragma once

#include <Eigen/Core>

#include "varimap/spectral/surface_data.h"

namespace varimap {

/// How far each vertex stands out of the smoothed surface, along the outward normal, units of sqrt(area): the
/// surface less its heat flow (by the eigenbasis) at a time in units of area. Positive on ridges, negative in
/// hollows. Isometries do not keep it, so it tells a toe from a heel where distances on the surface hardly
/// do.
Eigen::VectorXd bending(const SurfaceData& data, double time);

/// How far it is through the shape from each vertex, along the inward normal and around it, units of
/// sqrt(area). Rays that leave through a hole count as long ones, as do those of vertices without a normal.
Eigen::VectorXd thickness(const Surface& surface);

/// vertices x F features that tell parts of a surface apart by their shape, not by where they are: bending at
/// two times and thickness, compressed, of mean 0 and together of variance 1; near 0 where all places are
/// alike. They were chosen because between shapes of different proportions true correspondences agree in them
/// better than maps of least energy do. For heat kernels, whose low frequencies feel proportions just as the
/// energy does, the opposite holds.
RowMatrix local_shape(const SurfaceData& data);

}  // namespace varimap
