#pragma once

#include <optional>

#include "stages/explore/finished_pool.h"
#include "stages/explore/params.h"
#include "varimap/multilevel/exchanged_landmarks.h"

namespace varimap {

/// An exchange of landmarks by which the map that they lead to becomes far more probable.
struct BetterExchange {
    Exchange exchange;
    double score;        ///< of that map
    bool fits_mirrored;  ///< as they are, the landmarks fit mirror images of the surfaces even better
};
/// Warns of it, unless a map was found that meets the landmarks as they are, and fits about as well: of a
/// body with many legs, right landmarks may lead to a map with legs exchanged. `best`: of the maps found.
void warn_of(const BetterExchange& better, const Candidate& best, const PairContext& context);

/// What speaks against the landmarks of a pair, by the map that they lead to. Keeps references.
class LandmarkDoubts {
  public:
    LandmarkDoubts(const PairContext& context, const Appraisal& appraisal, const ExploreParams& params)
        : context_(context), appraisal_(appraisal), params_(params) {}

    /// The score of the best of the maps between mirror images of the surfaces that the landmarks lead to,
    /// where they look mirrored and it is much better than that of `led`, which they lead to as they are:
    /// probably one of the surfaces is a left and the other a right one. Infinity else.
    double score_if_mirrored(const Appraised& led) const;
    /// None where `led` is hardly strained as it is, or landmarks do not look exchanged.
    std::optional<BetterExchange> better_exchange(const Appraised& led) const;

  private:
    double score_between_mirror_images() const;

    const PairContext& context_;
    const Appraisal& appraisal_;
    const ExploreParams& params_;
};

}  // namespace varimap
