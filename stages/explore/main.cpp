#include <optional>

#include "stages/explore/explore.h"
#include "stages/explore/inputs.h"
#include "stages/explore/report.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

int main(int argc, char** argv) {
    ExploreParams params;
    Stage stage("explore", "Maps worth continuing, found without landmarks");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    PairInputs inputs(stage, "sketch.");
    const std::string& out =
        stage.output(ArtifactType<Candidates>::kind, ArtifactType<Candidates>::schema, "candidates to write");
    const auto& landmark_files =
        stage.input_list_option("landmarks", "as for varimap-diffuse; may be too few to decide", 1, 2);
    const auto& self_map_files =
        stage.input_list_option("self-maps",
                                "self-maps of A and of B, found with --onto_itself true: maps that are not "
                                "beyond doubt are composed with them (default: they are looked for then, "
                                "except with landmarks)",
                                2, 2);
    const auto& surface_files = stage.input_list_option(
        "surfaces",
        "what was sketched: surface, basis and hierarchy of A, then of B; where the choice is not sure, maps "
        "that may be right are solved for and compared on these, too",
        6, 6);
    return stage.main(argc, argv, [&] {
        SurfaceData A = inputs.read_A(stage), B = inputs.read_B(stage);
        require_surface(A.surface);
        require_surface(B.surface);
        if (params.self_maps && !inputs.are_same())
            throw UsageError(
                "--onto_itself looks for maps of one surface: give it twice, with the same basis and "
                "hierarchy");
        const SelfMapsOnDemand given = given_self_maps(stage, inputs, self_map_files, A.surface, B.surface);
        std::optional<SketchedSurfaces> surfaces;
        if (!surface_files.empty()) surfaces = record_surfaces(stage, surface_files, inputs);
        const auto landmarks =
            read_landmarks(stage, landmark_files, A.surface, B.surface, params.landmark_reading);
        const PairContext context =
            sketch_context(std::move(A), std::move(B), landmarks, params.landmark_weight);
        OnDemand ask;
        if (given.of_A)
            ask.self_maps = given;
        else if (landmark_files.empty())
            ask.self_maps = find_when_asked(context, params);
        if (surfaces)
            ask.surfaces = [&] {
                return pair_context(surfaces->A.read(), surfaces->B.read(), landmarks,
                                    params.landmark_weight);
            };
        Candidates found = params.self_maps ? find_self_maps(context, params) : explore(context, params, ask);
        if (params.self_maps)
            report_self_maps(found.list);
        else if (landmarks_decide(found))
            log("varimap-diffuse follows the landmarks");
        else
            report(found, !landmark_files.empty(), context);
        found.sketched_A = inputs.sketched("A");
        found.sketched_B = inputs.sketched("B");
        stage.record_number("candidates", double(found.list.size()));
        stage.write(out, found);
    });
}
