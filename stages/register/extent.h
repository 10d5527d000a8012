#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// What of the template some specimens have: shapes are compared on it.
struct Extent {
    std::vector<int> vertices;  ///< of the template, ascending; each has a face here
    Faces faces;                ///< by the template's vertex numbers
    Eigen::VectorXd weights;    ///< per vertex: a third of its faces' area on the template, of sum 1

    /// The rows of these vertices, of points of all the template's vertices.
    Points of(const Points& points) const { return points(vertices, Eigen::all); }
};

/// Of points of the template's vertices on specimens, NaN where they have no image. Keeps no references.
class Extents {
  public:
    /// `is_part`: per specimen. Throws InputError naming one where an extent has fewer than three vertices.
    Extents(const TriangleMesh& first, const std::vector<Points>& specimens, const std::vector<bool>& is_part,
            const std::vector<std::string>& names);

    /// The faces of which all corners are finite, on the template and on all specimens that are no parts, and
    /// their vertices.
    const Extent& common() const { return common_; }
    /// That of a specimen: the common one, or as much of it as the part has.
    const Extent& of(std::size_t specimen) const;

  private:
    Extent common_;
    std::map<std::size_t, Extent> parts_;
};

}  // namespace varimap
