#pragma once

#include <array>
#include <limits>
#include <vector>

#include "varimap/map_repair/charted_part.h"
#include "varimap/map_repair/crush_guard.h"
#include "varimap/map_repair/normal_agreement.h"
#include "varimap/map_repair/star_kernels.h"
#include "varimap/mesh/disc.h"
#include "varimap/relaxation/relief_agreement.h"
#include "varimap/sliding/along_target.h"
#include "varimap/sliding/inverse_map.h"
#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Repairs what sliding cannot: folds around branch points, where the map covers the target twice, and
/// vertices on the wrong side of a thin part. Defects are faces reversed along the target and
/// branch points (along_target.h). They are widened, ring by ring; the part takes the images that the other
/// direction, inverted, has for it, or, where it is a disc, is mapped anew in the plane (charted_part.h).
/// What comes of it is relaxed on the target and kept if there are fewer defects than before, and no limb
/// that has a partner was crushed for that (crush_guard.h). A large part that was mapped anew is then relaxed
/// as a whole (global_relaxation.h).
class ChartRepair {
  public:
    enum class Outcome { inverted, repaired, no_disc, no_simple_rim, folded, no_gain };
    struct Report {
        std::array<int, 6> outcomes{};  ///< attempts by how they ended
    };

    /// Keeps references. `back`: the other direction; empty where it is not known. `relief`, if given, counts
    /// where parts are relaxed as a whole.
    ChartRepair(SlidingMap& map, AlongTarget& along_target, NormalAgreement& agreement, const PointMap& back,
                const ReliefAgreement* relief = nullptr);

    /// Vertices with fixed[v] stay, and those on the source's boundary. Returns the faces that may have
    /// moved, ascending.
    std::vector<int> operator()(const VertexData<bool>& fixed);
    /// Moves single vertices where that suffices (star_kernels.h), for what is left or has come back since.
    /// Returns the faces that may have moved, ascending.
    std::vector<int> centre_stars(const VertexData<bool>& fixed);
    const Report& report() const { return report_; }

  private:
    /// Once they get to `limit`, the rest is left out. Of badness, faults are all but faces that cut through
    /// the target.
    double faults(const std::vector<int>& faces, double limit);
    double badness(const std::vector<int>& faces, double limit = std::numeric_limits<double>::infinity());
    /// What a repair is judged by.
    struct State {
        double badness;
        double crushed;  ///< share of the area (crush_guard.h)
    };
    /// Of faces that a repair may move.
    State state(const std::vector<int>& faces);
    bool is_better(const std::vector<int>& faces, const State& before);
    /// Of a part among these that is mapped anew, whose images were `kept`: it may be crushed where it had no
    /// partner.
    bool is_better(const std::vector<int>& faces, const State& before, const ChartedPart& part,
                   const PointMap& kept);
    /// A set of faces of the target that holds what the images of a disc's rim enclose; none if they enclose
    /// too much.
    std::vector<int> enclosed_on_target(const SubMesh& part, const std::vector<int>& rim);
    /// Defects that hang together, with the faces around them.
    std::vector<std::vector<int>> clusters_of(const std::vector<int>& defects);
    /// But for those that were tried in vain often enough.
    std::vector<std::vector<int>> promising_clusters_of(const std::vector<int>& defects);
    /// What is mapped anew for a cluster: it and so many rings around it, and what these cut off; none if
    /// that is too much.
    std::vector<int> disc_around(const std::vector<int>& cluster, int rings);
    /// `around`: the faces that may move, and those around them.
    Outcome attempt(std::vector<int> faces, const std::vector<int>& around, const VertexData<bool>& fixed);
    /// The vertices of faces of which all lie among these, but for fixed ones and those on the boundary.
    std::vector<int> free_within(const std::vector<int>& faces, const VertexData<bool>& fixed);
    /// `before`: of `around`, the faces that may move, which are to become better.
    bool adopt_inverse(const std::vector<int>& faces, const std::vector<int>& around, const State& before,
                       const VertexData<bool>& fixed);
    void polish(std::vector<int> vertices);
    /// Global steps for these vertices, unless the badness of `around` gets beyond `most`.
    void relax(const std::vector<int>& vertices, const std::vector<int>& around, double most);
    /// No vertex moves where more faces would be reversed.
    void polish_with_care(const std::vector<int>& vertices);
    VertexData<bool> all_but(const std::vector<int>& vertices) const;

    SlidingMap& map_;
    AlongTarget& along_target_;
    NormalAgreement& agreement_;
    const ReliefAgreement* relief_;
    InverseMap inverse_;
    StarKernels kernels_;
    CrushGuard guard_;
    FaceSets source_, target_;
    VertexData<bool> on_boundary_;  ///< of the source
    FaceData<int> strikes_;         ///< attempts without gain
    Report report_;
};

}  // namespace varimap
