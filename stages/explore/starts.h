#pragma once

#include <random>
#include <vector>

#include "varimap/multilevel/matching.h"

namespace varimap {

/// Each row of one matrix with the nearest row of the other, and the converse.
Matching nearest_to_each_other(const RowMatrix& a, const RowMatrix& b);

/// Samples with the most alike low eigenfunctions, once for each choice of their signs: nearly all
/// near-isometries of generic surfaces are among these.
std::vector<Matching> spectral_matchings(const PairContext& context, const LevelPair& pair);

/// Samples with the most alike places and normals in space, each surface stretched along its principal axes
/// to variance one, once for each way to lay these axes onto the other surface's that is no reflection. One
/// of them is near the right map where the poses are, however much proportions differ.
std::vector<Matching> axes_matchings(const PairContext& context, const LevelPair& pair);

/// Each sample with a random one.
std::vector<Matching> random_matchings(int rows, int columns, int count, std::mt19937& random);

/// The plan between coarser samples: sums over their cells.
Coupling coarsened(const Coupling& plan, const LevelPair& fine, const Levels& coarse);

/// The plan with what it says of two rows exchanged, for every pair of its first `count` rows. Samples come
/// farthest first, so the first ones of a coarse level lie at extremities, which a wrong map exchanges.
std::vector<Coupling> with_swapped_rows(const Coupling& plan, int count);

}  // namespace varimap
