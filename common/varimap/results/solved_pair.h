#pragma once

#include "varimap/results/pair_record.h"
#include "varimap/results/sample_plan.h"
#include "varimap/results/trace.h"

namespace varimap {

/// What varimap-diffuse and varimap-refine both hand on, whatever images they add to it.
struct SolvedPair {
    SamplePlan plan;
    Trace trace;  ///< of all levels so far
    PairRecord record;
};

}  // namespace varimap
