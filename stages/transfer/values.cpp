#include "stages/transfer/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "varimap/artifact/artifact.h"
#include "varimap/core/counted.h"
#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"

namespace varimap {

namespace {

constexpr double sum_tolerance = 1e-3;  ///< of weights; files may carry few digits
constexpr int grain = 256;

/// Rows of a table by how much each contributes.
struct Share {
    int row;
    double weight;
};
using Shares = std::vector<Share>;

/// The centroid and the middles of the six triangles around it: a seventh of the face each, nearly.
const std::array<Vec3, 7> inner_points = [] {
    std::array<Vec3, 7> points;
    points[0] = Vec3::Constant(1 / 3.);
    for (int k = 0; k < 3; ++k) {
        points[std::size_t(1 + k)] = Vec3::Constant(1 / 6.) + .5 * Vec3::Unit(k);
        points[std::size_t(4 + k)] = Vec3::Constant(5 / 12.) - .25 * Vec3::Unit(k);
    }
    return points;
}();

Shares shares_at(const SurfacePoint& point, Place place, const TriangleMesh& from) {
    if (point.face < 0) return {};
    if (place == Place::face) return {{point.face, 1}};
    Shares shares;
    for (int k = 0; k < 3; ++k)
        if (point.barycentric[k] > 0) shares.push_back({from.faces(point.face, k), point.barycentric[k]});
    return shares;
}

/// Rows that matter for row `row` of the other surface.
Shares shares_of(int row, Place place, const Correspondence& map, const PointCarrier& back) {
    if (place == Place::vertex) return shares_at(map.back[std::size_t(row)], place, map.from);
    Shares shares;
    for (const Vec3& inner : inner_points)
        for (const Share& share : shares_at(back({row, inner}), place, map.from)) shares.push_back(share);
    return shares;
}

/// Of the values that are numbers, where these have most of the shares; else none.
Eigen::RowVectorXd mixed(const Shares& shares, const Eigen::MatrixXd& values) {
    double total = 0;
    for (const Share& share : shares) total += share.weight;
    Eigen::RowVectorXd row(values.cols());
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
        double sum = 0, known = 0;
        for (const Share& share : shares)
            if (const double value = values(share.row, column); !std::isnan(value))
                sum += share.weight * value, known += share.weight;
        row[column] = known > total / 2 ? sum / known : std::numeric_limits<double>::quiet_NaN();
    }
    return row;
}

/// The row whose equals in these columns have the largest share; among equal shares the first.
int elected(const Shares& shares, const Eigen::Ref<const Eigen::MatrixXd>& values) {
    int best = -1;
    double most = -1;
    for (const Share& candidate : shares) {
        double votes = 0;
        for (const Share& share : shares)
            if (values.row(share.row) == values.row(candidate.row)) votes += share.weight;
        if (votes > most + 1e-12) most = votes, best = candidate.row;
    }
    return best;
}

Eigen::RowVectorXd elected_labels(const Shares& shares, const ValueTable& table) {
    Eigen::RowVectorXd row(table.values.cols());
    const std::vector<int> singly(std::size_t(row.size()), 1);
    Eigen::Index begin = 0;
    for (const int width : table.label_columns.empty() ? singly : table.label_columns) {
        const auto label = table.values.middleCols(begin, width);
        row.segment(begin, width) = label.row(elected(shares, label));
        begin += width;
    }
    return row;
}

void normalise_rows(Eigen::MatrixXd& weights) {
    for (auto row : weights.rowwise()) {
        const double sum = row.sum();
        if (sum > 0) row /= sum;
    }
}

/// Rows become shares. Programs write rows that do not sum to 1, and zeros where no bone moves a vertex.
void make_shares(ValueTable& table, const std::string& path) {
    int scaled = 0, empty = 0;
    for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
        auto row = table.values.row(i);
        const double sum = row.sum(), least = row.minCoeff();
        if (!(least >= 0) || !std::isfinite(sum))
            throw InputError(
                fmt::format("{}: row {} (from 0) holds {:.4g}; weights are numbers of at least 0; give other "
                            "values as --values",
                            path, i, least >= 0 ? row.maxCoeff() : least));
        if (std::abs(sum - 1) <= sum_tolerance) continue;
        ++(sum > 0 ? scaled : empty);
        if (sum > 0) row /= sum;
    }
    if (scaled > 0)
        warn("{}: {} to a sum of 1", path,
             counted(scaled, "row of weights is scaled", "rows of weights are scaled"));
    if (empty > 0)
        warn("{}: {} for nothing where the others are mixed", path,
             counted(empty, "row holds no weight, and counts", "rows hold no weight, and count"));
}

