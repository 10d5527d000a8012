#pragma once

#include <string>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/results/solved_pair.h"

namespace varimap {

/// The plan of the last diffusion level: the artifact of varimap-diffuse.
struct Diffusion : SolvedPair {
    /// Per VERTEX of A's mesh: the vertex of B's mesh whose diffusion coordinates are nearest to its image.
    std::vector<int> image_vertex_A;
    std::vector<int> image_vertex_B;  ///< per VERTEX of B's mesh: the same on A's mesh
};

template <>
struct ArtifactType<Diffusion> {
    static constexpr const char* kind = "diffusion";
    static constexpr const char* stage = "varimap-diffuse";
    static constexpr int schema = 13;
};
std::string encode(const Diffusion& diffusion);
/// Throws ArtifactError unless sizes fit each other, indices are in range, and numbers are finite.
void decode(const std::string& payload, Diffusion& diffusion);

}  // namespace varimap
