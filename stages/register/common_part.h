#pragma once

#include <Eigen/Core>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// The part of the template that every specimen has: shapes are compared on it.
struct CommonPart {
    std::vector<int> vertices;  ///< of the template, ascending; each has a face here
    Faces faces;                ///< by the template's vertex numbers
    Eigen::VectorXd weights;    ///< per vertex: a third of its faces' area on the template, of sum 1

    /// The rows of these vertices, of points of all the template's vertices.
    Points of(const Points& points) const { return points(vertices, Eigen::all); }
};

/// The faces of which all corners are finite, on the template and on all specimens (as many points as the
/// template has vertices), and their vertices. Throws InputError where these are fewer than three.
CommonPart common_part(const TriangleMesh& first, const std::vector<Points>& specimens);

}  // namespace varimap
