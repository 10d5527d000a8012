#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/linear_algebra.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/results/solved_pair.h"

/// What decoded artifacts must hold: their hash may be right and their content wrong all the same.
namespace varimap {

/// Throws ArtifactError, naming kind and stage.
template <class T>
void require(bool consistent, const std::string& what) {
    if (!consistent)
        throw ArtifactError(std::string("a ") + ArtifactType<T>::kind + " artifact has inconsistent " + what +
                            "; rerun " + ArtifactType<T>::stage);
}

bool are_in_range(const std::vector<int>& indices, Eigen::Index count);
bool are_distinct_in_range(const std::vector<int>& indices, Eigen::Index count);
/// Positive and finite, of sum 1.
bool are_masses(const Eigen::VectorXd& mass);
/// Finite, none negative, at least one positive.
bool are_plan_entries(const SparseMatrix& entries);
/// Each nowhere (face -1), or with barycentric coordinates in [0, 1] of sum 1; `faces`: their number, if
/// known.
bool are_points(const PointMap& points, int faces = -1);

/// The first part of a solved pair that contradicts the others, or ""; `vertices`: of the surfaces' meshes.
std::string inconsistency(const SolvedPair& pair, Eigen::Index vertices_A, Eigen::Index vertices_B);
template <class T>
void require_consistent(const T& pair, Eigen::Index vertices_A, Eigen::Index vertices_B) {
    const std::string what = inconsistency(pair, vertices_A, vertices_B);
    require<T>(what.empty(), what);
}

}  // namespace varimap
