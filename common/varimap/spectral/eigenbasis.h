#pragma once

#include <Eigen/Core>
#include <string>

#include "varimap/artifact/artifact.h"
#include "varimap/core/linear_algebra.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// The smallest eigenpairs of L phi = lambda M phi on a domain (L: laplacian.h, of a surface of unit area by
/// cotangents; M: diagonal masses). phi' M phi = 1, eigenvalues ascending, lambda_1 = 0 with phi_1 = 1.
///
/// The signs of the functions and the bases of multiple eigenvalues are arbitrary; everything built on them
/// uses inner products over complete eigenspaces only: the count is cut where a gap follows.
struct Basis {
    Eigen::VectorXd eigenvalues;  ///< M values, units of 1/area
    RowMatrix functions;          ///< vertices x M
    /// |L phi - lambda M phi| in the norm of the shifted Laplacian's inverse: the error's energy. Its root,
    /// relative to that of max(lambda, lambda_2).
    Eigen::VectorXd residuals;
};

template <>
struct ArtifactType<Basis> {
    static constexpr const char* kind = "basis";
    static constexpr const char* stage = "varimap-eigen";
    static constexpr int schema = 1;
};
std::string encode(const Basis& basis);
void decode(const std::string& payload, Basis& basis);

/// How many eigenpairs compute_eigenbasis looks for, and how exactly.
struct EigenSolverOptions {
    int count = 100;                 ///< eigenpairs wanted (the paper's M), capped by the number of vertices
    double shift = -0.01;            ///< shift of the inverse iteration, below the spectrum, units of 1/area
    double tolerance = 1e-10;        ///< relative accuracy of the eigenvalues
    double maximum_residual = 1e-6;  ///< larger residuals are refused
};

/// Shift-invert Lanczos (Spectra) on the Cholesky factors of L - shift M. Deterministic.
/// Throws ConvergenceError if the solver fails or a residual is too large.
Basis compute_eigenbasis(const Domain& domain, const EigenSolverOptions& options);

/// Diffusion embedding Phi_t (Eq. 4) of the given vertices: row v holds exp(-lambda_k t / 2) phi_k(v).
RowMatrix diffusion_embedding(const Basis& basis, double time, const std::vector<int>& vertices);
/// The same for all vertices.
RowMatrix diffusion_embedding(const Basis& basis, double time);

/// t_0 = ln 10 / lambda_2, the coarsest diffusion time (Sec. 4.2).
double coarsest_time(const Basis& basis);

}  // namespace varimap
