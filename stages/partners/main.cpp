#include <fmt/format.h>

#include <filesystem>

#include "stages/partners/picture.h"
#include "stages/partners/results.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

int main(int argc, char** argv) {
    PartnersParams params;
    Stage stage("partners", "The best partner of every point in a plan, its certainty, and a picture");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const auto& A_path = stage.input("A.surface", "domain of varimap-domain, or surface");
    const auto& B_path = stage.input("B.surface", "domain of varimap-domain, or surface");
    const auto& plan_path = stage.input("plan", "artifact of varimap-refine or varimap-gromov");
    const auto& folder = stage.word("folder",
                                    "that is there, for source_partners.csv, target_partners.csv, "
                                    "partners.json and partners.svg");
    return stage.main(argc, argv, [&] {
        if (!std::filesystem::is_directory(folder))
            throw IoError(fmt::format("cannot write into '{}': there is no such folder", folder));
        const Surface A = read_surface_or_domain(stage, "A.surface", A_path).value,
                      B = read_surface_or_domain(stage, "B.surface", B_path).value;
        const Plan plan = stage.read<Plan>("plan", plan_path).value;
        require_all_points(plan, A, B);
        const GeodesicGraph graph_A(A), graph_B(B);
        const SparseMatrix back = plan.plan.entries.transpose();
        const auto of_A = best_partners(plan.plan.entries, graph_B, params.radius);
        const auto of_B = best_partners(back, graph_A, params.radius);
        const PartnerNumbers numbers_A = numbers_of(of_A, A, graph_B, params.apart),
                             numbers_B = numbers_of(of_B, B, graph_A, params.apart);
        stage.write_file(folder + "/source_partners.csv", partners_csv(of_A, A, B));
        stage.write_file(folder + "/target_partners.csv", partners_csv(of_B, B, A));
        stage.write_file(folder + "/partners.json", as_json(numbers_A, numbers_B, 1) + "\n");
        stage.write_file(folder + "/partners.svg",
                         picture_of({A, of_A}, {B, of_B}, plan.centre_A, params.layout));
        log("{}", as_json(numbers_A, numbers_B));
    });
}
