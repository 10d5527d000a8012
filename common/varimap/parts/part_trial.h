#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "varimap/parts/strained_parts.h"
#include "varimap/relaxation/global_relaxation.h"
#include "varimap/relaxation/soft_constraints.h"
#include "varimap/sliding/target_cells.h"

namespace varimap {

/// By what the alternatives for a part are judged.
struct TrialRules {
    double robustness = 3;  ///< of the energy by which maps are compared; lower ones think little of spikes
    double gain = 0.15;     ///< share of the energy that an alternative must save
    /// Whether it suffices that an alternative is far less strained and enters the same cells of the target
    /// (a limb turned about its axis): where both directions are twisted alike, what is right for one is not
    /// the other's inverse.
    bool untwist = true;
};

/// A part of the source that is to be mapped anew.
struct OpenPart {
    VertexData<bool> open;   ///< placed anew: all faces of the vertex, one at least, belong to the part
    VertexData<bool> held;   ///< stay while the part is relaxed: all but those and the ring around them
    std::vector<int> faces;  ///< those that move, ascending
    double area = 0;

    /// inside: its faces; fixed[v]: landmarks, which are held.
    OpenPart(const SlidingMap& map, const FaceData<bool>& inside, const VertexData<bool>& fixed);
};

/// What trials of all parts of a map share.
struct TrialContext {
    SlidingMap& map;
    const VertexData<bool>& fixed;
    const TargetCells& cells;
    std::vector<SoftConstraint> constraints;  ///< by which alternatives are judged
    std::vector<SoftConstraint> landmarks;    ///< those of them that hold while a part is relaxed
    TrialRules rules;
    int vertices;  ///< of the source, that faces use
};

/// Proposes new images for the open vertices in the map, to be relaxed and judged.
using Proposal = std::function<void(const VertexData<bool>& open)>;

/// One part under trial. Keeps references.
class PartTrial {
  public:
    PartTrial(const TrialContext& context, const OpenPart& part) : context_(context), part_(part) {}

    /// Relaxes the part as it is: what alternatives have to beat. To be called first, and followed by `run`,
    /// which undoes it unless it succeeds.
    void set_standard();
    /// Maps the part as proposed; true if that was kept.
    bool run(const Proposal& propose);
    /// Of the proposals so far, the least energy / the energy to beat.
    double nearest() const { return nearest_; }

  private:
    void relax();
    void remove_folds();
    double strain() const;
    double energy() const;
    bool untwists();
    bool enters_the_same() const;
    double tolerated_loss() const;
    bool covers_as_much() const;
    void restore();

    const TrialContext& context_;
    const OpenPart& part_;
    PointMap before_;
    std::vector<SoftConstraint> constraints_;  ///< of the part's faces
    std::unique_ptr<GlobalRelaxation> global_;
    double strain_before_ = 0, energy_to_beat_ = 0, nearest_ = std::numeric_limits<double>::infinity();
    std::vector<char> occupied_before_;  ///< cells of the target
};

}  // namespace varimap
