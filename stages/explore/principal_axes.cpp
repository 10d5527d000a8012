#include "stages/explore/principal_axes.h"

#include <Eigen/Eigenvalues>

namespace varimap {

PrincipalAxes principal_axes(const Surface& surface) {
    const Points& x = surface.mesh.vertices;
    const Eigen::Matrix3d covariance = x.transpose() * surface.mass.asDiagonal() * x;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    PrincipalAxes principal{solver.eigenvectors(), solver.eigenvalues().cwiseMax(1e-12).cwiseSqrt()};
    if (principal.axes.determinant() < 0) principal.axes.col(0) *= -1;
    return principal;
}

}  // namespace varimap
