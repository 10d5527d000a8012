#pragma once

#include <vector>

#include "varimap/mesh/disc.h"
#include "varimap/relaxation/along_target.h"
#include "varimap/relaxation/area_bound.h"
#include "varimap/relaxation/normal_agreement.h"
#include "varimap/relaxation/sliding_map.h"

namespace varimap {

/// Brings a map back into the area bound (area_bound.h) where the repair of its faults (fault_repair.h) has
/// taken it out of it: what is mapped anew in charts knows nothing of the bound. Sweeps around vertices that
/// do not keep it make room for them; where a face has a fault that it did not have before (reversed, or at
/// a branch point, as seen along the target; cutting through a feature), they are taken back.
class BoundRepair {
  public:
    /// Keeps a reference to the map. `exempt`: vertices that need not keep the bound; `held`: those that
    /// stay.
    BoundRepair(SlidingMap& map, double bound, VertexData<bool> exempt, VertexData<bool> held);

    void operator()();

  private:
    /// Per face, what is wrong with it, as bits.
    using Faults = FaceData<unsigned char>;

    /// Those of these vertices and of the ones next to them that may move; ascending.
    std::vector<int> free_around(const std::vector<int>& vertices);
    void sweep(const std::vector<int>& free);
    /// Of `faces`; none of others.
    Faults faults_of(const std::vector<int>& faces);
    /// Those of `faces`, ascending, with a fault that they did not have.
    std::vector<int> worse_among(const std::vector<int>& faces, const Faults& before);

    SlidingMap& map_;
    AreaBound bound_;
    const int most_looks_;
    const VertexData<bool> held_;
    AlongTarget along_target_;
    NormalAgreement agreement_;
    FaceSets source_;
};

}  // namespace varimap
