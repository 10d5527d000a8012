#include "stages/explore/appraisal.h"

#include <algorithm>
#include <cmath>

#include "stages/explore/difference.h"
#include "varimap/core/rotation.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/topology.h"
#include "varimap/quality/quality.h"

namespace varimap {

namespace {

/// Landmarks all around which the map is elsewhere, in both directions.
int landmarks_missed(const MapPair& maps, const VertexPairs<MeshVertex>& landmarks, const TriangleMesh& A,
                     const TriangleMesh& B) {
    // Units of sqrt(area): farther than the surroundings of a tip lie from one that is longer.
    constexpr double elsewhere = 0.1;
    if (landmarks.empty()) return 0;
    const PointMap at_A = points_at_vertices(A), at_B = points_at_vertices(B);
    PointPairs there, back;
    for (const auto& [a, b] : landmarks) {
        there.emplace_back(at_A[std::size_t(a.index)], at_B[std::size_t(b.index)]);
        back.emplace_back(there.back().second, there.back().first);
    }
    const std::vector<LandmarkSurroundings> around_A = landmark_surroundings(maps.A_to_B, there, A, B),
                                            around_B = landmark_surroundings(maps.B_to_A, back, B, A);
    int missed = 0;
    for (std::size_t k = 0; k < there.size(); ++k)
        missed += std::min(around_A[k].distance, around_B[k].distance) > elsewhere;
    return missed;
}

}  // namespace

void set_cues(Candidate& candidate, const Cues& cues) {
    candidate.relief = cues.relief;
    candidate.alignment = cues.alignment;
    candidate.stretch = cues.stretch;
    candidate.score = score_of(candidate);
}

double rough_score(const Cues& cues) {
    Candidate candidate;
    set_cues(candidate, cues);
    return candidate.score;
}

Appraisal::Appraisal(const PairContext& context)
    : context_(context),
      handedness_(context.A().surface, context.B().surface),
      components_A_(context.A().surface),
      components_B_(context.B().surface),
      agreement_(context, handedness_, components_A_, components_B_) {}

Cues Appraisal::cues(const MapPair& maps) const {
    return {agreement_.relief(maps), agreement_.alignment(maps), agreement_.stretch(maps)};
}

void Appraisal::measure(const FinishedMap& map, const VertexPairs<MeshVertex>& landmarks,
                        Candidate& candidate) const {
    const TriangleMesh &A = context_.A().surface.mesh, &B = context_.B().surface.mesh;
    const Distortion there = measure_distortion(map.maps.A_to_B, A, B),
                     back = measure_distortion(map.maps.B_to_A, B, A);
    candidate.energy = map.energy;
    candidate.dirichlet = std::sqrt(there.dirichlet_energy * back.dirichlet_energy);
    candidate.reversed_mass = (there.flipped_area_percent + back.flipped_area_percent) / 200;
    candidate.landmarks_missed = landmarks_missed(map.maps, landmarks, A, B);
    set_cues(candidate, cues(map.maps));
}

void compare(const MapPair& best, const MapPair& other, const PairContext& context, Candidate& candidate) {
    constexpr double elsewhere = 0.1;  // units of sqrt(area); chosen by hand, not swept
    const Surface &A = context.A().surface, &B = context.B().surface;
    // Where the best map's inverse takes the other's images, linear on B's faces.
    const Points moved = pulled_back(positions(A.mesh, best.B_to_A), B.mesh, other.A_to_B);
    candidate.moved_mass = share_elsewhere(moved, A.mesh.vertices, A, elsewhere);
    candidate.turn = degrees(nearest_rotation(A.mesh.vertices, moved, A.mass));
}

}  // namespace varimap
