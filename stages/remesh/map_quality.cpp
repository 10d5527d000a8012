#include "stages/remesh/map_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "varimap/core/index_set.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/thin_faces.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_repair/holes.h"

namespace varimap {

double times_radius(const LandmarkSurroundings& around) {
    return around.radius > 0 ? around.distance / around.radius : 0;
}

namespace {

/// Whether all boundaries of a mesh are short enough for holes: behind the lid of half a head, or of a sheet,
/// which is 3 sqrt(area) around or more, what the map misses would count as reached.
bool has_holes_alone(const TriangleMesh& mesh) {
    constexpr double longest = 1;  // sqrt(area); a person's waist has .9
    const Boundary boundary = find_boundary(mesh);
    const std::vector<double> lengths = loop_lengths(mesh, boundary);
    const double limit = longest * std::sqrt(surface_area(mesh));
    return !lengths.empty() && *std::max_element(lengths.begin(), lengths.end()) < limit;
}

/// Not where components were joined by tubes, which would count as well.
std::optional<Coverage> coverage_when_closed(const PointMap& map, const Surface& source,
                                             const TriangleMesh& own_faces, const Surface& target) {
    const bool has_lids = has_added_faces(source);
    const bool has_holes = has_holes_alone(source.input);
    if (!has_lids && !has_holes) return {};
    if (connected_components(own_faces).count > 1) return {};
    RepairedMesh closed{source.input, link_to_itself(source.input), {}};
    if (has_holes) closed = holes_filled(std::move(closed), std::numeric_limits<int>::max());
    return measure_coverage(map, std::move(closed.mesh), without_added_faces(target));
}

/// Marks the corners of the target's own faces that lie on faces which a repair added.
VertexData<char> rim_of_added_faces(const Surface& target) {
    VertexData<char> own(target.input.vertex_count(), 0), added = own;
    for (int f = 0; f < target.input.face_count(); ++f)
        for (const int v : target.input.faces.row(f))
            (target.link.face[std::size_t(f)] < 0 ? added : own)[v] = 1;
    for (int v = 0; v < target.input.vertex_count(); ++v) own[v] = own[v] && added[v];
    return own;
}

/// Images on faces that a repair added were taken to the rim of these, on top of each other, and their
/// triangles folded: they are none on the target's own faces.
PointMap without_images_on_added_faces(PointMap map, const Surface& target) {
    if (!has_added_faces(target)) return map;
    const VertexData<char> on_rim = rim_of_added_faces(target);
    for (SurfacePoint& image : map) {
        if (image.face < 0) continue;
        int corners = 0, rim_corners = 0;
        for (const auto [vertex, weight] : WeightedCorners(target.input, image)) {
            ++corners;
            rim_corners += on_rim[vertex];
        }
        if (corners < 3 && rim_corners == corners) image = {};
    }
    return map;
}

/// The degree goes by all images: what encloses a point is closed.
Verification verify_own_images(const PointMap& own, const PointMap& all, const TriangleMesh& source,
                               const TriangleMesh& target) {
    Verification found = verify_map(own, source, target);
    const auto is_none = [](const SurfacePoint& image) { return image.face < 0; };
    if (!found.degree && std::ranges::count_if(own, is_none) > std::ranges::count_if(all, is_none) &&
        is_closed(source))
        found.degree = verify_map(all, source, target).degree;
    return found;
}

MeasuredDirection measure_direction(const PointMap& map, const Surface& from, const Surface& onto,
                                    double area_bound) {
    const TriangleMesh source = without_added_faces(from);
    const TriangleMesh& target = onto.input;
    const PointMap own_images = without_images_on_added_faces(map, onto);
    const FaceData<TriangleDistortion> triangles = measure_triangles(own_images, source, target);
    Twist twist = measure_twist(map, source, target);
    if (twist.vertex >= 0) twist.vertex = number_in_file(twist.vertex, from.link);
    return {measure_distortion(triangles),
            share_within_area_bound(triangles, source, area_bound),
            measure_coverage(map, source, target),
            coverage_when_closed(map, from, source, onto),
            verify_own_images(own_images, map, source, target),
            twist};
}

FinishedQuality of_both(const MeasuredDirection& there, const MeasuredDirection& back) {
    return {std::sqrt(there.distortion.dirichlet_energy * back.distortion.dirichlet_energy),
            std::min(there.reached().share, back.reached().share),
            std::max(there.twist.degrees, back.twist.degrees)};
}

/// Chairs have 5 at most; skulls have 20 left when their small handles are cut.
bool has_many_handles(const TriangleMesh& mesh) {
    constexpr int many = 10;
    return summarise_topology(mesh).genus >= many;
}

ComponentImages measure_components_in_files(const PointMap& A_to_B, const PointMap& B_to_A, const Surface& A,
                                            const Surface& B) {
    ComponentImages found =
        measure_components(A_to_B, B_to_A, without_added_faces(A), without_added_faces(B));
    for (ComponentImage& one : found.of_source) one.vertex = number_in_file(one.vertex, A.link);
    for (ComponentImage& one : found.of_target) one.vertex = number_in_file(one.vertex, B.link);
    return found;
}

LandmarkQuality measure_landmarks(const PointMap& A_to_B, const PointMap& B_to_A, const PointPairs& from_A,
                                  const TriangleMesh& A, const TriangleMesh& B) {
    if (from_A.empty()) return {};
    const PointPairs from_B = swapped(from_A);
    const std::vector<LandmarkSurroundings> there = landmark_surroundings(A_to_B, from_A, A, B),
                                            back = landmark_surroundings(B_to_A, from_B, B, A);
    LandmarkQuality found{landmark_residuals(A_to_B, from_A, A, B), there,
                          exchanged_landmarks(there, from_A, B)};
    for (std::size_t k = 0; k < there.size(); ++k)
        if (times_radius(back[k]) > times_radius(there[k])) found.surroundings[k] = back[k];
    for (const auto& pair : exchanged_landmarks(back, from_B, A)) found.exchanged.push_back(pair);
    make_set(found.exchanged);
    return found;
}

ChoiceQuality measure_choice(const PairRecord& record, const FinishedQuality& in_the_end) {
    // The finished map says nothing of the first candidate where another was continued.
    const auto of_first = record.candidate == 1 ? std::optional(in_the_end) : std::nullopt;
    return {confidence_of(record.candidates), confidence_of(record.candidates, of_first),
            doubt(record.candidates, of_first)};
}

double median_thinness(const TriangleMesh& mesh) {
    std::vector<double> heights, areas;
    for (int f = 0; f < mesh.face_count(); ++f) {
        heights.push_back(thinness(mesh, f));
        areas.push_back(face_normal(mesh, f).norm() / 2);
    }
    return weighted_quantile(heights, areas, 0.5);
}

}  // namespace

MapQuality measure_quality(const SurfaceMap& map, const Surface& A, const Surface& B, const SolvedPair& pair,
                           const PointMap& initial_map) {
    const PointMap A_to_B = from_file(map.A_to_B, A, B), B_to_A = from_file(map.B_to_A, B, A);
    const double bound = pair.plan.area_bound;
    MapQuality quality;
    quality.A_to_B = measure_direction(A_to_B, A, B, bound);
    quality.B_to_A = measure_direction(B_to_A, B, A, bound);
    quality.in_the_end = of_both(quality.A_to_B, quality.B_to_A);
    quality.components = measure_components_in_files(A_to_B, B_to_A, A, B);
    quality.in_the_end.components_astray = quality.components.are_astray();
    quality.in_the_end.inside_out = one_is_inside_out(A, B);
    quality.round_trip = measure_round_trip(A_to_B, B_to_A, A.input, B.input);
    const PointPairs landmarks = landmarks_on_inputs(pair.record, A, B);
    quality.landmarks = measure_landmarks(A_to_B, B_to_A, landmarks, A.input, B.input);
    if (!pair.record.candidates.empty()) {
        quality.in_the_end.many_handles = has_many_handles(A.input) || has_many_handles(B.input);
        quality.choice = measure_choice(pair.record, quality.in_the_end);
    }
    if (!initial_map.empty())
        quality.initial_map = measure_initial_map(from_file(initial_map, A, B), A_to_B, A.input, B.input);
    quality.median_thinness_A = median_thinness(A.input);
    quality.median_thinness_B = median_thinness(B.input);
    return quality;
}

}  // namespace varimap
