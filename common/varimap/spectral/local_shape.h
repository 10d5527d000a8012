#pragma once

#include <Eigen/Core>

#include "varimap/core/linear_algebra.h"
#include "varimap/spectral/eigenbasis.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// Whether the faces of two surfaces that are mapped onto each other look inward (orientation_sign,
/// boundary.h). Those of one without an inside do not tell: they are taken to look as those of the other do,
/// if that has one and is not the mirrored one of the two; else, as is_inward says.
struct PairHandedness {
    bool A_inward = false, B_inward = false;

    PairHandedness(const Domain& A, const Domain& B);
    /// Whether a map that goes with the faces mirrors the shape.
    bool are_opposite() const { return A_inward != B_inward; }
};
/// Whether faces look inward; of a surface without an inside, whether it is mirrored.
bool is_inward(const Domain& surface);
/// Unit normals at vertices (vertex_normals), turned where faces look inward.
Points outward_normals(const TriangleMesh& mesh, bool inward);

/// How far each vertex stands out of the smoothed surface, along its outward normal, units of sqrt(area): the
/// surface less its heat flow (by the eigenbasis) at a time in units of area, which is twice the time times
/// the mean curvature smoothed at that scale. Positive on ridges, negative in hollows. Isometries do not keep
/// it, so it tells a toe from a heel where distances on the surface hardly do.
Eigen::VectorXd bending(const Domain& surface, const Points& normals, const Basis& basis, double time);

/// Shape diameter (Shapira, Shamir, Cohen-Or 2008): how far it is through the shape from each vertex, along
/// the inward normal and around it, units of sqrt(area). Rays that leave through a hole count as long ones,
/// as do those of vertices without a normal.
Eigen::VectorXd shape_diameter(const TriangleMesh& mesh, const Points& normals);

/// Descriptors are cut off there, in standard deviations, so that outliers do not outweigh all else. Chosen
/// by hand, not swept.
constexpr double largest_descriptor = 2.5;

/// What tells parts of a surface apart by their look, not by where they are.
struct LocalShape {
    /// vertices x 3: bending at two times and shape diameter, compressed, of mean 0 and together of variance
    /// 1; near 0 where all places are alike. They were chosen because between shapes of different proportions
    /// true correspondences agree in them better than maps of least energy do. For heat kernels, whose low
    /// frequencies feel proportions just as the energy does, the opposite holds.
    RowMatrix descriptors;
    Eigen::VectorXd bending;  ///< per vertex: smoothed over about a tenth of sqrt(area)
};
/// Of what is no surface all are 0: nothing attracts.
LocalShape local_shape(const Domain& surface, const Basis& basis);

}  // namespace varimap