Place require_place(const ValueTable& table, const TriangleMesh& mesh, const std::string& mesh_file,
                    const std::string& path) {
    const Eigen::Index rows = table.values.rows();
    if (const auto place = place_of(std::size_t(rows), mesh, table.place)) return *place;
    throw InputError(
        fmt::format("{}: {} rows, but {} has {} vertices and {} triangles: these are values of another mesh, "
                    "or of polygons; give one for each vertex or triangle",
                    path, rows, mesh_file, mesh.vertex_count(), mesh.face_count()));
}

}  // namespace

std::optional<Place> place_of(std::size_t rows, const TriangleMesh& mesh, Place said) {
    const bool fits_vertices = rows == std::size_t(mesh.vertex_count()),
               fits_faces = rows == std::size_t(mesh.face_count());
    if (fits_vertices && fits_faces) return said;
    if (fits_vertices) return Place::vertex;
    if (fits_faces) return Place::face;
    return std::nullopt;
}

ValueTable carry_values(const ValueTable& table, ValueKind kind, const Correspondence& map,
                        const PointCarrier& back) {
    const int rows = table.place == Place::vertex ? map.to.vertex_count() : map.to.face_count();
    ValueTable carried{
        table.place,
        Eigen::MatrixXd::Constant(rows, table.values.cols(), std::numeric_limits<double>::quiet_NaN()),
        table.label_columns};
    parallel_for_each_index(rows, grain, [&](int row) {
        const Shares shares = shares_of(row, table.place, map, back);
        if (shares.empty()) return;
        carried.values.row(row) =
            kind == ValueKind::label ? elected_labels(shares, table) : mixed(shares, table.values);
    });
    if (kind == ValueKind::weight) normalise_rows(carried.values);
    return carried;
}

void keep_largest(Eigen::MatrixXd& weights, int count) {
    if (count >= weights.cols()) return;
    std::vector<int> order(std::size_t(weights.cols()));
    for (auto row : weights.rowwise()) {
        if (row.hasNaN()) continue;  // without an image
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return row[a] > row[b]; });
        for (std::size_t k = std::size_t(count); k < order.size(); ++k) row[order[k]] = 0;
    }
    normalise_rows(weights);
}

ValueFile read_values(const std::string& path, ValueKind kind, const TriangleMesh& mesh,
                      const std::string& mesh_file) {
    const std::string bytes = read_file(path);
    ValueFile file = has_ending(path, ".npy")   ? parse_npy_values(bytes, path, kind)
                     : has_ending(path, ".ply") ? parse_ply_values(bytes, path, kind, mesh, mesh_file)
                                                : parse_text_values(bytes, path, kind, mesh);
    for (ValueTable& table : file.tables) {
        table.place = require_place(table, mesh, mesh_file, path);
        if (!table.says_place && mesh.vertex_count() == mesh.face_count())
            warn(
                "{}: there are as many triangles as vertices, and these are taken for values of vertices; a "
                "table whose first column is called face and numbers its rows holds those of triangles",
                path);
        if (kind == ValueKind::weight) make_shares(table, path);
    }
    return file;
}

}  // namespace varimap
