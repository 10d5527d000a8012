#include "varimap/results/candidates.h"

#include <limits>

#include "varimap/results/checks.h"
#include "varimap/results/serialization.h"

namespace varimap {

template <class Archive>
void serialize(Archive& archive, Candidates& c) {
    archive(c.samples_A, c.samples_B, c.mass_A, c.mass_B, c.list, c.plans, c.previews);
}

std::string encode(const Candidates& candidates) {
    return cereal_encode(candidates);
}

void decode(const std::string& payload, Candidates& candidates) {
    cereal_decode(payload, candidates);
    constexpr Eigen::Index any = std::numeric_limits<int>::max();  // the meshes' sizes are not known here
    const auto a = Eigen::Index(candidates.samples_A.size()), b = Eigen::Index(candidates.samples_B.size());
    require<Candidates>(!candidates.list.empty() && candidates.list.size() == candidates.plans.size(),
                        "numbers of plans");
    require<Candidates>(
        are_distinct_in_range(candidates.samples_A, any) && are_distinct_in_range(candidates.samples_B, any),
        "samples");
    require<Candidates>(candidates.mass_A.size() == a && candidates.mass_B.size() == b, "masses");
    require<Candidates>(are_masses(candidates.mass_A) && are_masses(candidates.mass_B), "masses");
    for (const SparseMatrix& plan : candidates.plans)
        require<Candidates>(plan.rows() == a && plan.cols() == b && are_plan_entries(plan), "plans");
    require<Candidates>(candidates.previews.size() <= candidates.list.size(), "previews");
    for (const PointMap& preview : candidates.previews) require<Candidates>(are_points(preview), "previews");
}

void require_previews(const Candidates& candidates, const TriangleMesh& source, const TriangleMesh& target) {
    for (const PointMap& preview : candidates.previews)
        if (int(preview.size()) != target.vertex_count() || !are_points(preview, source.face_count()))
            throw ArtifactError("the candidates are not maps between these meshes; rerun varimap-explore");
}

}  // namespace varimap
