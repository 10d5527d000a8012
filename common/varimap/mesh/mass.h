#pragma once

#include "varimap/core/indexed.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Mixed Voronoi areas (Meyer et al. 2003) as shares of the total: per vertex, sums to 1. A face is cut at
/// its circumcentre; an obtuse face gives half to its obtuse corner and a quarter to each other one. Positive
/// for every used vertex (vertices without area get 1e-12 of the mean), 0 for unused ones.
Eigen::VectorXd voronoi_masses(const TriangleMesh& mesh);

/// Per vertex a third of the area of its faces, in units of the mesh squared.
VertexData<double> vertex_areas(const TriangleMesh& mesh);

/// Centre of mass of the surface as a thin shell. The total area must be positive.
Vec3 area_centroid(const TriangleMesh& mesh);

/// Length of the edges of a mesh of unit area if all its faces were equilateral and equal.
double equilateral_edge(const TriangleMesh& mesh);

}  // namespace varimap
