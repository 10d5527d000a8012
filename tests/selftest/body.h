#pragma once

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "fixtures/limbs.h"
#include "fixtures/shapes.h"

namespace varimap::shapes {

/// Limbs that move together.
struct Part {
    std::vector<Limb> limbs;
    Bend bend;
};

/// A smooth union of parts. Posed, every part bends, with smooth transitions where parts meet, and then the
/// whole does: nearly an isometry of its surface.
struct Body {
    std::vector<Part> parts;
    Bend bend;

    std::vector<Limb> limbs() const;
    /// Where a point of the surface at rest goes.
    Vec3 posed(const Vec3& p) const;
    /// The surface at rest with about that many vertices, on a grid that is turned.
    TriangleMesh mesh(int vertices, const Eigen::Matrix3d& turn) const;
};

struct SelftestShape {
    const char* kind;
    Body body;
};

/// Shapes without symmetry, or with one that only orientation, feet, faces or lengths of limbs break: blobs,
/// creatures with limbs anywhere, rings with limbs (genus 1), four-legged animals and persons, by turns.
/// Deterministic.
SelftestShape selftest_shape(unsigned seed);

/// Random numbers that are the same on every platform.
class Random {
  public:
    explicit Random(unsigned seed) : generator_(seed) {}
    double between(double low, double high) { return low + (high - low) * (generator_() / 4294967296.0); }
    /// A unit vector, uniformly.
    Vec3 direction();
    Eigen::Matrix3d rotation();

  private:
    std::mt19937 generator_;
};

}  // namespace varimap::shapes
