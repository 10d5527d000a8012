#include "varimap/spectral/eigenbasis.h"

#include <Spectra/SymEigsShiftSolver.h>
#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "varimap/artifact/cereal_eigen.h"
#include "varimap/core/error.h"
#include "varimap/core/index_set.h"
#include "varimap/spectral/laplacian.h"
#include "varimap/spectral/spectral_check.h"

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
            throw ConvergenceError(
                "the shifted Laplacian cannot be factorised; check the mesh for degenerate triangles");
    }

    /// (L - shift M)^-1 r
    Eigen::VectorXd solve(const Eigen::VectorXd& r) const { return factors_.solve(r); }

    /// Restricts the operator to the complement of these orthonormal columns.
    void deflate(const Eigen::MatrixXd& vectors) { known_ = vectors; }

    void perform_op(const double* in, double* out) const {
        const Eigen::VectorXd x = complement(Eigen::Map<const Eigen::VectorXd>(in, rows()));
        Eigen::Map<Eigen::VectorXd>(out, rows()) =
            complement(root_mass_.cwiseProduct(solve(root_mass_.cwiseProduct(x))));
    }

  private:
    Eigen::VectorXd complement(Eigen::VectorXd x) const {
        if (known_.cols() > 0) x -= known_ * (known_.transpose() * x);
        return x;
    }

    const Eigen::SparseMatrix<double>& L_;
    const Eigen::VectorXd& mass_;
    Eigen::VectorXd root_mass_;
    Eigen::MatrixXd known_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

/// Eigenvalues, ascending, and eigenvectors of M^-1/2 L M^-1/2.
struct EigenPairs {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors;
};

EigenPairs smallest_pairs(ShiftInvert& op, int count, const EigenSolverOptions& options) {
    const int krylov = std::min(int(op.rows()), std::max(2 * count, count + 20));
    Spectra::SymEigsShiftSolver<ShiftInvert> solver(op, count, krylov, options.shift);
    solver.init();
    const int converged = int(solver.compute(Spectra::SortRule::LargestMagn, 1000, options.tolerance,
                                             Spectra::SortRule::SmallestAlge));
    if (solver.info() != Spectra::CompInfo::Successful || converged < count)
        throw ConvergenceError(
            "only " + std::to_string(converged) + " of " + std::to_string(count) +
            " eigenpairs converged; lower eigen.count, or check the mesh for degenerate triangles");
    return {solver.eigenvalues(), solver.eigenvectors()};
}

/// Whether a gap separates the first k eigenvalues from the next, so that no eigenspace is cut there.
bool gap_follows(const Eigen::VectorXd& ascending, int k) {
    return k >= int(ascending.size()) || ascending[k] - ascending[k - 1] > 1e-6 * ascending[k];
}

/// Number of leading eigenvalues, at most `wanted`, after which a gap follows.
int complete_eigenspaces(const Eigen::VectorXd& ascending, int wanted) {
    int count = std::min<int>(wanted, int(ascending.size()));
    while (count > 2 && !gap_follows(ascending, count)) --count;
    return count;
}

/// Number of eigenvalues below a bound: negative pivots of L - bound M (Sylvester's law of inertia).
int eigenvalues_below(double bound, const Eigen::SparseMatrix<double>& L, const Eigen::VectorXd& mass) {
    Eigen::SparseMatrix<double> shifted = L;
    shifted.diagonal() -= bound * mass;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(shifted);
    return factors.info() == Eigen::Success ? int((factors.vectorD().array() < 0).count()) : 0;
}

/// The smallest of two sets of pairs.
EigenPairs merged(const EigenPairs& a, const EigenPairs& b, Eigen::Index count) {
    Eigen::VectorXd values(a.values.size() + b.values.size());
    values << a.values, b.values;
    std::vector<int> order = all_indices(values.size());
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return values[i] < values[j]; });
    order.resize(count);
    Eigen::MatrixXd vectors(a.vectors.rows(), values.size());
    vectors << a.vectors, b.vectors;
    return {values(order), vectors(Eigen::all, order)};
}

