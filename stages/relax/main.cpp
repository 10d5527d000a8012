#include "stages/relax/placed_part.h"
#include "stages/relax/relax.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

struct StartingMap {
    PairRecord record;
    MapPair images;
    double area_bound;
};

/// From the plan of varimap-refine, or from that of varimap-diffuse.
template <class Solved>
StartingMap read_start(Stage& stage, const std::string& path, const Surface& A, const Surface& B) {
    const Solved solved = stage.read<Solved>("plan", path).value;
    require_surfaces(solved, A, B);
    return {solved.record, read_out(solved, A, B), solved.plan.area_bound};
}

}  // namespace

int main(int argc, char** argv) {
    RelaxParams params;
    Stage stage("relax", "The map in both directions on the input meshes, untangled and near to an isometry");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const std::string& surface_A =
        stage.input("A.surface", "artifact of varimap-coarsen or varimap-preprocess: the source");
    const std::string& surface_B =
        stage.input("B.surface", "artifact of varimap-coarsen or varimap-preprocess: the target");
    const std::string& plan_file = stage.input("plan", "artifact of varimap-refine or varimap-diffuse");
    const std::string& placed_in = stage.input_option(
        "placed",
        "region of varimap-locate: begins where the part lies there, too, and keeps the better map");
    const std::string& out = stage.output("map", ArtifactType<SurfaceMap>::schema, "artifact to write");
    return stage.main(argc, argv, [&] {
        const auto A = stage.read<Surface>("A.surface", surface_A);
        const auto B = stage.read<Surface>("B.surface", surface_B);
        const Header plan = read_header(plan_file);
        Stage::require_lineage(plan, plan_file, "A.surface", A.header, surface_A);
        Stage::require_lineage(plan, plan_file, "B.surface", B.header, surface_B);
        auto [record, images, area_bound] = plan.kind == ArtifactType<Diffusion>::kind
                                                ? read_start<Diffusion>(stage, plan_file, A.value, B.value)
                                                : read_start<Plan>(stage, plan_file, A.value, B.value);
        log("{} and {} input vertices", A.value.input.vertex_count(), B.value.input.vertex_count());
        const auto relaxed = [&] {
            if (placed_in.empty())
                return relax(A.value, B.value, record, std::move(images), area_bound, params);
            const PartRegion region = stage.read<PartRegion>("placed", placed_in).value;
            return relax_part(A.value, B.value, record, images, region, area_bound, params);
        };
        const SurfaceMap map = relaxed();
        warn_of_mirrored_parts(map);
        stage.write(out, map);
    });
}
