#include "stages/explore/bending_agreement.h"

#include <algorithm>
#include <cmath>

namespace varimap {

namespace {

/// Values at quantiles 5% and 95% take the place of those beyond.
Eigen::VectorXd clipped(Eigen::VectorXd values) {
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const std::size_t twentieth = sorted.size() / 20;
    return values.cwiseMax(sorted[twentieth]).cwiseMin(sorted[sorted.size() - 1 - twentieth]);
}

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& mass) {
    const Eigen::ArrayXd x = a.array() - mass.dot(a), y = b.array() - mass.dot(b);
    const double product = (mass.array() * x * y).sum();
    const double scale = std::sqrt((mass.array() * x * x).sum() * (mass.array() * y * y).sum());
    return scale > 0 ? product / scale : 0;
}

double agreement(const LevelSide& from, const Eigen::VectorXd& here, const Eigen::VectorXd& there,
                 const std::vector<int>& image) {
    return correlation(clipped(here(from.level.samples)), clipped(there(image)), from.side.mass);
}

}  // namespace

double bending_agreement(const LevelPair& pair, const Eigen::VectorXd& bending_A,
                         const Eigen::VectorXd& bending_B, const PairOrientation& map) {
    if (map.A_to_B.image_vertex.empty()) return 0;  // too few samples for images
    return (agreement(pair.A, bending_A, bending_B, map.A_to_B.image_vertex) +
            agreement(pair.B, bending_B, bending_A, map.B_to_A.image_vertex)) /
           2;
}

}  // namespace varimap
