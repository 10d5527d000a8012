#include "varimap/multilevel/level_transfer.h"

#include "varimap/spectral/neighbourhoods.h"

namespace varimap {

namespace {

RowMatrix rows_of(const RowMatrix& matrix, const std::vector<int>& rows) {
    return matrix(rows, Eigen::all);
}

}  // namespace

LevelSide make_level_side(Level level, RowMatrix vertex_points, const Eigen::VectorXd& vertex_mass,
                          double truncation) {
    Side side;
    side.points = rows_of(vertex_points, level.samples);
    side.mass = level.mass;
    side.weights = level.weights;
    // Euclidean neighbourhoods are rich enough to let the support grow by their nearer members alone.
    side.neighbours =
        level.kind == LevelKind::euclidean ? nearer_part(level.weights, truncation) : level.weights;
    side.averaging = {level.weights, level.mass};
    return {std::move(level), std::move(vertex_points), vertex_mass, truncation, std::move(side)};
}

Partners partners_at(const LevelPair& pair, const VertexPairs<MeshVertex>& landmarks, double weight) {
    Partners partners{std::vector<int>(pair.A.level.samples.size(), -1),
                      std::vector<int>(pair.B.level.samples.size(), -1), weight};
    for (const auto& [a, b] : landmarks) {
        const int i = pair.A.level.cell[size_t(a.index)], j = pair.B.level.cell[size_t(b.index)];
        partners.row[size_t(i)] = j;
        partners.column[size_t(j)] = i;
    }
    return partners;
}

Start zero_start(const LevelPair& pair) {
    const RowMatrix &a = pair.A.side.points, &b = pair.B.side.points;
    return {{RowMatrix::Zero(a.rows(), b.cols()), RowMatrix::Zero(b.rows(), a.cols())}, {}};
}

LevelSwitch::LevelSwitch(const Level& coarse_A, const Level& coarse_B, const LevelPair& fine)
    : fine_(fine),
      coarse_mass_A_(coarse_A.mass),
      coarse_mass_B_(coarse_B.mass),
      parent_A_(parents(fine.A.level, coarse_A)),
      parent_B_(parents(fine.B.level, coarse_B)),
      means_A_(cell_means(coarse_A, fine.A.vertex_mass, fine.A.vertex_points)),
      means_B_(cell_means(coarse_B, fine.B.vertex_mass, fine.B.vertex_points)) {}

Start LevelSwitch::hand_down(const Coupling& coarse_plan, double support_threshold) const {
    Start start;
    start.centres.row = fine_.A.side.averaging.P * rows_of(row_barycentres(coarse_plan, means_B_), parent_A_);
    start.centres.column =
        fine_.B.side.averaging.P * rows_of(column_barycentres(coarse_plan, means_A_), parent_B_);
    start.kept =
        inherited(significant_entries(coarse_plan, coarse_mass_A_, coarse_mass_B_, support_threshold),
                  parent_A_, parent_B_);
    return start;
}

}  // namespace varimap
