#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "varimap/quality/quality.h"
#include "varimap/relaxation/area_bound.h"
#include "varimap/untangling/fault_repair.h"
#include "varimap/untangling/round_relaxation.h"
#include "varimap/untangling/untangling_options.h"

namespace varimap {

/// Of a map that is left as it is.
UntanglingReport untouched(const Distortion& before);

/// One direction of a map while it is untangled. Keeps references. `back`: the other direction.
class UntangledDirection {
  public:
    /// `points`: landmarks that are points. `reliefs`: of the source and the target, none where relief counts
    /// for nothing.
    UntangledDirection(PointMap& map, const TriangleMesh& source, const TriangleMesh& target,
                       const VertexData<bool>& pinned, const PointPairs& points,
                       const UntanglingOptions& options, std::vector<ReliefPair> reliefs);

    bool are_sheets() const { return are_sheets_; }
    bool has_relief() const { return relief_ != nullptr; }
    double relief_correlation() const { return relief_->correlation(); }
    void trust_relief(double share);

    /// A round begins with `start_relaxation`, takes relaxation steps, and ends with `end_relaxation`.
    void start_relaxation(const Round& round);
    bool is_relaxed() const { return !relaxation_ || relaxation_->done(); }
    void relax(const PointMap& back);
    void end_relaxation(const Round& round);
    /// The last round begins with `start_settling` instead, and takes steps of `settle`.
    void start_settling();
    bool is_settled() const;
    void settle(const PointMap& back);
    void end_settling();

    void replace_parts(const PointMap& back);
    bool is_much_worse_than(const UntangledDirection& other) const;
    void reconcile(const PointMap& back, bool whole);

    void repair(const PointMap& back);
    /// Steps of `relax` that follow repairs: what these have changed, and what gave way to it, settles.
    void start_settling_again();
    void end_settling_again();
    /// Where `move` makes new faults, what it moved there is put back (fault_guard.h).
    void guard(const std::function<void()>& move);
    bool is_repaired_again() const { return repair_->is_done_again(); }
    void repair_again(const PointMap& back) { repair_->again(back); }
    void recover(const PointMap& back) { repair_->recover(back); }
    bool may_adopt(const UntangledDirection& other) const { return repair_->may_adopt(*other.repair_); }
    bool has_mirrored_parts() const { return report_.mirrored_parts > 0; }
    /// `upright`: whether the other direction has no mirrored parts, so that those of this one need not stay.
    void adopt(const PointMap& back, bool upright);
    /// Brings areas back into the bound where repairs have taken them out of it.
    void restore_bound();

    const PointMap& points() const { return sliding_.points(); }
    UntanglingReport finish();

  private:
    /// Than it was in the beginning.
    bool is_worse(const Distortion& after) const;
    UntanglingReport left_as_it_was() const;
    /// Of the mapped faces, per area.
    double energy() const;
    std::unique_ptr<RoundRelaxation> relaxation(const Round& round, int steps);
    void keep_bound();
    int most_settling_steps() const;
    void sweep(const Round& round);
    void sweep(std::vector<int> vertices, const Round& round, int sweeps);
    std::vector<int> free_among(std::vector<int> vertices) const;
    /// Vertices whose surroundings cannot keep the area bound: those of landmarks.
    VertexData<bool> exempt() const;
    /// And the corners of faces that hold landmarks which are points.
    VertexData<bool> with_landmarks(VertexData<bool> marks) const;

    PointMap& map_;
    const TriangleMesh &source_, &target_;
    const VertexData<bool>& pinned_;
    const UntanglingOptions& options_;
    Distortion before_;
    SlidingMap sliding_;
    const std::vector<SoftConstraint> landmarks_;  ///< that are points
    const bool are_sheets_;                        ///< both surfaces; asked for global steps alone
    VertexData<bool> fixed_;
    std::optional<BoundaryAgreement> boundaries_;  ///< once there are global steps
    std::unique_ptr<ReliefAgreement> relief_;
    std::unique_ptr<RoundRelaxation> relaxation_;
    std::unique_ptr<AreaBound> bound_;
    std::vector<int> pressed_;  ///< where the bound was not kept at the last step
    int settling_steps_ = 0;
    std::unique_ptr<PartReplacement> replacement_;
    std::optional<FaultRepair> repair_;  ///< once the map has settled
    UntanglingReport report_;
};

}  // namespace varimap
