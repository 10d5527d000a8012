#pragma once

#include <string>
#include <vector>

#include "stages/explore/self_maps.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/stage/stage_main.h"

namespace varimap {

/// Throws InputError for what is no surface: maps are judged by how they carry faces.
void require_surface(const Surface& surface);

/// Self-maps of A and of B, read from `files` at once; none where there are no files. Throws ArtifactError
/// where they are not those of the surfaces of `inputs`.
SelfMapsOnDemand given_self_maps(Stage& stage, const PairInputs& inputs,
                                 const std::vector<std::string>& files, const Surface& A, const Surface& B);

/// A surface that was sketched, with its basis and hierarchy.
struct SketchedSurface {
    RecordedInput surface, basis, hierarchy;

    /// Refuses them (ArtifactError) where they do not belong together.
    void require_lineage() const;
    SurfaceData read() const;
};

struct SketchedSurfaces {
    SketchedSurface A, B;
};

/// `files`: surface, basis and hierarchy of A, then of B. Refuses (ArtifactError) surfaces of which those
/// read are no sketches.
SketchedSurfaces record_surfaces(Stage& stage, const std::vector<std::string>& files,
                                 const PairInputs& sketches);

}  // namespace varimap
