#pragma once

#include "varimap/multilevel/pair_context.h"

namespace varimap {

// Costs of data beside Eq. (3): squared distances of descriptors, one row per sample on either side.

/// Adds the Wasserstein-2 cost between positions in space to a level's costs (Sec. 2.3), in units in which
/// the surfaces' variances in space and in the level's embedding agree. For aligned surfaces.
void add_wasserstein_term(LevelPair& pair, const PairContext& context, double weight);

/// Adds the squared distances of descriptors of local shape (local_shape.h); samples have the means of their
/// cells. At weight 1 a difference of 1 costs as much as the neighbourhoods' own mean variance, both sides
/// together, at any level. Nothing is added at weight 0. The energy feels whether neighbours stay together;
/// where shapes differ in proportions it would rather slide along a body than stretch it, and only the look
/// of places can tell.
void add_shape_term(LevelPair& pair, const PairContext& context, double weight);

/// Adds the squared differences of how near places are to each landmark, exp(-d / 0.1) at a distance d along
/// the surface, in the same units, times the landmarks' own weight. A point has no capacity: on a fine level
/// one pinned sample hardly costs a map that is elsewhere all around it, so that landmarks alone lead on
/// coarse levels only. With a weight of 4 half as many of right landmarks are met by a spike, on animals of
/// other species; errors stay the same in the mean. Between surfaces.
void add_landmark_term(LevelPair& pair, const PairContext& context, double weight);

/// How much the descriptors of shape and of nearness to landmarks count beside Eq. (3).
struct DescriptorWeights {
    double shape = .25;   ///< of add_shape_term; at .5 the map of a bust onto another was lost
    double vicinity = 0;  ///< of add_landmark_term
};
/// Adds these two terms, in this order.
void add_descriptor_terms(LevelPair& pair, const PairContext& context, const DescriptorWeights& weights);

}  // namespace varimap
