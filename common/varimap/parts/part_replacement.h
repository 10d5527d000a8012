#pragma once

#include <functional>
#include <vector>

#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/parts/part_trial.h"

namespace varimap {

/// Which parts are tried, how they are judged, and how long.
struct PartReplacementOptions {
    StrainLimits strain;  ///< of parts that are tried, per round
    TrialRules rules;
    /// Of an alternative's being inverse to the other direction (soft_constraints.h), beside its energy: what
    /// leaves a part of the target uncovered may be nearer to an isometry. A tenth of it, where parts are
    /// continued from their surroundings, since the other direction may be wrong there too.
    double inverse_weight = 1000;
    int rounds = 3;          ///< a new map of a limb may leave a finger to be done
    double most_visits = 4;  ///< of all vertices in the mean, by trials: bounds the time
};

/// What was done to one direction, all rounds together.
struct PartReplacementReport {
    int tried = 0, replaced = 0;  ///< parts
    double area_percent = 0;      ///< share of the source's area in replaced parts
};

/// Undoes what relaxation cannot: mirrored, twisted and crumpled parts (Sec. 4.4). A relaxed map is strained
/// where such a part meets its surroundings. Each strained part (strained_parts.h), widened by some of its
/// surroundings and by what it cuts off, is mapped anew in several ways, each relaxed; the first whose energy
/// is lower is kept (part_trial.h), unless it leaves a part of the target (target_cells.h), or the first
/// continuation that enters the same with far less strain.
class PartReplacement {
  public:
    /// fixed[v]: landmarks, which keep their images; landmarks: those that are points. Keeps references to
    /// the map and to `fixed`.
    PartReplacement(SlidingMap& map, const VertexData<bool>& fixed, const PartReplacementOptions& options,
                    const std::vector<SoftConstraint>& landmarks = {});
    PartReplacement(const PartReplacement&) = delete;

    /// Maps parts as an isometry would continue the map of their surroundings (continuation.h), at the scale
    /// at which a limb's end meets the limb's end, and at the source's own. `back`: the other direction,
    /// whose vertices without an image tell nothing.
    void continue_surroundings(const PointMap& back);
    /// Maps parts by the inverse of a map from the target to the source; `whole`: tries all of it first.
    void adopt_inverse(const PointMap& back, bool whole);

    const PartReplacementReport& report() const { return report_; }

  private:
    /// The proposals for a part, best bets first.
    using Proposals = std::function<std::vector<Proposal>(const VertexData<bool>& open)>;
    void replace_parts(const Proposals& proposals);
    bool replace_part(const std::vector<int>& part, const Proposals& proposals);
    /// 0 if the part was mapped anew; else how near to the energy to beat a proposal came (part_trial.h).
    double try_part(const OpenPart& part, const Proposals& proposals);
    void judge_by(const PointMap& back, double weight);

    SlidingMap& map_;
    PartReplacementOptions options_;
    Edges edges_;
    GeodesicGraph source_graph_, target_graph_;
    TargetCells cells_;
    TrialContext context_;
    FaceData<bool> rejected_;  ///< of parts for which nothing better was found
    double visits_ = 0;        ///< vertices in trials so far
    PartReplacementReport report_;
};

}  // namespace varimap
