#pragma once

#include <array>
#include <vector>

#include "varimap/core/linear_algebra.h"

namespace varimap {

/// How a level measures neighbourhoods.
enum class LevelKind : int {
    diffusion = 0,  ///< W of Eq. 7 at one diffusion time
    euclidean = 1,  ///< W = exp(-d^2 / 2 sigma^2) (Eq. 11), d along the surface
};

/// One level of a surface's hierarchy (Sec. 4.2, 4.5).
struct Level {
    LevelKind kind = LevelKind::diffusion;
    double scale =
        0;  ///< diffusion time t (1/units of eigenvalue), or sigma (units of sqrt(area)); 0: per sample
    bool full = false;         ///< every vertex is a sample
    std::vector<int> samples;  ///< vertices of the surface's mesh
    std::vector<int> cell;     ///< per vertex of the mesh: index of its nearest sample
    Eigen::VectorXd mass;      ///< per sample: mass of its cell; sums to 1
    SparseMatrix weights;      ///< row k: W_k(x_i) over the samples i of its neighbourhood; W_k(x_k) = 1
};

/// Per sample: index of its cell on a coarser level.
std::vector<int> parents(const Level& fine, const Level& coarse);

/// The level's samples, then those of the given vertices that are none of them.
std::vector<int> samples_with(const Level& level, const std::vector<int>& vertices);

/// Mass-weighted means of values per vertex (rows) over the cells of a level: one row per sample.
RowMatrix cell_means(const Level& level, const Eigen::VectorXd& vertex_mass, const RowMatrix& values);

}  // namespace varimap
