#include "varimap/results/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "varimap/results/checks.h"
#include "varimap/results/serialization.h"

namespace varimap {

namespace {

bool is_finite(const Candidate& c) {
    for (const double number : {c.energy, c.dirichlet, c.relief, c.alignment, c.stretch, c.score,
                                c.reversed_mass, c.moved_mass, c.mirror_gain, c.turn})
        if (!std::isfinite(number)) return false;
    return c.explored >= 0 && c.landmarks_missed >= 0 && c.self_map_A >= 0 && c.self_map_B >= 0;
}

PointMap column(const PointPairs& pairs, bool second) {
    PointMap points;
    for (const auto& [a, b] : pairs) points.push_back(second ? b : a);
    return points;
}

bool are_on(const PointMap& points, int faces) {
    return are_points(points, faces) &&
           std::all_of(points.begin(), points.end(), [](const SurfacePoint& p) { return p.face >= 0; });
}

bool are_correspondences(const Correspondences& map, int faces_A, int faces_B) {
    return !map.from_A.empty() && !map.from_B.empty() && are_on(column(map.from_A, false), faces_A) &&
           are_on(column(map.from_A, true), faces_B) && are_on(column(map.from_B, false), faces_B) &&
           are_on(column(map.from_B, true), faces_A);
}

}  // namespace

template <class Archive>
void serialize(Archive& archive, Correspondences& c) {
    archive(c.from_A, c.from_B);
}

template <class Archive>
void serialize(Archive& archive, TellingVertex& t) {
    archive(t.source, t.images);
}

template <class Archive>
void serialize(Archive& archive, Candidates& c) {
    archive(c.sketched_A, c.sketched_B, c.list, c.maps, c.previews, c.telling);
}

bool landmarks_decide(const Candidates& found) {
    return found.list.empty() || (found.list.size() == 1 && found.list.front().explored == 0);
}

std::string encode(const Candidates& candidates) {
    return cereal_encode(candidates);
}

void decode(const std::string& payload, Candidates& candidates) {
    cereal_decode(payload, candidates);
    constexpr int any = std::numeric_limits<int>::max();  // the meshes' sizes are not known here
    require<Candidates>(candidates.list.size() == candidates.maps.size(), "numbers of maps");
    require<Candidates>(std::all_of(candidates.list.begin(), candidates.list.end(), is_finite), "numbers");
    for (const Correspondences& map : candidates.maps)
        require<Candidates>(are_correspondences(map, any, any), "maps");
    require<Candidates>(candidates.previews.size() <= candidates.list.size(), "previews");
    for (const PointMap& preview : candidates.previews) require<Candidates>(are_points(preview), "previews");
    const TellingVertex& told = candidates.telling;
    require<Candidates>(
        (told.source < 0 && told.images.empty()) ||
            (told.source >= 0 && told.images.size() == candidates.previews.size() &&
             std::all_of(told.images.begin(), told.images.end(), [](int v) { return v >= 0; })),
        "the vertex that tells");
}

void require_surfaces(const Candidates& candidates, const TriangleMesh& input_A,
                      const TriangleMesh& input_B) {
    for (const Correspondences& map : candidates.maps)
        if (!are_correspondences(map, input_A.face_count(), input_B.face_count()))
            throw ArtifactError("the candidates are not maps between these surfaces; rerun varimap-explore");
}

void require_previews(const Candidates& candidates, const TriangleMesh& source, const TriangleMesh& target) {
    const TellingVertex& told = candidates.telling;
    const bool fit =
        std::ranges::all_of(candidates.previews,
                            [&](const PointMap& map) { return is_map_between(map, target, source); }) &&
        told.source < source.vertex_count() &&
        std::ranges::all_of(told.images, [&](int v) { return v < target.vertex_count(); });
    if (!fit) throw ArtifactError("the candidates are not maps between these meshes; rerun varimap-explore");
}

}  // namespace varimap
