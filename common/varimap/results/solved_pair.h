#pragma once

#include "varimap/results/pair_record.h"
#include "varimap/results/sample_plan.h"
#include "varimap/results/trace.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// What varimap-diffuse and varimap-refine both hand on, whatever images they add to it.
struct SolvedPair {
    SamplePlan plan;
    Trace trace;  ///< of all levels so far
    PairRecord record;
};

/// Landmarks as points of the INPUT meshes. Those at vertices that no input vertex became are left out.
PointPairs landmarks_on_inputs(const PairRecord& record, const Surface& A, const Surface& B);

/// Throws ArtifactError if the pair names vertices or faces that these surfaces lack.
void require_surfaces(const SolvedPair& pair, const Surface& A, const Surface& B);

}  // namespace varimap
