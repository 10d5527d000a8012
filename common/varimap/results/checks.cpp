#include "varimap/results/checks.h"

#include <algorithm>
#include <cmath>

namespace varimap {

namespace {

/// Row or column sums: none negative.
bool are_transported(const Eigen::VectorXd& sums) {
    return sums.allFinite() && sums.minCoeff() >= 0 && sums.sum() > 0;
}

bool is_finite(const TraceRow& row) {
    return std::isfinite(row.entries) && std::isfinite(row.gamma) && std::isfinite(row.energy) &&
           std::isfinite(row.marginal_error);
}

bool is_pair(const std::pair<SurfacePoint, SurfacePoint>& points) {
    return points.first.face >= 0 && points.second.face >= 0 && are_points({points.first, points.second});
}

std::string inconsistency(const SamplePlan& plan, Eigen::Index vertices_A, Eigen::Index vertices_B) {
    const auto a = Eigen::Index(plan.samples_A.size()), b = Eigen::Index(plan.samples_B.size());
    if (plan.entries.rows() != a || plan.entries.cols() != b) return "numbers of samples";
    if (!are_distinct_in_range(plan.samples_A, vertices_A)) return "samples";
    if (!are_distinct_in_range(plan.samples_B, vertices_B)) return "samples";
    if (plan.mass_A.size() != a || plan.mass_B.size() != b) return "masses";
    if (!are_masses(plan.mass_A) || !are_masses(plan.mass_B)) return "masses";
    if (plan.transported_A.size() != a || plan.transported_B.size() != b) return "transported masses";
    if (!are_transported(plan.transported_A) || !are_transported(plan.transported_B))
        return "transported masses";
    if (!(plan.area_bound >= 1 && std::isfinite(plan.area_bound))) return "area bound";
    if (!are_plan_entries(plan.entries)) return "entries";
    return {};
}

std::string inconsistency(const Trace& trace) {
    if (trace.empty()) return "trace";
    int level = 0;
    for (const TraceRow& row : trace) {
        if (row.level < level || row.iteration < 0 || !is_finite(row)) return "trace";
        level = row.level;
    }
    return {};
}

std::string inconsistency(const PairRecord& record, Eigen::Index vertices_A, Eigen::Index vertices_B) {
    for (const auto& [a, b] : record.landmarks)
        if (!are_in_range({a.index}, vertices_A) || !are_in_range({b.index}, vertices_B)) return "landmarks";
    const std::size_t count = record.landmarks.size();
    if (!record.landmark_points.empty() && record.landmark_points.size() != count) return "landmarks";
    if (!std::all_of(record.landmark_points.begin(), record.landmark_points.end(), is_pair))
        return "landmarks";
    if (!(record.landmark_weight > 0 && record.landmark_weight <= 1)) return "landmark weight";
    if (!record.landmark_checks.empty() && record.landmark_checks.size() != count) return "landmark checks";
    if (record.candidate < 0 || std::size_t(record.candidate) > record.candidates.size()) return "candidates";
    return {};
}

}  // namespace

bool are_plan_entries(const SparseMatrix& entries) {
    return entries.nonZeros() > 0 && entries.coeffs().isFinite().all() && entries.coeffs().minCoeff() >= 0 &&
           entries.coeffs().maxCoeff() > 0;
}

std::string inconsistency(const SolvedPair& pair, Eigen::Index vertices_A, Eigen::Index vertices_B) {
    for (const std::string& what :
         {inconsistency(pair.plan, vertices_A, vertices_B), inconsistency(pair.trace),
          inconsistency(pair.record, vertices_A, vertices_B)})
        if (!what.empty()) return what;
    return {};
}

}  // namespace varimap
