#pragma once

#include <string>
#include <vector>

#include "stages/cycles/choice.h"
#include "varimap/results/candidates.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The surfaces and pairs of a batch and what exploration found for them. The manifest is JSON of
/// {"surfaces": {NAME: sketch}, "pairs": [{"name", "source", "target", "candidates"}]}.
struct Collection {
    std::vector<std::string> surfaces, names;  ///< of surfaces and of pairs
    Samples samples;                           ///< the vertices of the sketches
    std::vector<PairOfMaps> pairs;
    std::vector<std::string> sketches;  ///< files, of the surfaces

    /// Throws InputError, ArtifactError and IoError.
    static Collection read(const std::string& manifest);
};

/// A map of samples, which are the vertices of the surfaces' meshes, as one of the vertices of the source's
/// file: each goes where the nearest sample goes.
PointMap on_files(const SampledMap& map, const Surface& source, const Surface& target);

/// Per candidate, how probable it is that it is the right map, as far as its pair alone tells; 0 for mirrored
/// ones. kind[k]: the first candidate that is hardly another one than k (choice.h); a kind is as probable as
/// its best one would be alone.
std::vector<double> probabilities(const std::vector<Candidate>& candidates,
                                  const std::vector<std::size_t>& kind);

}  // namespace varimap
