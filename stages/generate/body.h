#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "stages/generate/bend.h"
#include "stages/generate/limbs.h"

namespace varimap::shapes {

/// Limbs that move together.
struct Part {
    std::vector<Limb> limbs;
    Bend bend;
};

/// Limbs that keep still among themselves.
Part unbent(std::vector<Limb> limbs);

/// A plane wave of relief: height * sin(wave . p + phase) is taken off the distance.
struct Ripple {
    Vec3 wave;  ///< 2 pi / wavelength, in the direction across which it runs
    double phase, height;
};

/// A smooth union of parts. Posed, every part bends, with smooth transitions where parts meet, and then the
/// whole does: nearly an isometry of its surface.
struct Body {
    std::vector<Part> parts;
    Bend bend;
    std::vector<Ripple> relief = {};

    std::vector<Limb> limbs() const;
    /// Where a point of the surface at rest goes.
    Vec3 posed(const Vec3& p) const;
    /// The surface at rest with about that many vertices, on a grid that is turned.
    TriangleMesh mesh(int vertices, const Eigen::Matrix3d& turn) const;
    /// The same with that many, vertices even, on a grid first that is fine enough for its thinnest limb.
    /// None where the surface is not one closed surface of genus 0: limbs touch, or one is too thin all the
    /// same.
    std::optional<TriangleMesh> sphere_mesh(int vertices, const Eigen::Matrix3d& turn) const;
};

/// What the surface at rest of a body is the zero level of; negative inside.
class BodyDistance {
  public:
    explicit BodyDistance(const Body& body) : limbs_(body.limbs()), relief_(body.relief) {}
    double operator()(const Vec3& p) const;

  private:
    std::vector<Limb> limbs_;
    std::vector<Ripple> relief_;
};

}  // namespace varimap::shapes
