#include "varimap/artifact/cereal_eigen.h"
#include "varimap/results/plan.h"

namespace varimap {

template <class Archive>
void serialize(Archive& archive, SurfacePoint& point) {
    archive(point.face, point.barycentric);
}

template <class Archive>
void serialize(Archive& archive, TraceRow& row) {
    archive(row.level, row.euclidean, row.iteration, row.samples_A, row.samples_B, row.sinkhorn_iterations,
            row.entries, row.gamma, row.energy, row.marginal_error);
}

template <class Archive>
void serialize(Archive& archive, LandmarkCheck& check) {
    archive(check.distance, check.energy_fall);
}

template <class Archive>
void serialize(Archive& archive, Candidate& c) {
    archive(c.diffusion_energy, c.euclidean_energy, c.bending_agreement, c.score, c.reversed_mass,
            c.moved_mass, c.turn);
}

template <class Archive>
void serialize(Archive& archive, Candidates& c) {
    archive(c.samples_A, c.samples_B, c.mass_A, c.mass_B, c.list, c.plans, c.previews);
}

template <class Archive>
void serialize(Archive& archive, Plan& plan) {
    archive(plan.samples_A, plan.samples_B, plan.mass_A, plan.mass_B, plan.transported_A, plan.transported_B,
            plan.area_bound, plan.plan, plan.position_A, plan.position_B, plan.landmarks,
            plan.landmark_points, plan.landmark_weight, plan.trace, plan.landmark_checks, plan.candidates,
            plan.candidate);
}

namespace {

template <class T>
void require(bool consistent, const char* what) {
    if (!consistent)
        throw ArtifactError(std::string("a ") + ArtifactType<T>::kind + " artifact has inconsistent " + what +
                            "; rerun " + ArtifactType<T>::stage);
}

bool all_in_range(const std::vector<int>& indices, Eigen::Index count) {
    for (const int index : indices)
        if (index < 0 || index >= count) return false;
    return true;
}

void require_consistent(const Plan& plan) {
    const auto a = Eigen::Index(plan.samples_A.size()), b = Eigen::Index(plan.samples_B.size());
    require<Plan>(plan.plan.rows() == a && plan.plan.cols() == b, "numbers of samples");
    require<Plan>(plan.mass_A.size() == a && plan.mass_B.size() == b, "masses");
    require<Plan>(plan.transported_A.size() == a && plan.transported_B.size() == b, "transported masses");
    require<Plan>(all_in_range(plan.samples_A, plan.position_A.rows()), "samples");
    require<Plan>(all_in_range(plan.samples_B, plan.position_B.rows()), "samples");
    for (const auto& [first, second] : plan.landmarks)
        require<Plan>(
            all_in_range({first}, plan.position_A.rows()) && all_in_range({second}, plan.position_B.rows()),
            "landmarks");
    require<Plan>(plan.landmark_points.empty() || plan.landmark_points.size() == plan.landmarks.size(),
                  "landmarks");
    for (const auto& [first, second] : plan.landmark_points)
        require<Plan>(first.face >= 0 && second.face >= 0, "landmarks");
    require<Plan>(plan.landmark_weight > 0 && plan.landmark_weight <= 1, "landmark weight");
    require<Plan>(plan.landmark_checks.empty() || plan.landmark_checks.size() == plan.landmarks.size(),
                  "landmark checks");
    require<Plan>(plan.candidate >= 0 && plan.candidate <= int(plan.candidates.size()), "candidates");
}

void require_consistent(const Candidates& c) {
    const auto a = Eigen::Index(c.samples_A.size()), b = Eigen::Index(c.samples_B.size());
    require<Candidates>(!c.list.empty() && c.list.size() == c.plans.size(), "numbers of plans");
    require<Candidates>(c.mass_A.size() == a && c.mass_B.size() == b, "masses");
    require<Candidates>(c.previews.size() <= c.list.size(), "previews");
    for (const SparseMatrix& plan : c.plans)
        require<Candidates>(plan.rows() == a && plan.cols() == b, "numbers of samples");
}

}  // namespace

std::string encode(const Plan& plan) {
    return cereal_encode(plan);
}

void decode(const std::string& payload, Plan& plan) {
    cereal_decode(payload, plan);
    require_consistent(plan);
}

std::string encode(const Candidates& candidates) {
    return cereal_encode(candidates);
}

void decode(const std::string& payload, Candidates& candidates) {
    cereal_decode(payload, candidates);
    require_consistent(candidates);
}

}  // namespace varimap
