#include "varimap/spectral/spectral_check.h"

#include <algorithm>
#include <cmath>

#include "varimap/artifact/consistency.h"
#include "varimap/spectral/local_shape.h"

namespace varimap {
namespace {

/// Each sample lies in its own cell.
bool own_their_cells(const std::vector<int>& samples, const std::vector<int>& cell) {
    for (std::size_t k = 0; k < samples.size(); ++k)
        if (cell[std::size_t(samples[k])] != int(k)) return false;
    return true;
}

/// W of Eq. 7 and 11: from above 0 to 1, where it is that of a sample to itself.
bool are_weights(const SparseMatrix& weights) {
    constexpr double rounding = 1e-6;
    Eigen::Index own = 0;
    for (Eigen::Index row = 0; row < weights.outerSize(); ++row)
        for (SparseMatrix::InnerIterator entry(weights, row); entry; ++entry) {
            if (!(entry.value() >= 0 && entry.value() <= 1 + rounding)) return false;
            own += entry.col() == row && entry.value() > 0;
        }
    return own == weights.rows();
}

void require_complete(const Level& level, Eigen::Index vertices) {
    const auto samples = Eigen::Index(level.samples.size());
    require<Hierarchy>(samples > 0 && are_distinct_in_range(level.samples, vertices), "samples");
    require<Hierarchy>(Eigen::Index(level.cell.size()) == vertices && are_in_range(level.cell, samples),
                       "cells");
    require<Hierarchy>(own_their_cells(level.samples, level.cell), "cells");
    require<Hierarchy>(level.mass.size() == samples && are_masses(level.mass), "masses");
    require<Hierarchy>(level.weights.rows() == samples && level.weights.cols() == samples, "weights");
    require<Hierarchy>(are_weights(level.weights), "weights");
    require<Hierarchy>(std::isfinite(level.scale) && level.scale >= 0, "scales");
    require<Hierarchy>(!level.full || (samples == vertices && level.kind == LevelKind::euclidean), "levels");
    require<Hierarchy>(level.kind == LevelKind::diffusion || level.kind == LevelKind::euclidean, "levels");
}

/// In (0, 1), as the command line has them.
bool is_share(double value) {
    return value > 0 && value < 1;
}

/// As many as the command line allows.
bool are_neighbours(int count) {
    return count > 0 && count <= 1000;
}

bool are_options(const HierarchyOptions& o) {
    return is_share(o.truncation) && is_share(o.density) && std::isfinite(o.growth) && o.growth >= 1 &&
           are_neighbours(o.minimum_neighbours) && o.sampled_share >= 0 && o.sampled_share <= 1 &&
           are_neighbours(o.last_neighbours);
}

/// Masses of cells are sums of those of their vertices.
bool are_masses_of_cells(const Level& level, const Eigen::VectorXd& vertex_mass) {
    constexpr double rounding = 1e-9;
    Eigen::VectorXd left = level.mass;
    for (std::size_t v = 0; v < level.cell.size(); ++v) left[level.cell[v]] -= vertex_mass[Eigen::Index(v)];
    return (left.array().abs() <= rounding * level.mass.array()).all();
}

bool are_within(const Eigen::Ref<const RowMatrix>& values, double bound) {
    return values.allFinite() && values.cwiseAbs().maxCoeff() <= bound;
}

/// Sum_v m_v phi_i(v)^2 = 1.
bool have_unit_norms(const Basis& basis, const Eigen::VectorXd& mass) {
    constexpr double rounding = 1e-6;
    const Eigen::VectorXd norms = basis.functions.array().square().matrix().transpose() * mass;
    return ((norms.array() - 1).abs() <= rounding).all();
}

}  // namespace

/// Nothing stands out of a surface farther than it is long, for
/// which the least eigenvalue has a bound.
constexpr double largest_bending = 1e6;

/// On unit area. A cylinder of length L has lambda_2 = (pi / L)^2, and |phi_i| is at most m_i^-1/2: what lies
/// beyond belongs to no surface, and heat kernels made of it would overflow.
constexpr double least_eigenvalue = 1e-9, largest_function = 1e12;

void require_complete(const Basis& basis) {
    const auto count = basis.functions.cols();
    require<Basis>(count >= 2 && basis.functions.rows() >= count, "functions");
    require<Basis>(basis.eigenvalues.size() == count && basis.residuals.size() == count,
                   "numbers of eigenpairs");
    require<Basis>(basis.functions.allFinite() && basis.functions.cwiseAbs().maxCoeff() < largest_function,
                   "functions");
    require<Basis>(basis.residuals.allFinite(), "residuals");
    require<Basis>(
        basis.eigenvalues.allFinite() && basis.eigenvalues[0] >= 0 && basis.eigenvalues[1] > least_eigenvalue,
        "eigenvalues");
    require<Basis>(std::is_sorted(basis.eigenvalues.begin(), basis.eigenvalues.end()), "eigenvalues");
}

void require_complete(const Hierarchy& hierarchy) {
    const std::vector<Level>& levels = hierarchy.levels;
    require<Hierarchy>(!levels.empty() && levels.front().kind == LevelKind::diffusion && levels.back().full,
                       "levels");
    require<Hierarchy>(are_options(hierarchy.options), "options");
    const auto vertices = Eigen::Index(levels.front().cell.size());
    for (std::size_t l = 0; l < levels.size(); ++l) {
        require_complete(levels[l], vertices);
        if (l == 0) continue;
        const Level& coarser = levels[l - 1];
        require<Hierarchy>(coarser.kind <= levels[l].kind && !coarser.full, "order of levels");
        require<Hierarchy>(coarser.samples.size() <= levels[l].samples.size(), "order of levels");
    }
    require<Hierarchy>(hierarchy.sampled_euclidean_levels() >= 1, "levels");
    const LocalShape& shape = hierarchy.shape;
    require<Hierarchy>(shape.descriptors.rows() == vertices && shape.bending.size() == vertices,
                       "local shape");
    // Of three descriptors, each by sqrt(3) (local_shape.h).
    const double largest = largest_descriptor / std::sqrt(3.0) * (1 + 1e-12);
    require<Hierarchy>(are_within(shape.descriptors, largest) && are_within(shape.bending, largest_bending),
                       "local shape");
}

void require_fit(const Basis& basis, const Domain& domain) {
    require<Basis>(basis.functions.rows() == domain.mesh.vertex_count(), "vertices");
    require<Basis>(have_unit_norms(basis, domain.mass), "functions");
}

void require_fit(const SurfaceData& data) {
    require_fit(data.basis, data.surface);
    const auto vertices = Eigen::Index(data.hierarchy.levels.front().cell.size());
    require<Hierarchy>(vertices == data.surface.mesh.vertex_count(), "vertices");
    for (const Level& level : data.hierarchy.levels)
        require<Hierarchy>(are_masses_of_cells(level, data.surface.mass), "masses");
}

}  // namespace varimap
