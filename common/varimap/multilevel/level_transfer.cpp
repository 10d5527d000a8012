#include "varimap/multilevel/level_transfer.h"

namespace varimap {

namespace {

/// Mass-weighted mean, in the fine level's embedding, over each cell of a coarse level.
RowMatrix cell_means(const Level& level, const LevelSide& fine) {
    RowMatrix mean = RowMatrix::Zero(level.samples.size(), fine.vertex_points.cols());
    Eigen::VectorXd total = Eigen::VectorXd::Zero(level.samples.size());
    for (size_t v = 0; v < level.cell.size(); ++v) {
        mean.row(level.cell[v]) += fine.vertex_mass[v] * fine.vertex_points.row(v);
        total[level.cell[v]] += fine.vertex_mass[v];
    }
    return total.cwiseInverse().asDiagonal() * mean;
}

/// The members with W >= 0.7: about half of a Gaussian neighbourhood cut at 0.5. Euclidean neighbourhoods are
/// rich enough to let the support grow by these alone.
SparseMatrix nearer_half(const SparseMatrix& weights) {
    SparseMatrix near = weights;
    near.prune([](Eigen::Index, Eigen::Index, double w) { return w >= 0.7; });
    return near;
}

RowMatrix rows_of(const RowMatrix& matrix, const std::vector<int>& rows) {
    return matrix(rows, Eigen::all);
}

}  // namespace

LevelSide make_level_side(Level level, RowMatrix vertex_points, const Eigen::VectorXd& vertex_mass) {
    Side side;
    side.points = rows_of(vertex_points, level.samples);
    side.mass = level.mass;
    side.weights = level.weights;
    side.reach = level.kind == LevelKind::euclidean ? nearer_half(level.weights) : level.weights;
    side.averaging = averaging_operator(level.weights, level.mass);
    side.partner.assign(level.samples.size(), -1);
    return {std::move(level), std::move(vertex_points), vertex_mass, std::move(side)};
}

void set_landmarks(LevelPair& pair, const VertexPairs<MeshVertex>& landmarks, double weight) {
    pair.A.side.landmark_weight = pair.B.side.landmark_weight = weight;
    for (const auto& [a, b] : landmarks) {
        const int i = pair.A.level.cell[std::size_t(a.index)], j = pair.B.level.cell[std::size_t(b.index)];
        pair.A.side.partner[i] = j;
        pair.B.side.partner[j] = i;
    }
}

Start zero_start(const LevelPair& pair) {
    const RowMatrix &a = pair.A.side.points, &b = pair.B.side.points;
    Start start{{RowMatrix::Zero(a.rows(), b.cols()), RowMatrix::Zero(b.rows(), a.cols())}, {}};
    pull_landmarks(pair.A.side, pair.B.side, start.centres);
    return start;
}

LevelSwitch::LevelSwitch(const Level& coarse_A, const Level& coarse_B, const LevelPair& fine)
    : fine_(fine),
      coarse_mass_A_(coarse_A.mass),
      coarse_mass_B_(coarse_B.mass),
      parent_A_(parents(fine.A.level, coarse_A)),
      parent_B_(parents(fine.B.level, coarse_B)),
      means_A_(cell_means(coarse_A, fine.A)),
      means_B_(cell_means(coarse_B, fine.B)) {}

Start LevelSwitch::hand_down(const Coupling& coarse_plan, double support_threshold) const {
    Start start;
    start.centres.row = fine_.A.side.averaging * rows_of(row_barycentres(coarse_plan, means_B_), parent_A_);
    start.centres.column =
        fine_.B.side.averaging * rows_of(column_barycentres(coarse_plan, means_A_), parent_B_);
    pull_landmarks(fine_.A.side, fine_.B.side, start.centres);
    start.kept =
        inherited(significant_entries(coarse_plan, coarse_mass_A_, coarse_mass_B_, support_threshold),
                  parent_A_, parent_B_);
    return start;
}

Start hand_down(const Coupling& coarse_plan, const Level& coarse_A, const Level& coarse_B,
                const LevelPair& fine, double support_threshold) {
    return LevelSwitch(coarse_A, coarse_B, fine).hand_down(coarse_plan, support_threshold);
}

}  // namespace varimap
