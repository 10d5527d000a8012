#include <utility>

#include "stages/diffuse/check_landmarks.h"
#include "stages/diffuse/diffuse.h"
#include "stages/diffuse/inputs.h"
#include "varimap/pair_stage/landmark_vertices.h"
#include "varimap/pair_stage/unlike_surfaces.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

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
        const StartFiles files{candidates_in, initial_map_in, placed_in};
        require_effect(params, files);
        SurfaceData A = inputs.read_A(stage), B = inputs.read_B(stage);
        const auto candidates = read_candidates(stage, inputs, files.candidates, A.surface, B.surface);
        const auto initial_map = read_initial_map(stage, files, params.map_base, A.surface, B.surface);
        warn_of_part(A.surface, B.surface);
        warn_of_genus(A.surface, B.surface);
        warn_of_inside_out(A.surface, B.surface);
        if (initial_map && files.placed.empty())
            warn_of_bad_initial_map(initial_map->from_A, A.surface, B.surface);
        const auto landmarks =
            read_landmarks(stage, landmark_files, A.surface, B.surface, params.landmark_reading);
        const PairContext context =
            pair_context(std::move(A), std::move(B), landmarks, params.landmark_weight);
        warn_of_exchanged_columns(landmarks, context);
        Diffusion diffusion = diffuse(context, params, candidates, initial_map);
        diffusion.record.landmark_points =
            landmark_points(landmarks, context.A().surface, context.B().surface);
        report(diffusion.record.landmark_checks);
        stage.record_number("levels", diffusion.trace.back().level + 1);
        stage.record_number("alternations", double(diffusion.trace.size()));
        stage.write(out, diffusion);
    });
}
