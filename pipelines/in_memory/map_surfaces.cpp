#include "varimap/map_surfaces.h"

#include <optional>

#include "stages/coarsen/coarsen.h"
#include "stages/diffuse/diffuse.h"
#include "stages/explore/explore.h"
#include "stages/explore/params.h"
#include "stages/preprocess/preprocess.h"
#include "stages/refine/refine.h"
#include "stages/relax/relax.h"
#include "varimap/pair_stage/pair_inputs.h"

namespace varimap {

namespace {

/// The stages of one surface.
SurfaceData surface_data(const TriangleMesh& input, const char* name, const MapOptions& options,
                         bool mirror) {
    PreprocessParams params;
    params.mirror = mirror;
    SurfaceData data;
    data.surface = preprocess(prepared(input, params, name), params);
    if (!options.full_resolution) data.surface = coarsened(std::move(data.surface), CoarsenParams{});
    data.basis = compute_eigenbasis(data.surface, EigenSolverOptions{});
    data.hierarchy = build_hierarchy(data.surface, data.basis, HierarchyOptions{});
    return data;
}

/// The surface as coarse as exploration wants it.
SurfaceData sketch(const Surface& surface) {
    CoarsenParams params;
    params.vertices = 1000;
    params.most_lost = 1;
    SurfaceData data;
    data.surface = coarsened(surface, params);
    data.basis = compute_eigenbasis(data.surface, EigenSolverOptions{});
    data.hierarchy = build_hierarchy(data.surface, data.basis, HierarchyOptions{});
    return data;
}

/// `given`: landmarks on the inputs.
std::optional<Candidates> found_candidates(const Surface& A, const Surface& B, const Landmarks& given,
                                           const MapOptions& options) {
    if (!options.initial_map.empty()) return {};
    ExploreParams params;
    params.only_if_needed = !options.explore;
    SurfaceData sketch_A = sketch(A), sketch_B = sketch(B);
    const auto landmarks = to_mesh_vertices(given.vertices, sketch_A.surface, sketch_B.surface);
    const PointPairs points = landmark_points(given, sketch_A.surface, sketch_B.surface);
    const PairContext context =
        pair_context(std::move(sketch_A), std::move(sketch_B), landmarks, points, options.landmark_weight);
    if (!options.landmarks.empty()) return explore(context, params);
    return explore(context, params, [&] { return find_self_maps_of_both(context, params); });
}

/// The stages that solve for a plan.
Plan solve(const PairContext& context, const PointPairs& landmark_points,
           const std::optional<Candidates>& candidates, const std::optional<Correspondences>& initial_map,
           const MapOptions& options) {
    DiffuseParams coarse;
    coarse.candidate = options.candidate;
    coarse.landmark_weight = options.landmark_weight;
    RefineParams fine;
    coarse.alternation.area_bound = fine.alternation.area_bound = options.area_bound;
    Diffusion diffusion = diffuse(context, coarse, candidates, initial_map);
    diffusion.record.landmark_points = landmark_points;
    return refine(context, diffusion, fine);
}

DirectionQuality measure(const PointMap& map, const Surface& from, const Surface& onto) {
    const TriangleMesh source = without_added_faces(from);
    const TriangleMesh& target = onto.input;
    return {measure_distortion(map, source, target), measure_coverage(map, source, target).share};
}

/// Fills in the quality, measured where both surfaces have the same handedness.
void measure(MappedSurfaces& mapped, const Surface& A, const Surface& B) {
    const PointMap onto_B = from_file(mapped.A_to_B, A, B), onto_A = from_file(mapped.B_to_A, B, A);
    mapped.A_to_B_quality = measure(onto_B, A, B);
    mapped.B_to_A_quality = measure(onto_A, B, A);
    mapped.round_trip = measure_round_trip(onto_B, onto_A, A.input, B.input);
}

}  // namespace

MappedSurfaces map_surfaces(const TriangleMesh& A, const TriangleMesh& B, const MapOptions& options) {
    SurfaceData data_A = surface_data(A, "A", options, options.mirror),
                data_B = surface_data(B, "B", options, false);
    const auto given = on_inputs({options.landmarks, {}}, data_A.surface, data_B.surface);
    const auto landmarks = to_mesh_vertices(given.vertices, data_A.surface, data_B.surface);
    const PointPairs points = landmark_points(given, data_A.surface, data_B.surface);
    const Surface surface_A = data_A.surface, surface_B = data_B.surface;
    const PairContext context =
        pair_context(std::move(data_A), std::move(data_B), landmarks, points, options.landmark_weight);
    std::optional<Correspondences> initial_map;
    if (!options.initial_map.empty())
        initial_map = correspondences_of(options.initial_map, surface_A, surface_B);
    const Plan plan =
        solve(context, points, found_candidates(surface_A, surface_B, given, options), initial_map, options);
    SurfaceMap map =
        relax(surface_A, surface_B, plan.record, read_out(plan, surface_A, surface_B), plan.plan.area_bound);
    MappedSurfaces mapped;
    mapped.A_to_B = std::move(map.A_to_B);
    mapped.B_to_A = std::move(map.B_to_A);
    measure(mapped, surface_A, surface_B);
    return mapped;
}

}  // namespace varimap
