#pragma once

#include <Eigen/Core>
#include <string>

#include "varimap/artifact/consistency.h"
#include "varimap/core/linear_algebra.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/results/solved_pair.h"

/// What decoded artifacts must hold: their hash may be right and their content wrong all the same.
namespace varimap {

/// Finite, none negative, at least one positive.
bool are_plan_entries(const SparseMatrix& entries);

/// The first part of a solved pair that contradicts the others, or ""; `vertices`: of the surfaces' meshes.
std::string inconsistency(const SolvedPair& pair, Eigen::Index vertices_A, Eigen::Index vertices_B);
template <class T>
void require_consistent(const T& pair, Eigen::Index vertices_A, Eigen::Index vertices_B) {
    const std::string what = inconsistency(pair, vertices_A, vertices_B);
    require<T>(what.empty(), what);
}

}  // namespace varimap
