#pragma once

#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/core/linear_algebra.h"
#include "varimap/mesh/geodesic_graph.h"
#include "varimap/mesh/surface.h"
#include "varimap/spectral/eigenbasis.h"

namespace varimap {

/// How a level measures neighbourhoods.
enum class LevelKind : int {
    diffusion = 0,  ///< W of Eq. 7 at one diffusion time
    euclidean = 1,  ///< W = exp(-d^2 / 2 sigma^2) (Eq. 11), d along the surface
};

/// One level of a surface's hierarchy (Sec. 4.2, 4.5).
struct Level {
    LevelKind kind = LevelKind::diffusion;
    double scale =
        0;  ///< diffusion time t (1/units of eigenvalue), or sigma (units of sqrt(area)); 0: per sample
    std::vector<int> samples;  ///< vertices of the surface's mesh
    std::vector<int> cell;     ///< per vertex of the mesh: index of its nearest sample
    Eigen::VectorXd mass;      ///< per sample: mass of its cell; sums to 1
    SparseMatrix weights;      ///< row k: W_k(x_i) over the samples i of its neighbourhood; W_k(x_k) = 1
};

struct HierarchyOptions {
    double truncation = 0.5;  ///< epsilon: weights below it are dropped (Sec. 3.2)
    double density =
        0.9;  ///< tau: a level is dense enough when every vertex has W > tau to a sample (Sec. 4.2)
    double growth = 1.05;  ///< diffusion levels end when the next one has fewer than this times the samples
    int minimum_neighbours = 10;  ///< lower bound on Euclidean neighbourhoods (Sec. 4.5)
    int full_neighbours = 30;     ///< neighbours on the first level that has every vertex
    int last_neighbours = 12;     ///< neighbours on the last level
};

struct Hierarchy {
    HierarchyOptions options;  ///< what it was built with
    std::vector<Level>
        levels;  ///< coarse to fine: diffusion levels, then Euclidean levels; samples are nested
    int diffusion_levels() const;
};

template <>
struct ArtifactType<Hierarchy> {
    static constexpr const char* kind = "hierarchy";
    static constexpr const char* stage = "varimap-hierarchy";
    static constexpr int schema = 1;
};
std::string encode(const Hierarchy& hierarchy);
void decode(const std::string& payload, Hierarchy& hierarchy);

/// Builds all levels of a surface (Sec. 4.2 and 4.5). Near-linear in the number of vertices.
Hierarchy build_hierarchy(const Surface& surface, const Basis& basis, const HierarchyOptions& options);

/// The level with further vertices as samples (landmarks must be samples at every level); cells, masses
/// and weights are those of the enlarged set. Returns the level unchanged if all are samples already.
Level with_samples(const Level& level, const std::vector<int>& vertices, const Surface& surface,
                   const Basis& basis, const GeodesicGraph& graph, const HierarchyOptions& options);

/// W of Eq. 7 among points given by their diffusion embedding (rows), truncated below epsilon.
SparseMatrix diffusion_weights(const RowMatrix& embedding, double truncation);

/// Per sample: index of its cell on a coarser level.
std::vector<int> parents(const Level& fine, const Level& coarse);

}  // namespace varimap
