#include <filesystem>

#include "stages/remesh/quality_json.h"
#include "stages/remesh/remesh.h"
#include "varimap/mesh/io/mesh_file.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

/// Everything but quality.json, which comes last and so tells that the rest is there.
void export_map(const std::string& folder, const SurfaceMap& map, const SamplePlan& plan, const Surface& A,
                const Surface& B) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) throw IoError("cannot make the folder '" + folder + "': " + failure.message());
    write_file_atomically(folder + "/source_to_target.csv", to_csv(map.A_to_B));
    write_file_atomically(folder + "/target_to_source.csv", to_csv(map.B_to_A));
    write_file_atomically(folder + "/source_masses.csv",
                          masses_csv(A, plan.samples_A, plan.transported_A, plan.mass_A));
    write_file_atomically(folder + "/target_masses.csv",
                          masses_csv(B, plan.samples_B, plan.transported_B, plan.mass_B));
    write_file_atomically(folder + "/source_on_target.ply", to_ply(cross_remesh(map.A_to_B, A, B)));
    write_file_atomically(folder + "/target_on_source.ply", to_ply(cross_remesh(map.B_to_A, B, A)));
}

/// What remeshing needs of the artifact of varimap-refine or varimap-diffuse.
struct ImagesOfPair {
    SolvedPair pair;
    VertexMaps images;
};

template <class Solved>
ImagesOfPair read_images(Stage& stage, const std::string& path, const Surface& A, const Surface& B) {
    const Solved solved = stage.read<Solved>("plan", path).value;
    return {solved, read_out(solved, A, B)};
}

}  // namespace

int main(int argc, char** argv) {
    RemeshParams params;
    Stage stage("remesh",
                "The map in both directions on the input meshes, cross-remeshing and quality numbers");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const std::string& surface_A = stage.input("A.surface", "artifact of varimap-preprocess: the source");
    const std::string& surface_B = stage.input("B.surface", "artifact of varimap-preprocess: the target");
    const std::string& plan_file = stage.input("plan", "artifact of varimap-refine or varimap-diffuse");
    const std::string& out = stage.output("map", ArtifactType<SurfaceMap>::schema, "artifact to write");
    const std::string& folder =
        stage.option("export",
                     "folder for source_to_target.csv, target_to_source.csv, source_on_target.ply, "
                     "target_on_source.ply, source_masses.csv, target_masses.csv and quality.json");
    const auto& runs = stage.list_option("runs", "run files (<artifact>.run.json) for quality.json's stages");
    return stage.main(argc, argv, [&] {
        const auto A = stage.read<Surface>("A.surface", surface_A);
        const auto B = stage.read<Surface>("B.surface", surface_B);
        const Header plan = read_header(plan_file);
        Stage::require_lineage(plan, plan_file, "A.surface", A.header, surface_A);
        Stage::require_lineage(plan, plan_file, "B.surface", B.header, surface_B);
        auto [pair, images] = plan.kind == ArtifactType<Diffusion>::kind
                                  ? read_images<Diffusion>(stage, plan_file, A.value, B.value)
                                  : read_images<Plan>(stage, plan_file, A.value, B.value);
        log("{} and {} input vertices", A.value.input.vertex_count(), B.value.input.vertex_count());
        const SurfaceMap map = remesh(A.value, B.value, pair, std::move(images), params);
        stage.write(out, map);
        if (folder.empty()) return;
        export_map(folder, map, pair.plan, A.value, B.value);
        const std::string own_name = "remesh " + std::filesystem::path(out).stem().string();
        write_file_atomically(folder + "/quality.json",
                              with_stages(map.quality, runs, own_name, stage.usage()));
    });
}
