#include <unistd.h>

#include <filesystem>
#include <optional>

#include "fixtures/map_shapes.h"
#include "fixtures/mesh_vertex.h"
#include "fixtures/shapes.h"
#include "fuzz/forgery.h"
#include "fuzz/scratch_file.h"
#include "fuzz/target.h"
#include "stages/coarsen/coarsen.h"
#include "stages/diffuse/diffuse.h"
#include "stages/explore/explore.h"
#include "stages/inspect/inspect.h"
#include "stages/preprocess/preprocess.h"
#include "stages/refine/refine.h"
#include "stages/relax/relax.h"
#include "stages/remesh/quality_json.h"
#include "stages/remesh/remesh.h"
#include "stages/remesh/warnings.h"
#include "stages/render/render.h"
#include "varimap/core/error.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/results/quality_numbers.h"
#include "varimap/spectral/spectral_check.h"

// An input is the name of an artifact, a line break, and a forged payload. The stage gets it in the place of
// the good one, as its main() would: decoded, and checked against what is read beside it. Headers are good:
// who forges contents can forge these.
namespace varimap::fuzz {
namespace {

/// All that the stages make of a small pair.
struct Artifacts {
    SurfaceData A, B;
    Candidates candidates;
    Diffusion diffusion;
    Plan plan;
    SurfaceMap map;
    QualityNumbers quality;
};

SurfaceData surface_data(const TriangleMesh& mesh) {
    PreprocessParams params;
    params.target_edge_length = .45;
    SurfaceData data;
    data.surface = preprocess(mesh, params);
    EigenSolverOptions options;
    options.count = 16;
    data.basis = compute_eigenbasis(data.surface, options);
    data.hierarchy = build_hierarchy(data.surface, data.basis, {});
    return data;
}

ExploreParams explore_params() {
    ExploreParams params;
    params.exploration.random_starts = 2;
    return params;
}

Candidates explored(const PairContext& context) {
    return explore(context, explore_params());
}

RenderParams render_params() {
    RenderParams params;
    params.width = 64;
    params.samples = 1;
    return params;
}

/// Previews stand in the artifact where the choice is not sure.
std::vector<PointMap> previews(const Surface& A, const Surface& B) {
    const ClosestPoint closest(A.input);
    PointMap map;
    for (int v = 0; v < B.input.vertex_count(); ++v) map.push_back(closest(B.input.vertex(v)).point);
    return {map, map};
}

Artifacts made() {
    Artifacts all;
    TriangleMesh pear = shapes::ellipsoid(1, {1, 1.2, 1.6});
    pear.vertices.row(3) *= 1.6;
    all.A = surface_data(pear);
    pear.vertices.row(20) *= 1.3;
    all.B = surface_data(shapes::shuffled(pear, 1));
    const VertexPairs<MeshVertex> landmarks{{{3}, shapes::mesh_vertex_at(all.B.surface, {7})}};
    const PairContext context(all.A, all.B, landmarks);
    all.candidates = explored(context);
    all.candidates.previews = previews(all.A.surface, all.B.surface);
    all.diffusion = diffuse(context, {}, all.candidates);
    all.plan = refine(context, all.diffusion, {});
    all.map = relax(all.A.surface, all.B.surface, all.plan.record,
                    read_out(all.plan, all.A.surface, all.B.surface), all.plan.plan.area_bound);
    all.quality.json = quality_json(measure_quality(all.map, all.A.surface, all.B.surface, all.plan), all.map,
                                    all.A.surface, all.B.surface, all.plan);
    return all;
}

const Artifacts& good() {
    static const Artifacts all = made();
    return all;
}

/// Calls `act` with the artifact of that name.
template <class All, class Act>
void with_artifact(All& all, const std::string& name, const Act& act) {
    if (name == "A.surface") return act(all.A.surface);
    if (name == "A.basis") return act(all.A.basis);
    if (name == "A.hierarchy") return act(all.A.hierarchy);
    if (name == "B.surface") return act(all.B.surface);
    if (name == "B.basis") return act(all.B.basis);
    if (name == "B.hierarchy") return act(all.B.hierarchy);
    if (name == "candidates") return act(all.candidates);
    if (name == "diffusion") return act(all.diffusion);
    if (name == "plan") return act(all.plan);
    if (name == "map") return act(all.map);
    throw UsageError("no artifact is called that");
}

using Names = std::vector<std::string>;

std::string forged(const Names& names, std::uint64_t number) {
    Forger forger(number);
    Artifacts all = good();
    const std::string& name = names[forger.below(names.size())];
    std::string bytes = name + "\n";
    with_artifact(all, name, [&](auto& value) {
        forger(value);
        bytes += encode(value);
    });
    return bytes;
}

/// What a stage reads: one artifact of `bytes`, else good ones. `name` tells which.
Artifacts read(const std::string& bytes, std::string& name) {
    Artifacts all = good();
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    name = bytes.substr(0, end);
    with_artifact(all, name, [&](auto& value) {
        value = {};
        decode(bytes.substr(std::min(end + 1, bytes.size())), value);
    });
    return all;
}

/// To half of the vertices, so that most of them can go.
void run_coarsen(const Artifacts& all, const std::string&) {
    const Surface& fine = all.A.surface;
    const Surface coarse = coarsened(fine, {fine.mesh.vertex_count() / 2});
    Surface copy;
    decode(encode(coarse), copy);  // checks it, as the stages that read it would
}

void run_eigen(const Artifacts& all, const std::string&) {
    EigenSolverOptions options;
    options.count = 16;
    encode(compute_eigenbasis(all.A.surface, options));
}

void run_hierarchy(const Artifacts& all, const std::string&) {
    require_fit(all.A.basis, all.A.surface);
    encode(build_hierarchy(all.A.surface, all.A.basis, {}));
}

void require_fit(const Artifacts& all) {
    varimap::require_fit(all.A);
    varimap::require_fit(all.B);
}

void run_explore(const Artifacts& all, const std::string&) {
    require_fit(all);
    require_surfaces(all.candidates, all.A.surface.input, all.A.surface.input);
    OnDemand ask;
    ask.self_maps = {[&] { return all.candidates; }, [] { return Candidates(); }};
    ask.surfaces = [&] { return PairContext(all.A, all.B, {}); };
    encode(explore(PairContext(all.A, all.B, {}), explore_params(), ask));
}

void run_diffuse(const Artifacts& all, const std::string&) {
    require_fit(all);
    require_surfaces(all.candidates, all.A.surface.input, all.B.surface.input);
    encode(diffuse(PairContext(all.A, all.B, good().diffusion.record.landmarks), {}, all.candidates));
}

void run_refine(const Artifacts& all, const std::string&) {
    require_fit(all);
    require_surfaces(all.diffusion, all.A.surface, all.B.surface);
    const PairRecord& record = all.diffusion.record;
    const PairContext context =
        pair_context(all.A, all.B, record.landmarks, record.landmark_points, record.landmark_weight);
    encode(refine(context, all.diffusion, {}));
}

void run_relax(const Artifacts& all, const std::string& name) {
    const Surface &A = all.A.surface, &B = all.B.surface;
    const auto relaxed = [&](const auto& start) {
        require_surfaces(start, A, B);
        encode(relax(A, B, start.record, read_out(start, A, B), start.plan.area_bound));
    };
    if (name == "diffusion") return relaxed(all.diffusion);
    relaxed(all.plan);
}

void run_remesh(const Artifacts& all, const std::string& name) {
    const Surface &A = all.A.surface, &B = all.B.surface;
    const SolvedPair& pair = name == "diffusion" ? static_cast<const SolvedPair&>(all.diffusion) : all.plan;
    require_surfaces(pair, A, B);
    require_surfaces(all.map, A, B);
    const MapQuality quality = measure_quality(all.map, A, B, pair);
    warn_of(quality, pair.record);
    QualityNumbers copy;
    decode(encode(QualityNumbers{quality_json(quality, all.map, A, B, pair)}), copy);
    const SamplePlan& plan = pair.plan;
    masses_csv(A, plan.samples_A, plan.transported_A, plan.mass_A);
    masses_csv(B, plan.samples_B, plan.transported_B, plan.mass_B);
    to_ply(cross_remesh(all.map.A_to_B, A, B));
    to_ply(cross_remesh(all.map.B_to_A, B, A));
}

void run_render(const Artifacts& all, const std::string&) {
    const TriangleMesh &A = good().A.surface.input, &B = good().B.surface.input;
    require_previews(all.candidates, A, B);
    if (!all.candidates.previews.empty())
        to_png(render_candidates(A, B, all.candidates.previews, all.candidates.telling, render_params()));
}

void run_inspect(const Artifacts& all, const std::string& name) {
    const ScratchFile file("", ".artifact");
    with_artifact(all, name, [&]<class T>(const T& value) {
        Header header;
        header.kind = ArtifactType<T>::kind;
        header.schema = ArtifactType<T>::schema;
        header.stage = ArtifactType<T>::stage;
        write_payload(file.path(), header, encode(value));
    });
    if (const auto failure = check(file.path())) throw Error(*failure);
    summarise(file.path());
    const std::string folder = file.path() + ".export";
    export_contents(file.path(), folder);
    std::filesystem::remove_all(folder);
}

Target stage(const std::string& name, const Names& artifacts,
             void (*run)(const Artifacts& all, const std::string& forged)) {
    const auto read_and_run = [run](const std::string& bytes) {
        std::string forged_one;
        const Artifacts all = read(bytes, forged_one);
        run(all, forged_one);
    };
    Target target{"stage_" + name, {}, {}, read_and_run, 64 << 20};
    target.forge = [artifacts](std::uint64_t number) { return forged(artifacts, number); };
    target.prepare = [] { good(); };
    target.longest_cpu_seconds = 60;  // exploration of this pair takes .7 s, under sanitizers 9
    return target;
}

}  // namespace

std::vector<Target> stage_targets() {
    const Names surfaces{"A.surface", "B.surface"};
    const Names sides{"A.surface", "A.basis", "A.hierarchy", "B.surface", "B.basis", "B.hierarchy"};
    const auto with = [](Names names, const Names& more) {
        names.insert(names.end(), more.begin(), more.end());
        return names;
    };
    return {stage("coarsen", {"A.surface"}, run_coarsen),
            stage("eigen", {"A.surface"}, run_eigen),
            stage("hierarchy", {"A.surface", "A.basis"}, run_hierarchy),
            stage("explore", with(sides, {"candidates"}), run_explore),
            stage("diffuse", with(sides, {"candidates", "candidates"}), run_diffuse),
            stage("refine", with(sides, {"diffusion", "diffusion"}), run_refine),
            stage("relax", with(surfaces, {"diffusion", "plan"}), run_relax),
            stage("remesh", with(surfaces, {"diffusion", "plan", "map"}), run_remesh),
            stage("render", {"candidates"}, run_render),
            stage("inspect", with(sides, {"candidates", "diffusion", "plan", "map"}), run_inspect)};
}

}  // namespace varimap::fuzz
