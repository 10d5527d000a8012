#pragma once

#include <span>
#include <vector>

#include "stages/explore/finishing.h"
#include "stages/explore/pool.h"

namespace varimap {

/// A finished map and what is known of it.
struct Appraised {
    FinishedMap map;
    Candidate candidate;
};

/// What maps are put in order by: the score, with a preference for the map that landmarks lead to, which is
/// given up only for what is clearly better, and for what was found over what it becomes turned about an
/// axis.
double ranking_score(const Candidate& candidate);

/// The best first by ranking_score, mirrored ones last, and what each is to the best. Not for an empty list.
std::vector<Appraised> ordered(std::vector<Appraised> list, const PairContext& context);

/// What is known of the maps, without them.
std::vector<Candidate> ratings(const std::vector<Appraised>& list);

/// The finished maps of a pool that grows. Keeps references to the context and to the appraisal.
class FinishedPool {
  public:
    FinishedPool(const PairContext& context, FinishingOptions options, const Appraisal& appraisal)
        : context_(context), options_(std::move(options)), appraisal_(appraisal) {}

    /// Finishes these maps, and keeps those that do not become what is there already.
    void add(std::span<const PooledMap> maps);
    /// The same of those that have joined a pool since the last time, which is to be the same pool.
    void add_new_of(const std::vector<PooledMap>& pool);

    /// All that are kept, in order.
    std::vector<Appraised> appraised() const;

  private:
    const PairContext& context_;
    FinishingOptions options_;
    const Appraisal& appraisal_;
    std::size_t seen_of_pool_ = 0;    ///< by add_new_of
    std::vector<Candidate> origins_;  ///< of all maps so far
    std::vector<FinishedMap> maps_;
    std::vector<Candidate> measured_;  ///< what is known of each of maps_ by itself
};

}  // namespace varimap
