#include <utility>

#include "stages/diffuse/diffuse.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/pair_stage/unlike_surfaces.h"
#include "varimap/results/map_file.h"
#include "varimap/stage/stage_main.h"
#include "varimap/surface/part_region.h"

using namespace varimap;

namespace {

std::optional<Candidates> read_candidates(Stage& stage, const PairInputs& inputs, const std::string& path,
                                          const Surface& A, const Surface& B) {
    if (path.empty()) return {};
    auto candidates = stage.read<Candidates>("candidates", path);
    inputs.require_sketches(candidates, path);
    require_surfaces(candidates.value, A.input, B.input);
    return std::move(candidates.value);
}

/// Options that change nothing would hide that something else was meant.
void require_effect(const DiffuseParams& params, bool has_candidates, bool has_initial_map) {
    if (params.candidate != DiffuseParams().candidate && !has_candidates)
        throw UsageError("--candidate says which of the maps of --candidates is continued: give these, too");
    if (params.map_base != DiffuseParams().map_base && !has_initial_map)
        throw UsageError("--map_base says how --initial-map counts vertices: give that, too");
}

/// Read against the meshes' files, whose vertices and faces it names.
std::optional<Correspondences> read_initial_map(Stage& stage, const std::string& path, IndexBase base,
                                                const Surface& A, const Surface& B) {
    if (path.empty()) return {};
    const TriangleMesh source = in_numbers_of_file(A.input, A.link);
    const PointMap map = read_map_file(path, base, file_of(B), &source);
    stage.record_file("initial-map", path);
    return correspondences_of(map, A, B);
}

/// Where varimap-locate placed a part, whichever surface that is.
std::optional<Correspondences> read_placed(Stage& stage, const std::string& path, const Surface& A,
                                           const Surface& B) {
    if (path.empty()) return {};
    const PartRegion region = stage.read<PartRegion>("placed", path).value;
    const Surface &part = region.part_is_source ? A : B, &whole = region.part_is_source ? B : A;
    require_places(region, file_of(part), file_of(whole));
    Correspondences pairs = correspondences_of(region.placed, part, whole);
    if (!region.part_is_source) std::swap(pairs.from_A, pairs.from_B);
    return pairs;
}

void report(const std::vector<LandmarkCheck>& checks) {
    constexpr double decides = .1;  // sqrt(area): no detail any more
    const int worst = contradicted_landmark(checks);
    for (size_t i = 0; i < checks.size(); ++i) {
        const LandmarkCheck& check = checks[i];
        log("landmark {}: the others alone would have its place {:.3f} sqrt(area) away, and the energy "
            "{:.1f}% "
            "lower{}",
            i + 1, check.distance, 100 * check.energy_fall,
            int(i) == worst            ? ""
            : check.distance < decides ? "; it agrees with them"
                                       : "; it does not contradict them, and decides what they leave open");
    }
    if (worst >= 0)
        warn("landmark {} is contradicted by the others: is it in the right place, on the right side?",
             worst + 1);
}

}  // namespace

int main(int argc, char** argv) {
    DiffuseParams params;
    Stage stage("diffuse", "Transport plan through the diffusion levels (Alg. 1 and 5)");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    PairInputs inputs(stage);
    const std::string& out =
        stage.output(ArtifactType<Diffusion>::kind, ArtifactType<Diffusion>::schema, "artifact to write");
    const auto& landmark_files = stage.input_list_option(
        "landmarks",
        "one file of vertex pairs, or a source list and a target list; numbers of INPUT vertices", 1, 2);
    const std::string& candidates_in =
        stage.input_option("candidates", "maps of varimap-explore, to continue one of them");
    const std::string& initial_map_in = stage.input_option(
        "initial-map",
        "map of another program, to refine it: for each vertex of the source one of the target (text, CSV, "
        ".npy, .npz), or a table of varimap");
    const std::string& placed_in = stage.input_option(
        "placed",
        "region of varimap-locate: begins with the part where it lies there, unless --candidates are");
    return stage.main(argc, argv, [&] {
        if (!placed_in.empty() && !initial_map_in.empty())
            throw UsageError("give --placed or --initial-map, not both");
        if (!candidates_in.empty() && !initial_map_in.empty())
            throw UsageError("give --candidates or --initial-map, not both");
        require_effect(params, !candidates_in.empty(), !initial_map_in.empty());
        SurfaceData A = inputs.read_A(stage), B = inputs.read_B(stage);
        const auto candidates = read_candidates(stage, inputs, candidates_in, A.surface, B.surface);
        const auto initial_map =
            placed_in.empty() ? read_initial_map(stage, initial_map_in, params.map_base, A.surface, B.surface)
                              : read_placed(stage, placed_in, A.surface, B.surface);
        warn_of_part(A.surface, B.surface);
        warn_of_genus(A.surface, B.surface);
        warn_of_inside_out(A.surface, B.surface);
        if (initial_map && placed_in.empty())
            warn_of_bad_initial_map(initial_map->from_A, A.surface, B.surface);
        const auto landmarks =
            read_landmarks(stage, landmark_files, A.surface, B.surface, params.landmark_reading);
        const PairContext context =
            pair_context(std::move(A), std::move(B), landmarks, params.landmark_weight);
        Diffusion diffusion = diffuse(context, params, candidates, initial_map);
        diffusion.record.landmark_points =
            landmark_points(landmarks, context.A().surface, context.B().surface);
        report(diffusion.record.landmark_checks);
        stage.record_number("levels", diffusion.trace.back().level + 1);
        stage.record_number("alternations", double(diffusion.trace.size()));
        stage.write(out, diffusion);
    });
}
