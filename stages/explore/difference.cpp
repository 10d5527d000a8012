#include "stages/explore/difference.h"

namespace varimap {

double share_elsewhere(const Points& a, const Points& b, const Surface& from, double elsewhere) {
    double share = 0;
    for (Eigen::Index v = 0; v < a.rows(); ++v)
        if ((a.row(v) - b.row(v)).norm() > elsewhere) share += from.mass[v];
    return share;
}

double difference(const VertexImages& a, const VertexImages& b, const Surface& A, const Surface& B) {
    constexpr double elsewhere = 0.15;  // units of sqrt(area); chosen by hand, not swept
    const auto at = [](const Surface& to, const std::vector<int>& images) {
        return Points(to.mesh.vertices(images, Eigen::all));
    };
    return (share_elsewhere(at(B, a.A_to_B), at(B, b.A_to_B), A, elsewhere) +
            share_elsewhere(at(A, a.B_to_A), at(A, b.B_to_A), B, elsewhere)) /
           2;
}

}  // namespace varimap
