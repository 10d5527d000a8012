#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "stages/partners/picture.h"
#include "varimap/mesh/topology.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/results/plan.h"
#include "varimap/stage/stage_main.h"
#include "varimap/surface/input_locator.h"

namespace {

using namespace varimap;

/// Per point of a domain its number in the file; of a surface's mesh that of the nearest corner.
int number(const Surface& surface, int point) {
    return surface.is_surface() ? nearest_in_file(surface, point) : point;
}

/// A row for each point of the source's file that the plan has.
std::string table(const std::vector<Partner>& partners, const Surface& source, const Surface& target) {
    std::string text = "point,partner,certainty\n";
    for (std::size_t i = 0; i < partners.size(); ++i) {
        if (source.is_surface() && vertex_of(source.input, source.on_input[i]) < 0) continue;
        const Partner& partner = partners[i];
        text += fmt::format("{},{},{:.4f}\n", number(source, int(i)),
                            partner.point < 0 ? -1 : number(target, partner.point), partner.certainty);
    }
    return text;
}

double mean_certainty(const std::vector<Partner>& partners, const Eigen::VectorXd& mass) {
    double sum = 0;
    for (std::size_t i = 0; i < partners.size(); ++i) sum += mass[Eigen::Index(i)] * partners[i].certainty;
    return sum;
}

nlohmann::ordered_json numbers(const std::vector<Partner>& partners, const Domain& source,
                               const GeodesicGraph& target, double apart) {
    return {{"points", partners.size()},
            {"mean_certainty", mean_certainty(partners, source.mass)},
            {"edges_apart", share_apart(source, partners, target, apart)}};
}

void require_all_points(const Plan& plan, const Surface& A, const Surface& B) {
    require_surfaces(plan, A, B);
    if (plan.plan.entries.rows() != A.mass.size() || plan.plan.entries.cols() != B.mass.size() ||
        plan.centre_A.rows() != A.mass.size())
        throw ArtifactError("the plan is not one between all points; rerun varimap-refine without --levels");
}

}  // namespace

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
        const nlohmann::ordered_json both{{"source", numbers(of_A, A, graph_B, params.apart)},
                                          {"target", numbers(of_B, B, graph_A, params.apart)}};
        stage.write_file(folder + "/source_partners.csv", table(of_A, A, B));
        stage.write_file(folder + "/target_partners.csv", table(of_B, B, A));
        stage.write_file(folder + "/partners.json", both.dump(1) + "\n");
        stage.write_file(folder + "/partners.svg",
                         picture_of({A, of_A}, {B, of_B}, plan.centre_A, params.layout));
        log("{}", both.dump());
    });
}
