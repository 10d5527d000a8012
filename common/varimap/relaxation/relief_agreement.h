#pragma once

#include <Eigen/Core>
#include <vector>

#include "varimap/sliding/sliding_map.h"

namespace varimap {

/// Relief h of a surface of unit area, one value per vertex: the normal part of what smoothing takes
/// off, x - (M + s^2 L)^-1 M x with M the vertices' areas and L the cotangent Laplacian, which is s^2 times
/// twice the mean curvature smoothed at scale s. It shows bumps and hollows of about size s and leaves out
/// the broader shape, which changes with the pose. Less its median, in units of 1.5 median deviations, and
/// bounded to [-2, 2]; zeros where there is no deviation. One for each of the scales.
std::vector<Eigen::VectorXd> reliefs(const TriangleMesh& mesh, const std::vector<double>& scales);

/// What bends like cloth gets another relief, which leads astray; sheets (mesh/boundary.h) do so most: those
/// that were bent at random have reliefs that agree by up to this (a correlation).
constexpr double agreement_of_bent_sheets = 0.6;
/// How far reliefs are to be trusted that agree by so much, 0 to 1.
double trust_in_relief(double correlation, bool sheets);

/// The reliefs of two surfaces at one scale.
struct ReliefPair {
    Eigen::VectorXd source, target;  ///< by vertex
};
/// At each of the scales of ReliefAgreement. Both meshes of unit area. `opposed`: the faces of one of them
/// alone look inward, so that its bumps are hollows.
std::vector<ReliefPair> relief_pairs(const TriangleMesh& source, const TriangleMesh& target,
                                     bool opposed = false);
/// Of the same surfaces the other way round.
std::vector<ReliefPair> swapped(std::vector<ReliefPair> reliefs);

/// A data term that holds relief in place: the sum over two scales s and the source's vertices v, of area
/// a_v, of
///     weight a_v rho(r),   r = h_A(v) - h_B(f(v)),   rho(r) = c^2 / 2 log(1 + r^2 / c^2)
/// with the reliefs h of both surfaces at that scale, linear on the target's faces. An isometry's energy
/// hardly resists sliding along limbs or turning about them; relief does. With J the gradient of h_B in the
/// tangent frame of f(v) and u = 1 / (1 + r^2 / c^2), rho has the gradient -u r J and the Gauss-Newton
/// Hessian u J J'. The scales are 0.6 and 1 times 0.02, or the mean edge of the coarser mesh if that is
/// longer. Coarser ones follow the pose.
class ReliefAgreement {
  public:
    /// Keeps a reference to the map. `reliefs`: of its surfaces.
    ReliefAgreement(const SlidingMap& map, double weight, std::vector<ReliefPair> reliefs);

    /// Of both reliefs where the map takes them, mean of the scales.
    double correlation() const;
    void scale_weight(double factor) { weight_ *= factor; }

    struct Quadratic {
        Eigen::Vector2d gradient;
        Eigen::Matrix2d hessian;
    };
    double value(int v) const;
    /// By the coordinates of the image of v in `frame`, which spans the plane of the face that holds it.
    Quadratic derivatives(int v, const TangentFrame& frame) const;

  private:
    double residual(const ReliefPair& pair, int v) const;

    const SlidingMap& map_;
    Eigen::VectorXd weight_;  ///< with the area
    std::vector<ReliefPair> reliefs_;
};

}  // namespace varimap
