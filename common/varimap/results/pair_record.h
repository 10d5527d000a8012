#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"
#include "varimap/mesh/vertex_index.h"
#include "varimap/results/candidate.h"
#include "varimap/results/landmark_check.h"

namespace varimap {

/// What is known of a pair of surfaces beside its plan: made once, by varimap-diffuse, and passed on as it
/// is.
struct PairRecord {
    VertexPairs<MeshVertex> landmarks;  ///< of A and of B
    PointPairs landmark_points;         ///< on the INPUT meshes, where landmarks lie between vertices of the
                                        ///< surfaces' meshes, which are then the nearest ones; or empty
    double landmark_weight = 1;         ///< W of pull_landmarks (cost.h), in (0, 1]
    std::vector<LandmarkCheck> landmark_checks;  ///< per landmark, or none
    std::vector<Candidate> candidates;           ///< of varimap-explore, the best first; none with landmarks
    int candidate = 0;                           ///< which of them the map continues, from 1; 0 without any

    /// Whether landmarks are mapped exactly: the soft ones may end elsewhere.
    bool pins_landmarks() const { return landmark_weight == 1; }
};

}  // namespace varimap
