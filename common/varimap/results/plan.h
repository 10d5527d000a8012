#pragma once

#include <string>

#include "varimap/artifact/artifact.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/results/solved_pair.h"

namespace varimap {

/// The plan with every vertex as a sample (unless it was stopped early): the artifact of varimap-refine.
struct Plan : SolvedPair {
    Points centre_A;  ///< per VERTEX of A's mesh: centre of its image, in R^3 near B's mesh
    Points centre_B;  ///< per VERTEX of B's mesh: the same near A's mesh
};

template <>
struct ArtifactType<Plan> {
    static constexpr const char* kind = "plan";
    static constexpr const char* stage = "varimap-refine";
    static constexpr int schema = 13;
};
std::string encode(const Plan& plan);
/// Throws ArtifactError unless sizes fit each other, indices are in range, and numbers are finite.
void decode(const std::string& payload, Plan& plan);

}  // namespace varimap
