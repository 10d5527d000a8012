#pragma once

#include <vector>

#include "varimap/core/linear_algebra.h"
#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/surface/domain.h"

namespace varimap {

// The weights W by which levels measure neighbourhoods. Row k of a matrix of weights holds W_k(x_i) of the
// samples i of its neighbourhood, those that are at least epsilon; W_k(x_k) = 1.

/// W of Eq. 7 from an inner product of two diffusion embeddings and the points' own: 2 K_xp / (K_x + K_p). 1
/// - W is the squared diffusion distance, relative to K_x + K_p.
inline double diffusion_weight(double product, double square_x, double square_p) {
    return 2 * product / (square_x + square_p);
}

/// Of Eq. 11, W = exp(-d^2 / 2 sigma^2): the distance d at which it has a value, units of sigma.
double gaussian_distance(double weight);

/// W of Eq. 7 among points given by their diffusion embedding (rows), truncated below epsilon.
SparseMatrix diffusion_weights(const RowMatrix& embedding, double truncation);
/// The same, where `weights` are known of the first points.
SparseMatrix more_diffusion_weights(const SparseMatrix& weights, const RowMatrix& embedding,
                                    double truncation);

/// What a Euclidean neighbourhood must hold, and the rule that turns its radius into sigma.
struct BallRule {
    double radius = 0;           ///< along the surface, where W = epsilon; units of sqrt(area)
    int minimum_neighbours = 1;  ///< the radius of a sample grows until it holds that many
    double truncation = 0.5;     ///< epsilon
};

/// Gaussian weights along the surface (Eq. 11 with geodesic distances), on a surface among samples whose
/// normals agree: balls in R^3, or across a thin sheet, would bridge limbs that only touch.
SparseMatrix geodesic_weights(const std::vector<int>& samples, const Domain& domain,
                              const GeodesicGraph& graph, const BallRule& rule);
/// The same, where `weights` are known of the first samples by the same rule.
SparseMatrix more_geodesic_weights(const SparseMatrix& weights, const std::vector<int>& samples,
                                   const Domain& domain, const GeodesicGraph& graph, const BallRule& rule);

/// Average over samples of the geodesic distance to the farthest member of their neighbourhoods.
double average_radius(const std::vector<int>& samples, const SparseMatrix& weights,
                      const GeodesicGraph& graph);

/// The members of the nearer part of neighbourhoods cut at epsilon = `truncation`.
SparseMatrix nearer_part(const SparseMatrix& weights, double truncation);

}  // namespace varimap
