#pragma once

#include <string>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/core/linear_algebra.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/results/candidate.h"

namespace varimap {

/// Maps found without landmarks, the best first: the artifact of varimap-explore.
struct Candidates {
    std::vector<int> samples_A, samples_B;  ///< vertices of the two meshes: a coarse diffusion level
    Eigen::VectorXd mass_A, mass_B;         ///< masses of the samples, each sums to 1
    std::vector<Candidate> list;
    std::vector<SparseMatrix> plans;  ///< per candidate: its plan, summed over the cells of that level
    /// For a picture of the first three, where the choice among them is not sure: per INPUT vertex of B, its
    /// rough image on INPUT faces of A. Else none.
    std::vector<PointMap> previews;
};

template <>
struct ArtifactType<Candidates> {
    static constexpr const char* kind = "candidates";
    static constexpr const char* stage = "varimap-explore";
    static constexpr int schema = 2;
};
std::string encode(const Candidates& candidates);
/// Throws ArtifactError unless sizes fit each other, masses and plans are masses, and previews are points.
void decode(const std::string& payload, Candidates& candidates);

/// Throws ArtifactError if a preview does not lead from the vertices of `target` to faces of `source`.
void require_previews(const Candidates& candidates, const TriangleMesh& source, const TriangleMesh& target);

}  // namespace varimap
