#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "stages/partners/partners.h"
#include "varimap/results/plan.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// Throws ArtifactError for a plan that is not one between all points of these surfaces or domains.
void require_all_points(const Plan& plan, const Surface& A, const Surface& B);

/// `point,partner,certainty`: a row for each point of the source's file that the plan has, numbered as in the
/// files; a surface's points by the nearest vertices there. Partner -1: the point has none.
std::string partners_csv(const std::vector<Partner>& partners, const Surface& source, const Surface& target);

/// What partners.json says of one direction.
struct PartnerNumbers {
    std::size_t points = 0;
    double mean_certainty = 0;  ///< by mass
    double edges_apart = 0;     ///< share_apart (partners.h)
};
PartnerNumbers numbers_of(const std::vector<Partner>& partners, const Domain& source,
                          const GeodesicGraph& target, double apart);

/// An object `source`, `target` of objects points, mean_certainty, edges_apart; on one line where `indent` is
/// negative.
std::string as_json(const PartnerNumbers& source, const PartnerNumbers& target, int indent = -1);

}  // namespace varimap
