#pragma once

#include <string>
#include <vector>

#include "varimap/results/correspondence.h"

namespace varimap {

/// What one template says of a specimen: the map from it there, and the map to it from the first template
/// (none for the first itself).
struct Answer {
    Correspondence map;
    PointMap from_first;
    double probability = 1;  ///< that the map is right, where it was chosen among several
};

/// Where the vertices of the first template lie on a specimen: per coordinate the median of the answers of
/// all templates (MALPACA, Zhang et al. 2022), then, where there are several, the closest point of the
/// specimen's surface. NaN where no answer has an image.
Points corresponding_points(const std::vector<Answer>& answers);

/// Landmarks on a specimen. With L of them:
struct TransferredLandmarks {
    Points positions;  ///< as corresponding_points
    Eigen::VectorXd
        round_trip;  ///< from a landmark to its image's image on the template, median of the templates
    Eigen::VectorXd spread;  ///< root mean square distance of the answers from `positions`; 0 of a single one
    /// 1 / (1 + (round_trip^2 + spread^2) / 0.02^2), lengths in units of sqrt(area), times the mean of the
    /// answers' probabilities: near 1 where all agree and are likely right. 0 where there is no image.
    Eigen::VectorXd confidence;
};
/// `landmarks`: per template, where they are on its surface; face -1 where a template does not have one.
TransferredLandmarks transfer_landmarks(const std::vector<Answer>& answers,
                                        const std::vector<PointMap>& landmarks);

}  // namespace varimap
