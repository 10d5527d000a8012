#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "varimap/map_repair/fault_judges.h"
#include "varimap/relaxation/relief_agreement.h"
#include "varimap/relaxation/soft_constraints.h"
#include "varimap/results/untangling_report.h"
#include "varimap/untangling/untangling_options.h"

namespace varimap {

/// What is left of a relaxed map's faults: what cannot be slid away (chart_repair.h), and faces that cut
/// through features (normal_agreement.h). `back`: the other direction.
class FaultRepair {
  public:
    /// Keeps references; tells `report` what was done. Vertices with fixed[v] stay.
    FaultRepair(SlidingMap& map, const VertexData<bool>& fixed, const std::vector<SoftConstraint>& landmarks,
                const ReliefAgreement* relief, const UntanglingOptions& options, UntanglingReport& report)
        : map_(map),
          fixed_(fixed),
          landmarks_(landmarks),
          relief_(relief),
          options_(options),
          report_(report) {}

    void operator()(const PointMap& back);
    FaultJudges& judges();
    /// After others have moved the map.
    void recount();
    bool is_done_again() const;
    /// Once more around the faults that are left; as it was where more come of it.
    void again(const PointMap& back);
    /// By the other direction (missed_parts.h), and repairs what comes of it; as it was where many more
    /// faults come of it.
    void recover(const PointMap& back);
    /// Faulty faces that are left, where they were counted.
    std::optional<int> faults() const { return faults_; }
    /// Whether the other direction has fewer faults, where they are counted; far fewer where there are many.
    bool may_adopt(const FaultRepair& other) const;
    /// Takes what is faulty, or leads elsewhere, from the other direction, and repairs what comes of it; as
    /// it was, and false, where no fewer faults come of it. Vertices on the boundary stay.
    bool adopt(const PointMap& back);

  private:
    struct State {
        PointMap points;
        UntanglingReport report;
        std::optional<int> faults;
    };
    State state() const;
    void restore(const State& state);
    VertexData<bool> held() const;
    /// On a large surface to look at all of it again takes longer than what is won.
    bool may_be_done_again() const;
    bool may_be_recovered() const;
    VertexData<bool> faulty_vertices();
    /// Returns how many faces disagreed with the target's normals before.
    int repair_all(const PointMap& back);
    /// `disagreeing`: faces that disagree with the target's normals, ascending; turned, too, where they still
    /// do.
    void repair(const PointMap& back, std::vector<int> disagreeing);
    void count_faults();
    void count_what_disagrees();
    SlidingMap& map_;
    const VertexData<bool>& fixed_;
    const std::vector<SoftConstraint>& landmarks_;
    const ReliefAgreement* relief_;
    const UntanglingOptions& options_;
    UntanglingReport& report_;
    std::unique_ptr<FaultJudges> judges_;
    std::optional<int> faults_;  ///< faulty faces after repair; not counted where none follows
};

}  // namespace varimap
