#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "stages/explore/params.h"
#include "stages/explore/pool.h"
#include "varimap/results/candidates.h"

namespace varimap {

/// Maps of a surface onto itself that are not the identity, by their energies: turns, exchanged limbs. Two
/// maps of a pair of surfaces that are nearly as good as each other differ by these. `surface` is the context
/// of the surface with itself. Sketches are enough (varimap-coarsen to a thousand vertices).
Candidates find_self_maps(const PairContext& surface, const ExploreParams& params);

/// What they are looked for with.
ExplorationOptions self_map_options(const ExploreParams& params);

struct SelfMaps {
    Candidates A, B;  ///< of each surface onto itself
};
SelfMaps find_self_maps_of_both(const PairContext& pair, const ExploreParams& params);

/// The self-maps of an artifact, as images of the surface's vertices.
std::vector<VertexImages> images_of(const Candidates& self_maps, const Surface& surface);

/// Adds the compositions of the first `count` maps with self-maps, but not those close to one that is there.
void compose(std::vector<PooledMap>& pool, int count, const std::vector<VertexImages>& self_maps_A,
             const std::vector<VertexImages>& self_maps_B, const PairContext& context);

/// Self-maps of both surfaces of a pair, asked for once, where they are needed. Keeps references to the
/// context and to `ask`, which may be empty: then there are none.
class LazySelfMaps {
  public:
    LazySelfMaps(const PairContext& context, const std::function<SelfMaps()>& ask)
        : context_(context), ask_(ask) {}
    bool exist() const { return bool(ask_); }

    /// Adds what the first `count` maps become with them (compose).
    void add_compositions(std::vector<PooledMap>& pool, int count);

  private:
    struct Images {
        std::vector<VertexImages> A, B;
    };
    const PairContext& context_;
    const std::function<SelfMaps()>& ask_;
    std::optional<Images> images_;
};

}  // namespace varimap
