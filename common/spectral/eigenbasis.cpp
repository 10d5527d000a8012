#include "common/spectral/eigenbasis.h"

#include <Eigen/SparseCholesky>
#include <Spectra/SymEigsShiftSolver.h>
#include <algorithm>
#include <cmath>

#include "common/artifact/cereal_eigen.h"
#include "common/spectral/laplacian.h"
#include "common/stage/error.h"

namespace varimap {

namespace {

/// y = (M^-1/2 L M^-1/2 - shift)^-1 x through a Cholesky factorisation of L - shift M, which is definite for
/// a shift below zero. The operator Spectra iterates on.
class ShiftInvert {
  public:
    using Scalar = double;
    ShiftInvert(const Eigen::SparseMatrix<double>& L, const Eigen::VectorXd& mass)
        : L_(L), mass_(mass), root_mass_(mass.cwiseSqrt()) {}

    Eigen::Index rows() const { return mass_.size(); }
    Eigen::Index cols() const { return mass_.size(); }

    void set_shift(double shift) {
        Eigen::SparseMatrix<double> shifted = L_;
        shifted.diagonal() -= shift * mass_;
        factors_.compute(shifted);
        if (factors_.info() != Eigen::Success)
            throw ConvergenceError("the shifted Laplacian cannot be factorised; check the mesh for degenerate triangles");
    }

    void perform_op(const double* in, double* out) const {
        const Eigen::Map<const Eigen::VectorXd> x(in, rows());
        Eigen::Map<Eigen::VectorXd>(out, rows()) = root_mass_.cwiseProduct(factors_.solve(root_mass_.cwiseProduct(x)));
    }

  private:
    const Eigen::SparseMatrix<double>& L_;
    const Eigen::VectorXd& mass_;
    Eigen::VectorXd root_mass_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

/// Number of leading eigenvalues after which a gap follows, so that no eigenspace is cut in two.
int complete_eigenspaces(const Eigen::VectorXd& ascending, int wanted) {
    int count = std::min<int>(wanted, int(ascending.size()));
    const auto gap_follows = [&](int k) {
        return k >= int(ascending.size()) || ascending[k] - ascending[k - 1] > 1e-6 * ascending[k];
    };
    while (count > 2 && !gap_follows(count)) --count;
    return count;
}

Eigen::VectorXd relative_residuals(const Eigen::SparseMatrix<double>& L, const Eigen::VectorXd& mass,
                                   const Basis& basis) {
    const double smallest = basis.eigenvalues[1];
    Eigen::VectorXd residuals(basis.eigenvalues.size());
    for (int k = 0; k < residuals.size(); ++k) {
        const Eigen::VectorXd phi = basis.functions.col(k);
        const Eigen::VectorXd r = L * phi - basis.eigenvalues[k] * mass.cwiseProduct(phi);
        residuals[k] = std::sqrt(r.cwiseAbs2().cwiseQuotient(mass).sum()) / std::max(basis.eigenvalues[k], smallest);
    }
    return residuals;
}

}  // namespace

Basis compute_eigenbasis(const Surface& surface, const EigenSolverOptions& options) {
    const int n = surface.mesh.vertex_count();
    // One pair more than wanted tells whether the last eigenspace is complete.
    const int computed = std::min(options.count + 1, n - 1);
    if (computed < 3)
        throw InputError("a surface of " + std::to_string(n) + " vertices has too few eigenfunctions; refine the mesh");
    const int krylov = std::min(n, std::max(2 * computed, computed + 20));

    const Eigen::SparseMatrix<double> L = cotangent_laplacian(surface.mesh);
    ShiftInvert op(L, surface.mass);
    Spectra::SymEigsShiftSolver<ShiftInvert> solver(op, computed, krylov, options.shift);
    solver.init();
    const int converged = int(solver.compute(Spectra::SortRule::LargestMagn, 1000, options.tolerance,
                                             Spectra::SortRule::SmallestAlge));
    if (solver.info() != Spectra::CompInfo::Successful || converged < computed)
        throw ConvergenceError("only " + std::to_string(converged) + " of " + std::to_string(computed) +
                               " eigenpairs converged; lower --count or check the mesh for degenerate triangles");

    const Eigen::VectorXd values = solver.eigenvalues();
    const int count = complete_eigenspaces(values, std::min(options.count, computed));
    Basis basis;
    basis.eigenvalues = values.head(count);
    basis.functions = surface.mass.cwiseSqrt().cwiseInverse().asDiagonal() * solver.eigenvectors().leftCols(count);
    // The kernel of L is known exactly for a connected surface.
    basis.eigenvalues[0] = 0;
    basis.functions.col(0).setConstant(1 / std::sqrt(surface.mass.sum()));
    if (!(basis.eigenvalues[1] > 0))
        throw ConvergenceError("the second eigenvalue is not positive; is the surface connected?");
    basis.residuals = relative_residuals(L, surface.mass, basis);
    if (!(basis.residuals.maxCoeff() <= options.maximum_residual))
        throw ConvergenceError("an eigenpair has residual " + std::to_string(basis.residuals.maxCoeff()) +
                               "; check the mesh for degenerate triangles");
    return basis;
}

RowMatrix diffusion_embedding(const Basis& basis, double time, const std::vector<int>& vertices) {
    const Eigen::RowVectorXd decay = (-0.5 * time * basis.eigenvalues.array()).exp().matrix().transpose();
    RowMatrix embedding(vertices.size(), basis.eigenvalues.size());
    for (size_t i = 0; i < vertices.size(); ++i)
        embedding.row(i) = basis.functions.row(vertices[i]).cwiseProduct(decay);
    return embedding;
}

RowMatrix diffusion_embedding(const Basis& basis, double time) {
    const Eigen::RowVectorXd decay = (-0.5 * time * basis.eigenvalues.array()).exp().matrix().transpose();
    return basis.functions * decay.asDiagonal();
}

double coarsest_time(const Basis& basis) { return std::log(10.0) / basis.eigenvalues[1]; }

template <class Archive>
void serialize(Archive& archive, Basis& basis) {
    archive(basis.eigenvalues, basis.functions, basis.residuals);
}
std::string encode(const Basis& basis) { return cereal_encode(basis); }
void decode(const std::string& payload, Basis& basis) { cereal_decode(payload, basis); }

}  // namespace varimap
