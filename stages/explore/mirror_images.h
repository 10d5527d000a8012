#pragma once

#include <string>
#include <vector>

#include "stages/explore/finished_pool.h"
#include "stages/explore/params.h"

namespace varimap {

/// The pair with the other orientation of B: a map that keeps orientation there mirrors, as a left hand's
/// onto a right one.
PairContext with_mirror_image(const PairContext& context);

/// Whether both are one surface, which is mirrored on one side: then the maps sought are its reflections, and
/// that it fits itself better as it is, by the identity, tells nothing.
bool is_own_mirror_image(const PairContext& context);

/// What to do where the surfaces are a left and a right one: "give --mirror", or leave it out.
std::string mirror_advice(const PairContext& context);

/// The best map between A and the mirror image of B. It says whether the surfaces are a left and a right
/// one, which no map between them as they are can; and of bodies that are their own mirror images it leads,
/// by these, to a map that may not have been found otherwise. Keeps a reference to the context.
class MirrorImages {
  public:
    /// `coarse`: of the exploration of the pair as it is. `most` of the maps found, those of least energy,
    /// are compared.
    MirrorImages(const PairContext& context, const ExplorationProgress& coarse, const ExploreParams& params,
                 const FinishingOptions& finishing, std::size_t most);

    const Candidate& best() const { return best_.candidate; }

    struct MirroredBack {
        /// The best map after, or followed by, the maps of either surface onto its own mirror image.
        std::vector<PooledMap> maps;
        /// Whether each surface fits its own mirror image far better than that of the other: then neither is
        /// a left or a right one, and that the pair fits better mirrored is a matter of poses and
        /// proportions.
        bool are_their_own = false;
    };
    MirroredBack mirrored_back() const;

  private:
    const PairContext& context_;
    ExploreParams params_;
    FinishingOptions finishing_;
    Appraised best_;
};

}  // namespace varimap
