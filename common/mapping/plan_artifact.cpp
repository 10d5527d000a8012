#include "common/artifact/cereal_eigen.h"
#include "common/mapping/plan.h"

namespace varimap {

template <class Archive>
void serialize(Archive& archive, TraceRow& row) {
    archive(row.level, row.euclidean, row.iteration, row.samples_A, row.samples_B, row.sinkhorn_iterations,
            row.entries, row.gamma, row.energy, row.marginal_error);
}

template <class Archive>
void serialize(Archive& archive, Plan& plan) {
    archive(plan.samples_A, plan.samples_B, plan.mass_A, plan.mass_B, plan.transported_A, plan.transported_B,
            plan.area_bound, plan.plan, plan.position_A, plan.position_B, plan.landmarks, plan.trace);
}

namespace {

void require(bool consistent, const char* what) {
    if (!consistent)
        throw ArtifactError(std::string("a plan artifact has inconsistent ") + what + "; rerun " +
                            ArtifactType<Plan>::stage);
}

bool all_in_range(const std::vector<int>& indices, Eigen::Index count) {
    for (const int index : indices)
        if (index < 0 || index >= count) return false;
    return true;
}

void require_consistent(const Plan& plan) {
    const auto a = Eigen::Index(plan.samples_A.size()), b = Eigen::Index(plan.samples_B.size());
    require(plan.plan.rows() == a && plan.plan.cols() == b, "numbers of samples");
    require(plan.mass_A.size() == a && plan.mass_B.size() == b, "masses");
    require(plan.transported_A.size() == a && plan.transported_B.size() == b, "transported masses");
    require(all_in_range(plan.samples_A, plan.position_A.rows()), "samples");
    require(all_in_range(plan.samples_B, plan.position_B.rows()), "samples");
    for (const auto& [first, second] : plan.landmarks)
        require(
            all_in_range({first}, plan.position_A.rows()) && all_in_range({second}, plan.position_B.rows()),
            "landmarks");
}

}  // namespace

std::string encode(const Plan& plan) {
    return cereal_encode(plan);
}

void decode(const std::string& payload, Plan& plan) {
    cereal_decode(payload, plan);
    require_consistent(plan);
}

}  // namespace varimap
