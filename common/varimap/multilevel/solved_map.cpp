#include "varimap/multilevel/solved_map.h"

#include "varimap/multilevel/sparse_plan.h"
#include "varimap/results/read_out.h"

namespace varimap {

MapPair solved_map(const Solution& solution, const LevelPair& level, const PairContext& context,
                   double area_bound) {
    Plan plan;
    plan.plan = to_sample_plan(level, solution.plan, area_bound);
    plan.centre_A = solution.step.centres.row.leftCols<3>();
    plan.centre_B = solution.step.centres.column.leftCols<3>();
    plan.record.landmarks = context.landmarks();
    plan.record.landmark_weight = context.landmark_weight();
    return read_out(plan, context.A().surface, context.B().surface);
}

}  // namespace varimap
