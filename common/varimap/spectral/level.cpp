#include "varimap/spectral/level.h"

namespace varimap {

std::vector<int> parents(const Level& fine, const Level& coarse) {
    std::vector<int> parent(fine.samples.size());
    for (size_t i = 0; i < parent.size(); ++i) parent[i] = coarse.cell[fine.samples[i]];
    return parent;
}

std::vector<int> samples_with(const Level& level, const std::vector<int>& vertices) {
    std::vector<int> samples = level.samples;
    for (int v : vertices)
        if (level.samples[level.cell[v]] != v) samples.push_back(v);
    return samples;
}

RowMatrix cell_means(const Level& level, const Eigen::VectorXd& vertex_mass, const RowMatrix& values) {
    RowMatrix sums = RowMatrix::Zero(level.samples.size(), values.cols());
    for (size_t v = 0; v < level.cell.size(); ++v) sums.row(level.cell[v]) += vertex_mass[v] * values.row(v);
    return level.mass.cwiseInverse().asDiagonal() * sums;
}

}  // namespace varimap
