#include "stages/partners/results.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "varimap/core/error.h"
#include "varimap/mesh/topology.h"
#include "varimap/surface/input_locator.h"

namespace varimap {

namespace {

/// Per point of a domain its number in the file; of a surface's mesh that of the nearest corner.
int number(const Surface& surface, int point) {
    return surface.is_surface() ? nearest_in_file(surface, point) : point;
}

double mean_certainty_of(const std::vector<Partner>& partners, const Eigen::VectorXd& mass) {
    double sum = 0;
    for (std::size_t i = 0; i < partners.size(); ++i) sum += mass[Eigen::Index(i)] * partners[i].certainty;
    return sum;
}

nlohmann::ordered_json object_of(const PartnerNumbers& numbers) {
    return {{"points", numbers.points},
            {"mean_certainty", numbers.mean_certainty},
            {"edges_apart", numbers.edges_apart}};
}

}  // namespace

void require_all_points(const Plan& plan, const Surface& A, const Surface& B) {
    require_surfaces(plan, A, B);
    if (plan.plan.entries.rows() != A.mass.size() || plan.plan.entries.cols() != B.mass.size() ||
        plan.centre_A.rows() != A.mass.size())
        throw ArtifactError("the plan is not one between all points; rerun varimap-refine without --levels");
}

std::string partners_csv(const std::vector<Partner>& partners, const Surface& source, const Surface& target) {
    std::string text = "point,partner,certainty\n";
    for (std::size_t i = 0; i < partners.size(); ++i) {
        if (source.is_surface() && vertex_of(source.input, source.on_input[i]) < 0) continue;
        const Partner& partner = partners[i];
        text += fmt::format("{},{},{:.4f}\n", number(source, int(i)),
                            partner.point < 0 ? -1 : number(target, partner.point), partner.certainty);
    }
    return text;
}

PartnerNumbers numbers_of(const std::vector<Partner>& partners, const Domain& source,
                          const GeodesicGraph& target, double apart) {
    return {partners.size(), mean_certainty_of(partners, source.mass),
            share_apart(source, partners, target, apart)};
}

std::string as_json(const PartnerNumbers& source, const PartnerNumbers& target, int indent) {
    const nlohmann::ordered_json both{{"source", object_of(source)}, {"target", object_of(target)}};
    return both.dump(indent);
}

}  // namespace varimap
