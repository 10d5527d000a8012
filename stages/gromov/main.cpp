#include "stages/gromov/gromov.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

int main(int argc, char** argv) {
    GromovParams params;
    Stage stage("gromov", "The plain entropic Gromov-Wasserstein plan, to compare with (Fig. 20)");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const std::string& A_in =
        stage.input("A.surface", "domain of varimap-domain, or surface of few vertices");
    const std::string& B_in =
        stage.input("B.surface", "domain of varimap-domain, or surface of few vertices");
    const std::string& out =
        stage.output(ArtifactType<Plan>::kind, ArtifactType<Plan>::schema, "plan to write");
    return stage.main(argc, argv, [&] {
        const Domain A = stage.read<Domain>("A.surface", A_in).value,
                     B = stage.read<Domain>("B.surface", B_in).value;
        const Plan plan = gromov_wasserstein(A, B, params);
        stage.record_number("iterations", double(plan.trace.size()));
        stage.record_number("energy", plan.trace.back().energy);
        stage.write(out, plan);
    });
}
