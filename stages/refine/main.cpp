#include "stages/refine/refine.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

int main(int argc, char** argv) {
    RefineParams params;
    Stage stage("refine", "Transport plan through the Euclidean levels, down to every vertex (Sec. 4.5)");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    PairInputs inputs(stage);
    const std::string& diffusion_in = stage.input("diffusion", "artifact of varimap-diffuse");
    const std::string& out =
        stage.output(ArtifactType<Plan>::kind, ArtifactType<Plan>::schema, "artifact to write");
    return stage.main(argc, argv, [&] {
        SurfaceData A = inputs.read_A(stage), B = inputs.read_B(stage);
        const auto diffusion = stage.read<Diffusion>("diffusion", diffusion_in);
        inputs.require_same(diffusion.header, diffusion_in);
        require_surfaces(diffusion.value, A.surface, B.surface);
        const PairRecord& record = diffusion.value.record;
        const PairContext context = pair_context(std::move(A), std::move(B), record.landmarks,
                                                 record.landmark_points, record.landmark_weight);
        const Plan plan = refine(context, diffusion.value, params);
        stage.record_number("levels", plan.trace.back().level - diffusion.value.trace.back().level);
        stage.record_number("alternations", double(plan.trace.size() - diffusion.value.trace.size()));
        stage.write(out, plan);
    });
}
