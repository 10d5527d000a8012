#pragma once

#include <Eigen/SparseCore>

#include "varimap/mesh/triangle_mesh.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// Cotangent Laplacian L of a triangle mesh: symmetric, positive semidefinite, rows sum to zero;
/// L_ij = -(cot a + cot b) / 2 for an edge with opposite angles a and b, so that f' L f = integral |grad
/// f|^2. Dimensionless (invariant under scaling). Triangles without area contribute nothing.
Eigen::SparseMatrix<double> cotangent_laplacian(const TriangleMesh& mesh);

/// That of a surface; of another domain L_ij = -(conductance of the edge ij).
Eigen::SparseMatrix<double> laplacian(const Domain& domain);

}  // namespace varimap
