#include "stages/eigen/params.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

int main(int argc, char** argv) {
    EigenSolverOptions options;
    Stage stage("eigen", "Smallest eigenpairs of a surface's Laplacian (Sec. 3.1)");
    stage.parameters([&](ParameterList& list) { describe(list, options); });
    const std::string& in = stage.input(
        "surface", "surface of varimap-coarsen or varimap-preprocess, or domain of varimap-domain");
    const std::string& out =
        stage.output(ArtifactType<Basis>::kind, ArtifactType<Basis>::schema, "basis to write");
    return stage.main(argc, argv, [&] {
        const auto surface = stage.read<Domain>("surface", in);
        log("computing {} eigenpairs of {} vertices", options.count, surface.value.mesh.vertex_count());
        const Basis basis = compute_eigenbasis(surface.value, options);
        log("{} eigenpairs, lambda_2 {:.4g}, lambda_max {:.4g}, largest residual {:.2g}",
            basis.eigenvalues.size(), basis.eigenvalues[1], basis.eigenvalues.tail(1)[0],
            basis.residuals.maxCoeff());
        stage.record_number("eigenpairs", double(basis.eigenvalues.size()));
        stage.record_number("largest_residual", basis.residuals.maxCoeff());
        stage.write(out, basis);
    });
}
