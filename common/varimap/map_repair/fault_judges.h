#pragma once

#include "varimap/map_repair/normal_agreement.h"
#include "varimap/sliding/along_target.h"

namespace varimap {

/// What tells the faults of a map. Keeps in mind what it has seen of images that stay where they are, so that
/// who looks after another shares it with that one. Keeps a reference.
struct FaultJudges {
    AlongTarget along_target;
    NormalAgreement agreement;

    explicit FaultJudges(SlidingMap& map) : along_target(map), agreement(map, along_target) {}
};

}  // namespace varimap
