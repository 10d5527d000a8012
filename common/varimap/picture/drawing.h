#pragma once

#include <string>

#include "varimap/core/linear_algebra.h"
#include "varimap/surface/domain.h"

namespace varimap {

/// Colours, one per row: red, green and blue from 0 to 1.
using Colours = RowMatrix;

/// Directions to the right, up, and towards the viewer (columns). What lies in the plane of x and y is seen
/// as it is, all else from where it is broadest.
Eigen::Matrix3d viewing_axes(const Points& points);

/// Colours by place: along a curve those of the rainbow, else one for each of the first three directions.
Colours colours_by_place(const Domain& domain);
/// From pale grey at 0 or below to deep red at 1 or above.
Colours colours_by_value(const Eigen::VectorXd& values);

/// Maps the box around points seen along viewing_axes onto a square panel, keeping proportions.
class Frame {
  public:
    /// `column`: of the panel, from 0.
    Frame(const Points& seen, int column);
    Eigen::Array2d operator()(const Eigen::RowVector3d& point) const;

  private:
    Eigen::Array2d low_, pixels_low_;
    double scale_;
};

/// An SVG of square panels beside each other, drawn from the back to the front.
class Drawing {
  public:
    /// Edges and points; of a surface the faces that look at the viewer, the nearest last, shaded.
    void domain(const Domain& domain, const Colours& colours, const Points& seen, const Frame& frame);
    /// A white surface with its edges as wires.
    void wires(const TriangleMesh& mesh, const Points& seen, const Frame& frame);
    void dot(const Eigen::RowVector3d& point, double radius, const std::string& colour, const Frame& frame);
    void line(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const std::string& colour,
              double width, const Frame& frame);
    void label(int column, const std::string& text);
    std::string svg(int columns) const;

  private:
    void faces(const TriangleMesh& seen, const Colours* colours, const Frame& frame);
    std::string text_;
};

}  // namespace varimap
