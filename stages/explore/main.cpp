#include "stages/explore/params.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

namespace {

void report(const std::vector<Candidate>& candidates) {
    for (size_t k = 0; k < candidates.size(); ++k)
        log("candidate {}: energy {:.6g} and {:.6g}, bending {:.3f}, score {:.4f}, {:.1f}% reversed; {}",
            k + 1, candidates[k].diffusion_energy, candidates[k].euclidean_energy,
            candidates[k].bending_agreement, candidates[k].score, 100 * candidates[k].reversed_mass,
            relation(candidates[k]));
    const Confidence confidence = confidence_of(candidates);
    if (is_mirrored(candidates.front()))
        warn(
            "only mirrored maps were found; are the surfaces of opposite handedness (--mirror)? look at "
            "candidates.png");
    else if (!confidence.confident)
        warn(
            "the choice among the candidates is not sure ({}): look at candidates.png, try --candidate 2, or "
            "give landmarks",
            confidence.levels_agree ? fmt::format("another is only {:.1f}% worse", 100 * confidence.margin)
                                    : "coarse and fine levels disagree");
}

}  // namespace

int main(int argc, char** argv) {
    ExploreParams params;
    Stage stage("explore", "Maps worth continuing, found without landmarks");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    PairInputs inputs(stage);
    const std::string& out =
        stage.output(ArtifactType<Candidates>::kind, ArtifactType<Candidates>::schema, "candidates to write");
    const auto& landmark_files =
        stage.input_list_option("landmarks", "as for varimap-diffuse; may be too few to decide", 1, 2);
    return stage.main(argc, argv, [&] {
        SurfaceData A = inputs.read_A(stage), B = inputs.read_B(stage);
        const auto landmarks =
            read_landmarks(stage, landmark_files, A.surface, B.surface, params.landmark_space);
        const auto vertices = to_mesh_vertices(landmarks.vertices, A.surface, B.surface);
        const PointPairs points = landmark_points(landmarks, A.surface, B.surface);
        const PairContext context =
            pair_context(std::move(A), std::move(B), vertices, points, params.landmark_weight);
        const Candidates found = explore(context, params.exploration, params.alternation, params.ironing);
        report(found.list);
        stage.record_number("candidates", double(found.list.size()));
        stage.write(out, found);
    });
}
