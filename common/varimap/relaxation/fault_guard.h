#pragma once

#include <functional>
#include <vector>

#include "varimap/mesh/disc.h"
#include "varimap/relaxation/along_target.h"
#include "varimap/relaxation/normal_agreement.h"
#include "varimap/relaxation/sliding_map.h"

namespace varimap {

/// Lets a repaired map be relaxed further without new faults: faces reversed along the target, or around a
/// branch point (along_target.h), or cutting through a feature (normal_agreement.h).
class FaultGuard {
  public:
    /// Keeps a reference.
    explicit FaultGuard(SlidingMap& map);

    /// `move` moves vertices of `free` (ascending) and no others. Around faces that have a fault then which
    /// they did not have before, vertices are put back, those farther away, too, for as long as some are left
    /// (all after 8 rings).
    void operator()(const std::vector<int>& free, const std::function<void()>& move);

    /// How many faces are reversed or cut through a feature.
    int disagreeing_faces() { return int(agreement_.disagreeing_faces().size()); }
    /// The faces, and all that share a vertex with them; ascending.
    std::vector<int> widened(std::vector<int> faces) { return source_.widened(std::move(faces), 1); }

  private:
    /// Per face, what is wrong with it, as bits.
    using Faults = FaceData<unsigned char>;
    /// Of `faces`; none of others.
    Faults faults_of(const std::vector<int>& faces);
    /// Those of `faces`, ascending, with a fault that they did not have.
    std::vector<int> worse_among(const std::vector<int>& faces, const Faults& before);

    SlidingMap& map_;
    AlongTarget along_target_;
    NormalAgreement agreement_;
    FaceSets source_;
};

}  // namespace varimap
