#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/linear_algebra.h"

/// What decode() asks of an artifact's parts: its hash may be right and its content wrong all the same.
namespace varimap {

/// Throws ArtifactError, naming kind and stage.
template <class T>
void require(bool consistent, const std::string& what) {
    if (!consistent)
        throw ArtifactError(std::string("a ") + ArtifactType<T>::kind + " artifact has inconsistent " + what +
                            "; rerun " + ArtifactType<T>::stage);
}

/// All from `least` to below `count`.
bool are_in_range(const std::vector<int>& indices, Eigen::Index count, int least = 0);
bool are_distinct_in_range(const std::vector<int>& indices, Eigen::Index count);
/// Positive and finite, of sum 1.
bool are_masses(const Eigen::VectorXd& mass);

}  // namespace varimap
