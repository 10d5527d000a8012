#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Shapes of corresponding points laid over each other (generalised Procrustes analysis, Gower 1975).
struct Alignment {
    std::vector<Points> shapes;  ///< moved, turned and, if asked, scaled to the mean of all sizes
    /// Their average; where they are scaled, enlarged about its centroid to their size, so that of all shapes
    /// of that size it has the least sum of squared distances from them (the partial Procrustes mean).
    Points mean;
    std::vector<double> sizes;      ///< of the shapes given: root mean square distance from the centroid
    std::vector<double> distances;  ///< from each aligned shape to the mean: root mean square
};

/// Each mean is over `weights` (positive, of sum 1; areas make it independent of the tessellation). The
/// result lies over `start`, points in the same order, at which the iteration also begins. Turned, never
/// mirrored. At least one shape, at least three points that are not all on a line, all finite.
Alignment procrustes(const std::vector<Points>& shapes, const Points& start, const Eigen::VectorXd& weights,
                     bool scale);

/// Root mean square distance from the centroid.
double size_about_centroid(const Points& points, const Eigen::VectorXd& weights);

/// Points laid over others, as `procrustes` lays shapes over their mean.
struct LaidOver {
    Points shape;       ///< moved, turned and, if asked, scaled to the size of what they are laid over
    double size_ratio;  ///< of the points given, beside that
    double distance;    ///< root mean square
};
LaidOver laid_over(const Points& points, const Points& onto, const Eigen::VectorXd& weights, bool scale);

/// Principal components of aligned shapes: the eigenvectors of their covariance, weighted as the alignment
/// is, about their average.
struct PrincipalComponents {
    Eigen::VectorXd variance;          ///< of the scores on each, largest first, in squared units of length
    double total_variance = 0;         ///< of all components, those left out too
    Eigen::MatrixXd scores;            ///< a row for each shape, a column for each component
    std::vector<Points> displacement;  ///< of every point, for one standard deviation
};

/// At most `count`, and one less than there are shapes; none for a single shape. Of the two signs, the one in
/// which the score of largest magnitude is positive.
PrincipalComponents principal_components(const Alignment& alignment, const Eigen::VectorXd& weights,
                                         int count);

/// Which of these are farther above the median than three times 1.4826 times the median absolute deviation,
/// three standard deviations if they were normal, and than `resolution`; none of fewer than five.
std::vector<bool> outliers(const std::vector<double>& distances, double resolution);

}  // namespace varimap
