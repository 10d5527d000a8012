#pragma once

#include <optional>
#include <string>

#include "stages/diffuse/params.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/results/candidates.h"
#include "varimap/stage/stage_main.h"

namespace varimap {

/// Files of what the map may begin from; empty where there is none.
struct StartFiles {
    std::string candidates;   ///< of varimap-explore
    std::string initial_map;  ///< of another program (map_file.h)
    std::string placed;       ///< of varimap-locate
};

/// Throws UsageError for files that exclude each other, and for parameters that change nothing with these:
/// they would hide that something else was meant.
void require_effect(const DiffuseParams& params, const StartFiles& files);

/// None where `path` is empty. Throws ArtifactError where the maps were found on sketches of other surfaces.
std::optional<Candidates> read_candidates(Stage& stage, const PairInputs& inputs, const std::string& path,
                                          const Surface& A, const Surface& B);

/// A map of another program, read against the meshes' files, whose vertices and faces it names; or else where
/// varimap-locate placed a part, whichever surface that is; none without either file. Throws InputError.
std::optional<Correspondences> read_initial_map(Stage& stage, const StartFiles& files, IndexBase base,
                                                const Surface& A, const Surface& B);

}  // namespace varimap
