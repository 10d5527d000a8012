#include "stages/hierarchy/params.h"
#include "varimap/spectral/spectral_check.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

int main(int argc, char** argv) {
    HierarchyOptions options;
    Stage stage("hierarchy", "Diffusion levels, then Euclidean levels of a surface (Sec. 4.2, 4.5)");
    stage.parameters([&](ParameterList& list) { describe(list, options); });
    const std::string& surface_in = stage.input(
        "surface", "surface of varimap-coarsen or varimap-preprocess, or domain of varimap-domain");
    const std::string& basis_in = stage.input("basis", "basis of varimap-eigen");
    const std::string& out =
        stage.output(ArtifactType<Hierarchy>::kind, ArtifactType<Hierarchy>::schema, "hierarchy to write");
    return stage.main(argc, argv, [&] {
        const auto surface = stage.read<Domain>("surface", surface_in);
        const auto basis = stage.read<Basis>("basis", basis_in);
        Stage::require_lineage(basis.header, basis_in, "surface", surface.header, surface_in);
        require_fit(basis.value, surface.value);
        const Hierarchy hierarchy = build_hierarchy(surface.value, basis.value, options);
        stage.record_number("levels", double(hierarchy.levels.size()));
        stage.write(out, hierarchy);
    });
}
