#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <string>
#include <utility>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/core/linear_algebra.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/results/candidates.h"
#include "varimap/results/landmark_check.h"

namespace varimap {

/// One iteration of the alternating minimisation (Alg. 1).
struct TraceRow {
    int level = 0;      ///< index over diffusion and Euclidean levels together
    int euclidean = 0;  ///< 1 on Euclidean levels
    int iteration = 0;  ///< alternation within the level, from 0
    int samples_A = 0, samples_B = 0;
    int sinkhorn_iterations = 0;
    double entries = 0;         ///< instantiated entries of the plan
    double gamma = 0;           ///< entropic regularisation, units of the cost
    double energy = 0;          ///< Eq. (3) after both half-steps
    double marginal_error = 0;  ///< L1 distance of the row sums from the masses
};

/// A transport plan between samples of two surfaces, with its centres: the artifact of varimap-diffuse (last
/// diffusion level) and of varimap-refine (all vertices).
struct Plan {
    std::vector<int> samples_A, samples_B;         ///< vertices of the two surfaces' meshes
    Eigen::VectorXd mass_A, mass_B;                ///< masses of the samples, each sums to 1
    Eigen::VectorXd transported_A, transported_B;  ///< row and column sums of the plan, each sums to 1
    double area_bound = 1;  ///< B: each of them within a factor of sqrt(B) of its mass (Sec. 3.4)
    SparseMatrix plan;      ///< |A| x |B|; entries below a thousandth of their row and column are dropped
    Points position_A;      ///< per VERTEX of A's mesh: centre of its image, in R^3 near B's mesh
    Points position_B;      ///< per VERTEX of B's mesh: the same near A's mesh
    std::vector<std::pair<int, int>> landmarks;  ///< pairs of mesh vertices (A, B)
    PointPairs landmark_points;   ///< on the INPUT meshes, where landmarks were given as points; or empty
    double landmark_weight = 1;   ///< W of pull_landmarks (cost.h), in (0, 1]
    std::vector<TraceRow> trace;  ///< of all levels so far
    std::vector<LandmarkCheck> landmark_checks;  ///< per landmark, or none
    std::vector<Candidate> candidates;           ///< of varimap-explore, the best first; none with landmarks
    int candidate = 0;                           ///< which of them this plan continues, from 1; 0 without any

    /// Whether landmarks are mapped exactly: the soft ones may end elsewhere.
    bool pins_landmarks() const { return landmark_weight == 1; }
};

template <>
struct ArtifactType<Plan> {
    static constexpr const char* kind = "plan";
    static constexpr const char* stage = "varimap-diffuse or varimap-refine";
    static constexpr int schema = 5;
};
std::string encode(const Plan& plan);
void decode(const std::string& payload, Plan& plan);

/// Images on the other mesh of every vertex: closest points from the centres (remesh, Sec. 5). On a plan with
/// every vertex as a sample only faces that touch the row's support (entries of at least 5% of the row's
/// maximum) are candidates, so that a point never jumps to another limb; otherwise the closest face whose
/// normal agrees. Pinned landmarks are mapped exactly.
struct VertexMaps {
    PointMap A_to_B;  ///< per vertex of A's mesh, on faces of B's mesh
    PointMap B_to_A;
};
struct Surface;
VertexMaps read_out(const Plan& plan, const Surface& A, const Surface& B);

}  // namespace varimap
