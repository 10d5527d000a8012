#include "common/mapping/pair_inputs.h"
#include "common/mapping/vertex_list.h"
#include "common/stage/stage_main.h"
#include "stages/diffuse/diffuse.h"

using namespace varimap;

int main(int argc, char** argv) {
    DiffuseParams params;
    Stage stage("diffuse", "Transport plan through the diffusion levels (Alg. 1 and 5)");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    PairInputs inputs(stage);
    const std::string& out = stage.output(ArtifactType<Plan>::kind, ArtifactType<Plan>::schema, "plan to write");
    const auto& landmark_files = stage.list_option(
        "landmarks", "one file of vertex pairs, or a source list and a target list; numbers of INPUT vertices", 1, 2);
    return stage.main(argc, argv, [&] {
        SurfaceData A = inputs.read_A(stage), B = inputs.read_B(stage);
        const auto landmarks = landmark_files.empty() ? std::vector<std::pair<int, int>>{}
                                                      : read_landmarks(landmark_files, A.surface.input, B.surface.input);
        for (size_t i = 0; i < landmark_files.size(); ++i)
            stage.record_file(landmark_files.size() == 1 ? "landmarks" : i == 0 ? "landmarks.A" : "landmarks.B", landmark_files[i]);
        const auto on_meshes = to_mesh_vertices(landmarks, A.surface, B.surface);
        const PairContext context(std::move(A), std::move(B), on_meshes);
        const Plan plan = diffuse(context, params);
        stage.record_number("levels", plan.trace.back().level + 1);
        stage.record_number("alternations", double(plan.trace.size()));
        stage.write(out, plan);
    });
}