/// A Krylov space holds one vector of each eigenspace; the others come in through rounding, late, so that the
/// solver can pass over some of a multiple eigenvalue. What a count shows to be missing is looked for in the
/// complement of what is known.
void add_missed_pairs(ShiftInvert& op, const Eigen::SparseMatrix<double>& L, const Eigen::VectorXd& mass,
                      const EigenSolverOptions& options, EigenPairs& pairs) {
    constexpr int most_rounds = 20;
    for (int round = 0; round < most_rounds; ++round) {
        const int found = complete_eigenspaces(pairs.values, int(pairs.values.size()) - 1);
        const double bound = (pairs.values[found - 1] + pairs.values[found]) / 2;
        const int missed = eigenvalues_below(bound, L, mass) - found;
        if (missed <= 0) return;
        op.deflate(pairs.vectors);
        const int possible = int(op.rows() - pairs.values.size());
        const EigenPairs others = smallest_pairs(op, std::min(missed, possible), options);
        if (others.values[0] > bound) return;
        pairs = merged(pairs, others, pairs.values.size());
    }
}

/// Measured as energies, in which a stiff needle counts as it does in the functions. The norm of M^-1 has it
/// count by its stiffness over its mass: it refused functions that were right to 11 digits.
Eigen::VectorXd relative_residuals(const Eigen::SparseMatrix<double>& L, const Eigen::VectorXd& mass,
                                   const ShiftInvert& op, const Basis& basis) {
    const double smallest = basis.eigenvalues[1];
    Eigen::VectorXd residuals = Eigen::VectorXd::Zero(basis.eigenvalues.size());
    for (int k = 1; k < residuals.size(); ++k) {  // the first is known exactly
        const Eigen::VectorXd phi = basis.functions.col(k);
        const Eigen::VectorXd r = L * phi - basis.eigenvalues[k] * mass.cwiseProduct(phi);
        const double energy = std::max(0., r.dot(op.solve(r)));
        residuals[k] = std::sqrt(energy / std::max(basis.eigenvalues[k], smallest));
    }
    return residuals;
}

}  // namespace

Basis compute_eigenbasis(const Domain& domain, const EigenSolverOptions& options) {
    const int n = domain.mesh.vertex_count();
    // One pair more than wanted tells whether the last eigenspace is complete.
    const int computed = std::min(options.count + 1, n - 1);
    if (computed < 3)
        throw InputError(domain.is_surface() ? "a surface of " + std::to_string(n) +
                                                   " vertices has too few eigenfunctions; refine the mesh"
                                             : std::to_string(n) + " points have too few eigenfunctions");
    const Eigen::SparseMatrix<double> L = laplacian(domain);
    ShiftInvert op(L, domain.mass);
    EigenPairs pairs = smallest_pairs(op, computed, options);
    add_missed_pairs(op, L, domain.mass, options, pairs);

    const int count = complete_eigenspaces(pairs.values, std::min(options.count, computed));
    Basis basis;
    basis.eigenvalues = pairs.values.head(count);
    basis.functions = domain.mass.cwiseSqrt().cwiseInverse().asDiagonal() * pairs.vectors.leftCols(count);
    // The kernel of L is known exactly for a connected surface.
    basis.eigenvalues[0] = 0;
    basis.functions.col(0).setConstant(1 / std::sqrt(domain.mass.sum()));
    if (!(basis.eigenvalues[1] > 0))
        throw ConvergenceError("the second eigenvalue is not positive; is the surface connected?");
    basis.residuals = relative_residuals(L, domain.mass, op, basis);
    if (!(basis.residuals.maxCoeff() <= options.maximum_residual))
        throw ConvergenceError(
            fmt::format("an eigenpair has residual {:.1e}; check the mesh for degenerate triangles",
                        basis.residuals.maxCoeff()));
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

double coarsest_time(const Basis& basis) {
    return std::log(10.0) / basis.eigenvalues[1];
}

template <class Archive>
void serialize(Archive& archive, Basis& basis) {
    archive(basis.eigenvalues, basis.functions, basis.residuals);
}
std::string encode(const Basis& basis) {
    return cereal_encode(basis);
}
void decode(const std::string& payload, Basis& basis) {
    cereal_decode(payload, basis);
    require_complete(basis);
}

}  // namespace varimap
