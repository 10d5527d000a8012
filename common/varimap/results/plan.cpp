#include "varimap/results/plan.h"

#include "varimap/results/checks.h"
#include "varimap/results/serialization.h"

namespace varimap {

template <class Archive>
void serialize(Archive& archive, Plan& plan) {
    serialize(archive, static_cast<SolvedPair&>(plan));
    archive(plan.centre_A, plan.centre_B);
}

std::string encode(const Plan& plan) {
    return cereal_encode(plan);
}

void decode(const std::string& payload, Plan& plan) {
    cereal_decode(payload, plan);
    require_consistent<Plan>(plan, plan.centre_A.rows(), plan.centre_B.rows());
    require<Plan>(plan.centre_A.allFinite() && plan.centre_B.allFinite(), "centres");
}

}  // namespace varimap
