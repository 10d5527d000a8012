#pragma once

#include <vector>

#include "varimap/core/linear_algebra.h"
#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// The place where most of a point's mass goes.
struct Partner {
    int point = -1;        ///< of the other domain; -1: the point has no mass in the plan
    double certainty = 0;  ///< share of the point's mass that lands within the radius of it
};

/// Per row of a plan between all points of two domains: of the points its mass goes to, the one with the most
/// mass around it, which counts by 1 - distance / radius along the domain `graph` of the columns.
std::vector<Partner> best_partners(const SparseMatrix& plan, const GeodesicGraph& graph, double radius);

/// Of a domain's edges (of a surface: those of its mesh), the share whose ends' partners are farther from
/// each other along the other domain than `apart` times the mean length of these edges. Both are of the same
/// size.
double share_apart(const Domain& domain, const std::vector<Partner>& partners, const GeodesicGraph& other,
                   double apart);

}  // namespace varimap
