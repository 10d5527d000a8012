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

/// Those of either surface of a pair, looked for only when they are asked for; both functions may be empty.
struct SelfMapsOnDemand {
    std::function<Candidates()> of_A, of_B;
};
/// Keeps references to both.
SelfMapsOnDemand find_when_asked(const PairContext& pair, const ExploreParams& params);

/// The self-maps of an artifact, as images of the surface's vertices.
std::vector<VertexImages> images_of(const Candidates& self_maps, const Surface& surface);

/// Adds the compositions of the first `count` maps with self-maps, but not those close to one that is there.
void compose(std::vector<PooledMap>& pool, int count, const std::vector<VertexImages>& self_maps_A,
             const std::vector<VertexImages>& self_maps_B, const PairContext& context);

/// Self-maps of the surfaces of a pair, asked for once, where they are needed. Keeps references to the
/// context and to `ask`, which may be empty: then there are none.
class LazySelfMaps {
  public:
    LazySelfMaps(const PairContext& context, const SelfMapsOnDemand& ask)
        : context_(context), A_{ask.of_A}, B_{ask.of_B} {}
    bool exist() const { return A_.ask && B_.ask; }

    /// Adds what the first `count` maps become with them (compose).
    void add_compositions(std::vector<PooledMap>& pool, int count);
    /// The same with those of B alone. If a map is an isometry, those of A are those of B: what A's
    /// make of it, B's make of it, too.
    void add_compositions_with_B(std::vector<PooledMap>& pool, int count);

  private:
    struct OfOne {
        const std::function<Candidates()>& ask;
        std::optional<std::vector<VertexImages>> found = {};
        const std::vector<VertexImages>& images(const Surface& surface);
    };
    const PairContext& context_;
    OfOne A_, B_;
};

}  // namespace varimap
