#include "varimap/multilevel/matching.h"

#include <algorithm>

#include "varimap/mesh/face_geometry.h"
#include "varimap/surface/input_locator.h"

namespace varimap {

namespace {

class NearestCorner {
  public:
    explicit NearestCorner(const Surface& surface) : surface_(surface), locate_(surface) {}
    int operator()(const SurfacePoint& on_input) const {
        return nearest_vertex(surface_.mesh, locate_(on_input));
    }

  private:
    const Surface& surface_;
    MeshLocator locate_;
};

std::vector<std::pair<int, int>> at_corners(const PointPairs& pairs, const NearestCorner& from,
                                            const NearestCorner& to) {
    std::vector<std::pair<int, int>> vertices;
    for (const auto& [point, image] : pairs) vertices.emplace_back(from(point), to(image));
    // An input has many vertices near each one of its mesh: the first counts.
    const auto by_first = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::ranges::stable_sort(vertices, by_first);
    const auto repeated = std::ranges::unique(vertices, {}, [](const auto& pair) { return pair.first; });
    vertices.erase(repeated.begin(), repeated.end());
    return vertices;
}

/// Per sample the other side's sample, by the nearest of the pairs.
std::vector<int> partners(const std::vector<std::pair<int, int>>& pairs, const LevelSide& from,
                          const LevelSide& to) {
    RowMatrix ends(pairs.size(), from.vertex_points.cols());
    for (int k = 0; k < int(pairs.size()); ++k)
        ends.row(k) = from.vertex_points.row(pairs[std::size_t(k)].first);
    std::vector<int> result;
    for (const int sample : from.level.samples) {
        int nearest;
        (ends.rowwise() - from.vertex_points.row(sample)).rowwise().squaredNorm().minCoeff(&nearest);
        result.push_back(to.level.cell[std::size_t(pairs[std::size_t(nearest)].second)]);
    }
    return result;
}

Matching joined(const std::vector<int>& of_rows, const std::vector<int>& of_columns) {
    Matching matching;
    for (int i = 0; i < int(of_rows.size()); ++i) matching.emplace_back(i, of_rows[std::size_t(i)]);
    for (int j = 0; j < int(of_columns.size()); ++j) matching.emplace_back(of_columns[std::size_t(j)], j);
    return matching;
}

std::vector<int> cells_of_images(const std::vector<int>& images, const Level& from, const Level& to) {
    std::vector<int> cells;
    for (const int sample : from.samples) cells.push_back(to.cell[std::size_t(images[std::size_t(sample)])]);
    return cells;
}

}  // namespace

Centres centres_of(const LevelPair& pair, const Matching& matching) {
    const RowMatrix &a = pair.A.side.points, &b = pair.B.side.points;
    Centres centres{RowMatrix::Zero(a.rows(), b.cols()), RowMatrix::Zero(b.rows(), a.cols())};
    Eigen::VectorXd row_count = Eigen::VectorXd::Zero(a.rows()),
                    column_count = Eigen::VectorXd::Zero(b.rows());
    for (const auto& [i, j] : matching) {
        centres.row.row(i) += b.row(j);
        centres.column.row(j) += a.row(i);
        ++row_count[i];
        ++column_count[j];
    }
    centres.row = pair.A.side.averaging.P * RowMatrix(row_count.cwiseInverse().asDiagonal() * centres.row);
    centres.column =
        pair.B.side.averaging.P * RowMatrix(column_count.cwiseInverse().asDiagonal() * centres.column);
    return centres;
}

Matching matching_of(const VertexImages& images, const LevelPair& pair) {
    return joined(cells_of_images(images.A_to_B, pair.A.level, pair.B.level),
                  cells_of_images(images.B_to_A, pair.B.level, pair.A.level));
}

int first_level_for_a_map(const PairContext& context) {
    constexpr int enough = 60;  // chosen by hand, not swept
    int level = 0;
    while (level + 1 < context.diffusion_levels() && context.diffusion_sample_count(level) < enough) ++level;
    return level;
}

VertexCorrespondences at_vertices(const Correspondences& map, const Surface& A, const Surface& B) {
    const NearestCorner on_A(A), on_B(B);
    return {at_corners(map.from_A, on_A, on_B), at_corners(map.from_B, on_B, on_A)};
}

Matching matching_of(const VertexCorrespondences& map, const LevelPair& pair) {
    return joined(partners(map.from_A, pair.A, pair.B), partners(map.from_B, pair.B, pair.A));
}

}  // namespace varimap
