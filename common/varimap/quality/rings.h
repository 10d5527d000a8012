#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "varimap/mesh/topology.h"
#include "varimap/quality/image_mesh.h"

namespace varimap {

/// Of a triangle under the map, with J its differential, in the frame of the gradient e of the distance u and
/// of n x e.
struct Shear {
    double along;  ///< J e . J(n x e) / |J(n x e)|
    Vec3 around;   ///< J(n x e)
};

/// A component of a band of the source; sums are over its triangles.
struct Ring {
    int band = 0, vertex = -1;
    double area = 0;
    double weight = 0, along = 0, along_squared = 0, around = 0;       ///< times areas
    double least = std::numeric_limits<double>::infinity(), most = 0;  ///< of u
    bool is_closed = true;
    std::vector<int> next, before;  ///< in the bands beside it; of no crumbs

    /// Of its image.
    double radius(double width) const;
    /// By which the map turns its ends against each other, in radians.
    double turn(double width) const;
};

/// The rings of a map's source: components of its bands in the distance u from an end of each of its
/// components. Units of sqrt(area).
class Rings {
  public:
    /// Keeps a reference.
    explicit Rings(const ImageMesh& images);

    const std::vector<Ring>& all() const { return rings_; }
    const Ring& operator[](int ring) const { return rings_[std::size_t(ring)]; }
    int of_face(int f) const { return ring_of_[std::size_t(f)]; }
    double width() const { return width_; }
    /// Mean u of a face's corners.
    double mean_at(int f) const;
    /// Of the image of the ring there: towards a tip, with no ring behind, the distance from it.
    double radius_at(int f) const;
    /// None where u hardly rises, or the triangle has no image.
    std::optional<Shear> shear(int f) const;

  private:
    void number_components(const std::vector<int>& band);
    void add(int f, int band);
    void join();
    void join(int a, int b);

    const ImageMesh& images_;
    const Edges edges_;
    const double width_;
    const Eigen::VectorXd u_;
    std::vector<int> ring_of_;  ///< per face
    std::vector<Ring> rings_;
};

/// Closed rings behind each other, each of which goes on in the next alone.
using Tube = std::vector<int>;

/// All of them.
std::vector<Tube> tubes(const Rings& rings);

/// By which the map turns the ends of each ring of a tube, in radians. The first and the last, which close it
/// or where others begin, do not count.
std::vector<double> turns(const Tube& tube, const Rings& rings);

}  // namespace varimap
