#pragma once

#include <string>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/results/candidate.h"
#include "varimap/results/correspondences.h"

namespace varimap {

/// A vertex of A by whose image a choice among maps is told: a landmark there decides it.
struct TellingVertex {
    int source = -1;          ///< of A's file; -1: none
    std::vector<int> images;  ///< by the first maps, the nearest vertices of B's file
};

/// Maps found without landmarks, the best first: the artifact of varimap-explore. Of a surface onto itself:
/// its self-maps, without the identity.
struct Candidates {
    std::string sketched_A, sketched_B;  ///< payload hashes of the surfaces on whose sketches they were found
    std::vector<Candidate> list;         ///< may be empty for self-maps
    std::vector<Correspondences> maps;
    /// For a picture of the first three, where the choice among them is not sure: per vertex of B's file, its
    /// image on faces of A's. Else none.
    std::vector<PointMap> previews;
    /// With an image for each of the previews, if there are several.
    TellingVertex telling;
};

/// Whether landmarks are followed: nothing else was looked for, or nothing better found. The list is empty,
/// or holds the map alone that they lead to.
bool landmarks_decide(const Candidates& found);

template <>
struct ArtifactType<Candidates> {
    static constexpr const char* kind = "candidates";
    static constexpr const char* stage = "varimap-explore";
    static constexpr int schema = 10;
};
std::string encode(const Candidates& candidates);
/// Throws ArtifactError unless sizes fit each other, numbers are finite, and points are points.
void decode(const std::string& payload, Candidates& candidates);

/// Throws ArtifactError unless all points lie on faces of these inputs.
void require_surfaces(const Candidates& candidates, const TriangleMesh& input_A, const TriangleMesh& input_B);

/// Throws ArtifactError if a preview does not lead from the vertices of `target` to faces of `source`, or if
/// one of these meshes lacks the vertex that tells, or its images.
void require_previews(const Candidates& candidates, const TriangleMesh& source, const TriangleMesh& target);

}  // namespace varimap
