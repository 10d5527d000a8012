#pragma once

#include <functional>
#include <vector>

#include "varimap/mesh/geodesic_graph.h"
#include "varimap/relaxation/sliding_map.h"
#include "varimap/relaxation/soft_constraints.h"
#include "varimap/relaxation/target_cells.h"

namespace varimap {

/// Which parts of a map are suspected, and how the alternatives are judged.
struct PartReplacementOptions {
    double excess = 0.25;   ///< mean excess energy (fold_energy.h) around a face of a strained part, at least
    double contrast = 3;    ///< times the median over all faces that it is at least
    double area = 2e-4;     ///< share of the source's area of the smallest part that is tried
    double robustness = 3;  ///< of the energy by which maps are compared; lower ones think little of spikes
    /// Of an alternative's being inverse to the other direction (soft_constraints.h), beside its energy: what
    /// leaves a part of the target uncovered may be nearer to an isometry. A tenth of it, where parts are
    /// continued from their surroundings, since the other direction may be wrong there too.
    double inverse_weight = 1000;
    double gain = 0.15;      ///< share of the energy that an alternative must save
    int most_parts = 16;     ///< per round
    int rounds = 3;          ///< a new map of a limb may leave a finger to be done
    double most_visits = 4;  ///< of all vertices in the mean, by trials: bounds the time
};

struct PartReplacementReport {
    int tried = 0, replaced = 0;
    double area_percent = 0;  ///< share of the source's area in replaced parts
};

/// Undoes what relaxation cannot: mirrored, twisted and crumpled parts (Sec. 4.4). A relaxed map is strained
/// where such a part meets its surroundings. Each strained part, widened by some of its surroundings and by
/// what it cuts off, is mapped anew in several ways, each relaxed; the first whose energy is lower is kept,
/// unless it leaves a part of the target (target_cells.h).
class PartReplacement {
  public:
    /// fixed[v]: landmarks, which keep their images; landmarks: those that are points. Keeps references.
    PartReplacement(SlidingMap& map, const std::vector<char>& fixed, const PartReplacementOptions& options,
                    const std::vector<SoftConstraint>& landmarks = {});

    /// Maps parts as an isometry would continue the map of their surroundings (continuation.h), at the scale
    /// at which a limb's end meets the limb's end, and at the source's own. `back`: the other direction, or
    /// empty.
    void continue_surroundings(const PointMap& back);
    /// Maps parts by the inverse of a map from the target to the source; `whole`: tries all of it first.
    void adopt_inverse(const PointMap& back, bool whole);

    const PartReplacementReport& report() const { return report_; }

  private:
    /// Proposes new images for the open vertices in the map, to be relaxed and judged.
    using Proposal = std::function<void(const std::vector<char>& open)>;
    /// The proposals for a part, best bets first.
    using Proposals = std::function<std::vector<Proposal>(const std::vector<char>& open)>;
    void replace_parts(const Proposals& proposals);
    bool replace_part(const std::vector<int>& part, const Proposals& proposals);
    std::vector<std::vector<int>> strained_parts() const;
    double length_ratio(const std::vector<char>& open) const;
    void judge_by(const PointMap& back, double weight);

    SlidingMap& map_;
    const std::vector<char>& fixed_;
    PartReplacementOptions options_;
    Edges edges_;
    GeodesicGraph source_graph_, target_graph_;
    TargetCells cells_;
    const std::vector<SoftConstraint> landmarks_;
    std::vector<SoftConstraint> constraints_;  ///< also the landmarks: by which alternatives are judged
    std::vector<char> rejected_;               ///< faces of parts for which nothing better was found
    double visits_ = 0;                        ///< vertices in trials so far
    PartReplacementReport report_;
};

}  // namespace varimap
