#include <fmt/format.h>

#include <optional>

#include "stages/explore/explore.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/spectral/spectral_check.h"
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

/// The surfaces that were sketched, with their bases and hierarchies: recorded as inputs in any case, read
/// where they are asked for.
class SketchedSurfaces {
  public:
    SketchedSurfaces(Stage& stage, const std::vector<std::string>& files) : files_(files) {
        for (std::size_t k = 0; k < files.size(); ++k) {
            headers_.push_back(read_header(files[k]));
            stage.record_input(
                {std::string("surfaces.") + char('A' + k), headers_[k].kind, headers_[k].payload_hash});
        }
        if (files.empty()) return;
        for (const std::size_t surface : {0, 3}) {
            require_lineage(surface + 1, "surface", surface);
            require_lineage(surface + 2, "surface", surface);
            require_lineage(surface + 2, "basis", surface + 1);
        }
    }
    bool are_given() const { return !files_.empty(); }
    /// Refuses surfaces of which those read are no sketches.
    void require_sketches(const PairInputs& sketches) const {
        for (const auto& [side, surface] : {std::pair("A", 0), std::pair("B", 3)})
            if (are_given() && sketches.sketched(side) != headers_[std::size_t(surface)].payload_hash)
                throw ArtifactError(
                    fmt::format("'{}' is not the surface that was sketched; rerun varimap-coarsen",
                                files_[std::size_t(surface)]));
    }
    SurfaceData read_A() const { return read(0); }
    SurfaceData read_B() const { return read(3); }

  private:
    void require_lineage(std::size_t child, const char* role, std::size_t parent) const {
        Stage::require_lineage(headers_[child], files_[child], role, headers_[parent], files_[parent]);
    }
    template <class T>
    T read_one(std::size_t k) const {
        Artifact<T> artifact = read_artifact<T>(files_[k]);
        if (artifact.header.payload_hash != headers_[k].payload_hash)
            throw IoError("'" + files_[k] + "' changed since this stage began; run again");
        return std::move(artifact.value);
    }
    SurfaceData read(std::size_t first) const {
        SurfaceData data{read_one<Surface>(first), read_one<Basis>(first + 1),
                         read_one<Hierarchy>(first + 2)};
        require_fit(data);
        return data;
    }

    const std::vector<std::string>& files_;
    std::vector<Header> headers_;
};

/// Maps are judged by how they carry faces.
void require_surface(const Surface& surface) {
    if (!surface.is_surface())
        throw InputError(
            "varimap-explore looks for maps between surfaces only; for other domains give varimap-diffuse "
            "landmarks, "
            "or --start wasserstein");
}

PairContext with_landmarks(SurfaceData A, SurfaceData B, const Landmarks& landmarks,
                           const ExploreParams& params) {
    const auto vertices = to_mesh_vertices(landmarks.vertices, A.surface, B.surface);
    const PointPairs points = landmark_points(landmarks, A.surface, B.surface);
    return pair_context(std::move(A), std::move(B), vertices, points, params.landmark_weight);
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
    const auto& surface_files = stage.input_list_option(
        "surfaces",
        "what was sketched: surface, basis and hierarchy of A, then of B; where the choice is not sure, maps "
        "that may be right are finished and compared on these, too",
        6, 6);
    return stage.main(argc, argv, [&] {
        SurfaceData A = inputs.read_A(stage), B = inputs.read_B(stage);
        require_surface(A.surface);
        require_surface(B.surface);
        std::optional<SelfMaps> given;
        if (!self_map_files.empty())
            given = {read_self_maps(stage, inputs, "A", self_map_files[0], A.surface.input),
                     read_self_maps(stage, inputs, "B", self_map_files[1], B.surface.input)};
        const SketchedSurfaces surfaces(stage, surface_files);
        surfaces.require_sketches(inputs);
        const auto landmarks =
            read_landmarks(stage, landmark_files, A.surface, B.surface, params.landmark_space);
        const PairContext context = with_landmarks(std::move(A), std::move(B), landmarks, params);
        OnDemand ask;
        if (given)
            ask.self_maps = [&] { return *given; };
        else if (landmark_files.empty())
            ask.self_maps = [&] { return find_self_maps_of_both(context, params); };
        if (surfaces.are_given())
            ask.surfaces = [&] {
                return with_landmarks(surfaces.read_A(), surfaces.read_B(), landmarks, params);
            };
        Candidates found = params.self_maps ? find_self_maps(context, params) : explore(context, params, ask);
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
