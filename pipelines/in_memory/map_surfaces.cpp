#include "varimap/map_surfaces.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "stages/coarsen/coarsen.h"
#include "stages/diffuse/diffuse.h"
#include "stages/explore/explore.h"
#include "stages/explore/params.h"
#include "stages/preprocess/preprocess.h"
#include "stages/refine/refine.h"
#include "stages/relax/relax.h"
#include "varimap/core/error.h"
#include "varimap/mesh/manifold.h"
#include "varimap/pair_stage/landmark_vertices.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/results/map_table.h"
#include "varimap/results/surface_map.h"
#include "varimap/stage/parameter_text.h"
#include "varimap/surface/surface.h"

namespace varimap {

namespace {

constexpr const char *name_of_A = "mesh A", *name_of_B = "mesh B";  ///< where messages name files

DiffuseParams diffuse_params(const MapOptions& options) {
    DiffuseParams params;
    params.candidate = options.candidate;
    params.landmark_weight = options.landmark_weight;
    params.alternation.area_bound = options.area_bound;
    return params;
}

/// The ranges are those of the command line.
void require_allowed_options(const MapOptions& options) {
    DiffuseParams params = diffuse_params(options);
    ParameterList list;
    params.describe(list);
    require_allowed(list);
    if (!options.initial_map.empty() && (options.explore || options.candidate != 1))
        throw UsageError("initial_map is the map to refine: explore and candidate look for another");
}

/// Landmark by landmark, the vertex on one side.
void require_landmarks(const std::vector<int>& vertices, const TriangleMesh& mesh, const char* name) {
    std::vector<char> used(std::size_t(mesh.vertex_count()), 0);
    for (const int v : mesh.faces.reshaped()) used[std::size_t(v)] = 1;
    std::map<int, std::size_t> landmark_at;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const int v = vertices[i];
        if (v < 0 || v >= mesh.vertex_count())
            throw InputError(
                fmt::format("landmarks[{}]: vertex {} is out of range: {} has {} vertices, counted from 0", i,
                            v, name, mesh.vertex_count()));
        if (!used[std::size_t(v)])
            throw InputError(fmt::format("landmarks[{}]: vertex {} of {} belongs to no face", i, v, name));
        const auto [other, is_new] = landmark_at.emplace(v, i);
        if (!is_new)
            throw InputError(fmt::format("landmarks[{}]: vertex {} of {} is already that of landmarks[{}]", i,
                                         v, name, other->second));
    }
}

void require_initial_map(const PointMap& map, const TriangleMesh& A, const TriangleMesh& B) {
    if (int(map.size()) != A.vertex_count())
        throw InputError(fmt::format("initial_map: {} points, but {} has {} vertices; give one for each",
                                     map.size(), name_of_A, A.vertex_count()));
    for (std::size_t v = 0; v < map.size(); ++v)
        require_near_surface(map[v], fmt::format("initial_map[{}]", v), B.face_count());
}

/// What readers of files and of command lines see to.
void require_inputs(const TriangleMesh& A, const TriangleMesh& B, const MapOptions& options) {
    require_allowed_options(options);
    require_corners(A, name_of_A);
    require_corners(B, name_of_B);
    std::vector<int> on_A, on_B;
    for (const auto& [a, b] : options.landmarks) on_A.push_back(a.index), on_B.push_back(b.index);
    require_landmarks(on_A, A, name_of_A);
    require_landmarks(on_B, B, name_of_B);
    if (!options.initial_map.empty()) require_initial_map(options.initial_map, A, B);
}

Surface prepared_surface(const TriangleMesh& input, const char* name, const MapOptions& options,
                         bool mirror) {
    PreprocessParams params;
    params.mirror = mirror;
    Surface surface = preprocess(prepared(input, params, name), params);
    return options.full_resolution ? surface : coarsened(std::move(surface), CoarsenParams{});
}

SurfaceData surface_data(Surface surface) {
    SurfaceData data;
    data.surface = std::move(surface);
    data.basis = compute_eigenbasis(data.surface, EigenSolverOptions{});
    data.hierarchy = build_hierarchy(data.surface, data.basis, HierarchyOptions{});
    return data;
}

/// The surface as coarse as exploration wants it.
SurfaceData sketch(const Surface& surface) {
    CoarsenParams params;
    params.vertices = 1000;
    params.most_lost = 1;
    return surface_data(coarsened(surface, params));
}

/// `surfaces`: what the map is solved for on; `given`: landmarks on the inputs.
std::optional<Candidates> found_candidates(const PairContext& surfaces, const Surface& A, const Surface& B,
                                           const Landmarks& given, const MapOptions& options) {
    if (!options.initial_map.empty()) return {};
    ExploreParams params;
    params.only_if_needed = !options.explore;
    SurfaceData sketch_A = sketch(A), sketch_B = sketch(B);
    const PairContext context =
        sketch_context(std::move(sketch_A), std::move(sketch_B), given, options.landmark_weight);
    OnDemand ask;
    ask.surfaces = [&] { return surfaces; };
    if (options.landmarks.empty()) ask.self_maps = find_when_asked(context, params);
    return explore(context, params, ask);
}

/// The stages that solve for a plan.
Plan solve(const PairContext& context, const PointPairs& landmark_points,
           const std::optional<Candidates>& candidates, const std::optional<Correspondences>& initial_map,
           const MapOptions& options) {
    RefineParams fine;
    fine.alternation.area_bound = options.area_bound;
    Diffusion diffusion = diffuse(context, diffuse_params(options), candidates, initial_map);
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
    require_inputs(A, B, options);
    const Surface surface_A = prepared_surface(A, name_of_A, options, options.mirror),
                  surface_B = prepared_surface(B, name_of_B, options, false);
    const auto given = on_inputs({options.landmarks, {}}, surface_A, surface_B);
    // Before the work on the surfaces: this refuses landmarks that cannot be met.
    const auto landmarks = to_mesh_vertices(given.vertices, surface_A, surface_B);
    const PointPairs points = landmark_points(given, surface_A, surface_B);
    std::optional<Correspondences> initial_map;
    if (!options.initial_map.empty())
        initial_map = correspondences_of(options.initial_map, surface_A, surface_B);
    SurfaceData data_A = surface_data(surface_A), data_B = surface_data(surface_B);
    const PairContext context =
        pair_context(std::move(data_A), std::move(data_B), landmarks, points, options.landmark_weight);
    const Plan plan = solve(context, points, found_candidates(context, surface_A, surface_B, given, options),
                            initial_map, options);
    SurfaceMap map =
        relax(surface_A, surface_B, plan.record, read_out(plan, surface_A, surface_B), plan.plan.area_bound);
    warn_of_mirrored_parts(map);
    MappedSurfaces mapped;
    mapped.A_to_B = std::move(map.A_to_B);
    mapped.B_to_A = std::move(map.B_to_A);
    measure(mapped, surface_A, surface_B);
    return mapped;
}

}  // namespace varimap
