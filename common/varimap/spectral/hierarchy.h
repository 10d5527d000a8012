#pragma once

#include <string>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/spectral/eigenbasis.h"
#include "varimap/spectral/level_builder.h"
#include "varimap/spectral/local_shape.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// What all pairs of a domain share: its levels, and what its places look like.
struct Hierarchy {
    HierarchyOptions options;   ///< what it was built with
    std::vector<Level> levels;  ///< coarse to fine; samples are nested. Diffusion levels, then Euclidean
                                ///< ones, of which the last has every vertex
    LocalShape shape;           ///< per vertex

    int diffusion_levels() const;
    int sampled_euclidean_levels() const;  ///< those before the last, which has every vertex; one or more
    const Level& last_diffusion_level() const { return levels[size_t(diffusion_levels()) - 1]; }
};

template <>
struct ArtifactType<Hierarchy> {
    static constexpr const char* kind = "hierarchy";
    static constexpr const char* stage = "varimap-hierarchy";
    static constexpr int schema = 3;
};
std::string encode(const Hierarchy& hierarchy);
void decode(const std::string& payload, Hierarchy& hierarchy);

/// A few vertices far from each other, `count` at most: the first samples of a level with as many, which are
/// the same on all levels.
std::vector<int> spread_vertices(const Hierarchy& hierarchy, std::size_t count);

/// Builds all levels of a domain (Sec. 4.2 and 4.5) and describes its local shape. Near-linear in the number
/// of vertices.
Hierarchy build_hierarchy(const Domain& domain, const Basis& basis, const HierarchyOptions& options);

}  // namespace varimap
