#pragma once

#include <string>
#include <vector>

#include "stages/cycles/choice.h"
#include "varimap/results/candidates.h"

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

/// One of a pair's maps as a table of the vertices of the source's file, for --initial-map.
std::string table(const Collection& collection, const PairOfMaps& pair, const SampledMap& map);

/// Per candidate, how probable it is that it is the right map, as far as its pair alone tells; 0 for mirrored
/// ones.
std::vector<double> probabilities(const std::vector<Candidate>& candidates);

}  // namespace varimap
