#include <fmt/format.h>

#include "stages/show/params.h"
#include "stages/show/show.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/results/plan.h"
#include "varimap/spectral/spectral_check.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

const std::string& only(const std::vector<std::string>& paths, std::size_t wanted, const std::string& what) {
    if (paths.size() != wanted)
        throw UsageError(
            fmt::format("{} needs {} files, not {}; --help explains", what, wanted, paths.size()));
    return paths.front();
}

std::string weights(Stage& stage, const std::vector<std::string>& paths, const ShowParams& params) {
    const Domain domain = stage.read<Domain>("surface", only(paths, 2, "weights")).value;
    const Basis basis = stage.read<Basis>("basis", paths[1]).value;
    require_fit(basis, domain);
    return show_weights(domain, basis, params.point, params.time);
}

std::string samples(Stage& stage, const std::vector<std::string>& paths) {
    const Domain domain = stage.read<Domain>("surface", only(paths, 2, "samples")).value;
    const Hierarchy hierarchy = stage.read<Hierarchy>("hierarchy", paths[1]).value;
    if (int(hierarchy.levels.front().cell.size()) != domain.mesh.vertex_count())
        throw ArtifactError("'" + paths[1] + "' is of another surface than '" + paths[0] + "'");
    return show_samples(domain, hierarchy);
}

std::string row(Stage& stage, const std::vector<std::string>& paths, const ShowParams& params) {
    const Surface A = read_surface_or_domain(stage, "A.surface", only(paths, 3, "row")).value,
                  B = read_surface_or_domain(stage, "B.surface", paths[1]).value;
    const Diffusion diffusion = stage.read<Diffusion>("diffusion", paths[2]).value;
    require_surfaces(diffusion, A, B);
    return show_row(A, B, diffusion.plan, params.point);
}

std::string centres(Stage& stage, const std::vector<std::string>& paths) {
    const Surface A = read_surface_or_domain(stage, "A.surface", only(paths, 3, "centres")).value,
                  B = read_surface_or_domain(stage, "B.surface", paths[1]).value;
    const Plan plan = stage.read<Plan>("plan", paths[2]).value;
    require_surfaces(plan, A, B);
    if (plan.centre_A.rows() != A.mesh.vertex_count())
        throw ArtifactError("'" + paths[2] + "' is of another surface than '" + paths[0] + "'");
    return show_centres(A, B, plan.centre_A);
}

std::string wires(const std::vector<std::string>& paths) {
    const TriangleMesh mesh = read_mesh(only(paths, 1, "wires"));
    require_plain_faces(mesh, paths[0]);
    return show_wires(mesh);
}

}  // namespace

int main(int argc, char** argv) {
    ShowParams params;
    Stage stage("show", "Pictures (SVG, to stdout) of what artifacts hold");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const auto& what = stage.word("what",
                                  "weights (files: surface, basis), samples (surface, hierarchy), row (both "
                                  "surfaces, diffusion), centres (both surfaces, plan) or wires (mesh)");
    const auto& paths = stage.input_list("files", "what is shown");
    return stage.main(argc, argv, [&] {
        fmt::print("{}", what == "weights"   ? weights(stage, paths, params)
                         : what == "samples" ? samples(stage, paths)
                         : what == "row"     ? row(stage, paths, params)
                         : what == "centres" ? centres(stage, paths)
                         : what == "wires"
                             ? wires(paths)
                             : throw UsageError("show what? weights, samples, row, centres or wires"));
    });
}
