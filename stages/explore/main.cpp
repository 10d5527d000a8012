#include <optional>

#include "stages/explore/explore.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

namespace {

void report(const std::vector<Candidate>& candidates, bool has_landmarks) {
    for (size_t k = 0; k < candidates.size(); ++k)
        log("candidate {} ({}): energy {:.6g}, Dirichlet energy {:.3f}, relief {:.3f}, alignment {:.3f}, "
            "stretch "
            "{:.3f}, score {:.2f}, {:.1f}% reversed; {}",
            k + 1, origin(candidates[k]), candidates[k].energy, candidates[k].dirichlet, candidates[k].relief,
            candidates[k].alignment, candidates[k].stretch, candidates[k].score,
            100 * candidates[k].reversed_mass, relation(candidates[k]));
    const Confidence confidence = confidence_of(candidates);
    log("the first is right with a probability of {:.2f}", confidence.probability);
    if (const std::string cue = decided_by(candidates); !cue.empty())
        log("decided against its best rival by {}", cue);
    if (is_mirrored(candidates.front()))
        warn(
            "only mirrored maps were found; are the surfaces of opposite handedness (--mirror)? look at "
            "candidates.png");
    else if (!confidence.confident)
        warn(
            "the choice among the candidates is not sure ({}): look at candidates.png, {}or give {}landmarks",
            doubt(candidates), candidates.size() > 1 ? "try --candidate 2, " : "",
            has_landmarks ? "more " : "");
}

void report_self_maps(const std::vector<Candidate>& self_maps) {
    for (size_t k = 0; k < self_maps.size(); ++k)
        log("self-map {}: energy {:.2f} times the identity's, {}", k + 1, std::exp(self_maps[k].score),
            relation(self_maps[k]));
}

Candidates read_self_maps(Stage& stage, const PairInputs& inputs, const std::string& side,
                          const std::string& path, const TriangleMesh& input) {
    auto self_maps = stage.read<Candidates>("self-maps." + side, path);
    inputs.require_self_maps(self_maps.header, path, side);
    require_surfaces(self_maps.value, input, input);
    return std::move(self_maps.value);
}

/// Maps are judged by how they carry faces.
void require_surface(const Surface& surface) {
    if (!surface.is_surface())
        throw InputError(
            "varimap-explore looks for maps between surfaces only; for other domains give varimap-diffuse "
            "landmarks, "
            "or --start wasserstein");
}

}  // namespace

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
                                "beyond doubt are composed with "
                                "them (default: they are looked for then, but with landmarks)",
                                2, 2);
    return stage.main(argc, argv, [&] {
        SurfaceData A = inputs.read_A(stage), B = inputs.read_B(stage);
        require_surface(A.surface);
        require_surface(B.surface);
        std::optional<SelfMaps> given;
        if (!self_map_files.empty())
            given = {read_self_maps(stage, inputs, "A", self_map_files[0], A.surface.input),
                     read_self_maps(stage, inputs, "B", self_map_files[1], B.surface.input)};
        const auto landmarks =
            read_landmarks(stage, landmark_files, A.surface, B.surface, params.landmark_space);
        const auto vertices = to_mesh_vertices(landmarks.vertices, A.surface, B.surface);
        const PointPairs points = landmark_points(landmarks, A.surface, B.surface);
        const PairContext context =
            pair_context(std::move(A), std::move(B), vertices, points, params.landmark_weight);
        std::function<SelfMaps()> self_maps;
        if (given)
            self_maps = [&] { return *given; };
        else if (landmark_files.empty())
            self_maps = [&] { return find_self_maps_of_both(context, params); };
        Candidates found =
            params.self_maps ? find_self_maps(context, params) : explore(context, params, self_maps);
        if (params.self_maps)
            report_self_maps(found.list);
        else if (landmarks_decide(found))
            log("varimap-diffuse follows the landmarks");
        else
            report(found.list, !landmark_files.empty());
        found.sketched_A = inputs.sketched("A");
        found.sketched_B = inputs.sketched("B");
        stage.record_number("candidates", double(found.list.size()));
        stage.write(out, found);
    });
}
