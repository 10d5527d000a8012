#pragma once

#include <functional>
#include <vector>

#include "varimap/map_repair/fault_judges.h"
#include "varimap/mesh/disc.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Lets a repaired map be relaxed further without new faults: faces that are reversed, along the target
/// (along_target.h) or by the normals at their corners, or that cut through a feature (normal_agreement.h);
/// branch points.
class FaultGuard {
  public:
    /// Keeps references.
    FaultGuard(SlidingMap& map, FaultJudges& judges);

    /// `move` moves vertices of `free` (ascending) and no others. Around new faults they are put back, those
    /// farther away, too, for as long as some are left; all of them if 8 rings do not suffice.
    void operator()(const std::vector<int>& free, const std::function<void()>& move);

  private:
    struct Faults {
        FaceData<unsigned char> of_face;  ///< as bits
        VertexData<bool> is_branch_point;
    };
    /// Of `faces` and their corners; none of others.
    Faults faults_of(const std::vector<int>& faces);
    /// Those of `faces` with a fault, or with a branch point at a corner, that was none before; ascending.
    std::vector<int> worse_among(const std::vector<int>& faces, const Faults& before);

    SlidingMap& map_;
    AlongTarget& along_target_;
    NormalAgreement& agreement_;
    FaceSets source_;
};

}  // namespace varimap
