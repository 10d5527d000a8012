#include <fmt/format.h>

#include <optional>

#include "stages/explore/explore.h"
#include "stages/explore/mirror_images.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/results/choice.h"
#include "varimap/spectral/spectral_check.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

namespace {

/// ", first at vertex 12 of the source: candidate 1 has it at vertex 34 of the target, 2 at 56"; or "".
std::string where_to_tell(const TellingVertex& told) {
    if (told.images.empty()) return "";
    std::string text =
        fmt::format(", first at vertex {} of the source: candidate 1 has it at vertex {} of the target",
                    told.source, told.images.front());
    for (std::size_t k = 1; k < told.images.size(); ++k)
        text += fmt::format(", {} at {}", k + 1, told.images[k]);
    return text;
}

void report(const Candidates& found, bool has_landmarks, const PairContext& context) {
    const std::vector<Candidate>& candidates = found.list;
    for (size_t k = 0; k < candidates.size(); ++k)
        log("candidate {} ({}): energy {:.6g}, Dirichlet energy {:.3f}, relief {:.3f}, alignment {:.3f}, "
            "stretch "
            "{:.3f}, score {:.2f}, {:.1f}% reversed; {}",
            k + 1, origin(candidates[k]), candidates[k].energy, candidates[k].dirichlet, candidates[k].relief,
            candidates[k].alignment, candidates[k].stretch, candidates[k].score,
            100 * candidates[k].reversed_mass, relation(candidates[k]));
    const Confidence confidence = confidence_of(candidates);
    log("the first is {}", probability_in_words(confidence));
    if (const std::string cue = decided_by(candidates); !cue.empty())
        log("decided against its best rival by {}", cue);
    if (is_mirrored(candidates.front()))
        warn(
            "only mirrored maps were found; are the surfaces of opposite handedness (--mirror)? look at "
            "candidates.png");
    else if (fits_mirrored(candidates.front()))
        warn(
            "the surfaces fit better as mirror images of each other: if one is a left and the other a right "
            "one, {}; else give landmarks",
            mirror_advice(context));
    else if (!confidence.confident)
        warn(
            "the choice among the candidates is not sure ({}): look at candidates.png, {}or give "
            "{}landmarks{}",
            doubt(candidates), candidates.size() > 1 ? "try --candidate 2, " : "",
            has_landmarks ? "more " : "", where_to_tell(found.telling));
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

/// None where there are no files, of A and of B.
SelfMapsOnDemand given_self_maps(Stage& stage, const PairInputs& inputs,
                                 const std::vector<std::string>& files, const Surface& A, const Surface& B) {
    if (files.empty()) return {};
    const auto of = [&](const std::string& side, const std::string& path, const TriangleMesh& input) {
        return [maps = read_self_maps(stage, inputs, side, path, input)] { return maps; };
    };
    return {of("A", files[0], A.input), of("B", files[1], B.input)};
}

void require_made_from(const RecordedInput& child, const char* role, const RecordedInput& parent) {
    Stage::require_lineage(child.header(), child.path(), role, parent.header(), parent.path());
}

/// A surface that was sketched, with its basis and hierarchy.
struct SketchedSurface {
    RecordedInput surface, basis, hierarchy;

    /// Refuses them where they do not belong together.
    void require_lineage() const {
        require_made_from(basis, "surface", surface);
        require_made_from(hierarchy, "surface", surface);
        require_made_from(hierarchy, "basis", basis);
    }
    SurfaceData read() const {
        SurfaceData data{surface.read<Surface>(), basis.read<Basis>(), hierarchy.read<Hierarchy>()};
        require_fit(data);
        return data;
    }
};

struct SketchedSurfaces {
    SketchedSurface A, B;
};

/// `files`: surface, basis and hierarchy of A, then of B. Refuses surfaces of which those read are no
/// sketches.
SketchedSurfaces record_surfaces(Stage& stage, const std::vector<std::string>& files,
                                 const PairInputs& sketches) {
    const auto input = [&](std::size_t k) {
        return stage.record(std::string("surfaces.") + char('A' + k), files[k]);
    };
    const SketchedSurfaces surfaces{{input(0), input(1), input(2)}, {input(3), input(4), input(5)}};
    surfaces.A.require_lineage();
    surfaces.B.require_lineage();
    sketches.require_sketched("A", surfaces.A.surface.header(), surfaces.A.surface.path());
    sketches.require_sketched("B", surfaces.B.surface.header(), surfaces.B.surface.path());
    return surfaces;
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
                                "them (default: they are looked for then, except with landmarks)",
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
            pair_context(std::move(A), std::move(B), landmarks, params.landmark_weight);
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
