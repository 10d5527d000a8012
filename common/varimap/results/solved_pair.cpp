#include "varimap/results/solved_pair.h"

#include <algorithm>

#include "varimap/core/error.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

bool are_below(const std::vector<int>& indices, int count) {
    return std::all_of(indices.begin(), indices.end(), [&](int i) { return i < count; });
}

}  // namespace

void require_surfaces(const SolvedPair& pair, const Surface& A, const Surface& B) {
    bool fits = are_below(pair.plan.samples_A, A.mesh.vertex_count()) &&
                are_below(pair.plan.samples_B, B.mesh.vertex_count());
    for (const auto& [a, b] : pair.record.landmarks)
        fits &= a.index < A.mesh.vertex_count() && b.index < B.mesh.vertex_count();
    for (const auto& [a, b] : pair.record.landmark_points)
        fits &= a.face < A.input.face_count() && b.face < B.input.face_count();
    if (!fits)
        throw ArtifactError("the plan names vertices or faces that the surfaces lack; rerun varimap-diffuse");
}

PointPairs landmarks_on_inputs(const PairRecord& record, const Surface& A, const Surface& B) {
    if (!record.landmark_points.empty()) return record.landmark_points;
    PointPairs pairs;
    for (const auto& [a, b] : record.landmarks) {
        const SurfacePoint &from = A.on_input[std::size_t(a.index)], &to = B.on_input[std::size_t(b.index)];
        if (vertex_of(A.input, from) >= 0 && vertex_of(B.input, to) >= 0) pairs.emplace_back(from, to);
    }
    return pairs;
}

}  // namespace varimap
