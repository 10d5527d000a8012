#include "stages/locate/starts.h"

#include <cmath>

#include "varimap/core/rotation.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/geodesic_graph.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

RowMatrix distances(const TriangleMesh& mesh, const std::vector<int>& landmarks) {
    return distances_from_each(GeodesicGraph(mesh), landmarks).transpose();
}

/// The row that is most like x; differences count relative to the distance.
int most_alike(const Eigen::RowVectorXd& x, const RowMatrix& rows) {
    constexpr double least = 0.1;
    const Eigen::RowVectorXd weight = (x.array() + least).inverse();
    int best;
    ((rows.rowwise() - x) * weight.asDiagonal()).rowwise().squaredNorm().minCoeff(&best);
    return best;
}

}  // namespace

LandmarkDistances::LandmarkDistances(const Sides& sides, double share)
    : part_(std::sqrt(share) * distances(sides.part.mesh, sides.landmarks_part)),
      whole_(distances(sides.whole.mesh, sides.landmarks_whole)) {}

Matching LandmarkDistances::matching(const LevelPair& pair, PartSide which) const {
    const RowMatrix &of_A = which == PartSide::source ? part_ : whole_,
                    &of_B = which == PartSide::source ? whole_ : part_;
    const RowMatrix a = of_A(pair.A.level.samples, Eigen::all), b = of_B(pair.B.level.samples, Eigen::all);
    Matching matching;
    for (int i = 0; i < a.rows(); ++i) matching.emplace_back(i, most_alike(a.row(i), b));
    for (int j = 0; j < b.rows(); ++j) matching.emplace_back(most_alike(b.row(j), a), j);
    return matching;
}

PointMap LandmarkDistances::images(const TriangleMesh& whole) const {
    const PointMap vertices = points_at_vertices(whole);
    PointMap images;
    for (int v = 0; v < part_.rows(); ++v)
        images.push_back(vertices[std::size_t(most_alike(part_.row(v), whole_))]);
    return images;
}

PointMap rigid_images(const Sides& sides, double share) {
    const TriangleMesh &part = sides.part.mesh, &whole = sides.whole.mesh;
    const Points from = std::sqrt(share) * part.vertices(sides.landmarks_part, Eigen::all),
                 to = whole.vertices(sides.landmarks_whole, Eigen::all);
    const Eigen::RowVector3d from_mean = from.colwise().mean(), to_mean = to.colwise().mean();
    const Eigen::Matrix3d rotation = nearest_rotation(
        (to.rowwise() - to_mean).transpose() * (from.rowwise() - from_mean), sides.are_opposed());
    TriangleMesh moved = part;
    moved.vertices = ((std::sqrt(share) * part.vertices).rowwise() - from_mean) * rotation.transpose();
    moved.vertices.rowwise() += to_mean;
    const Points normals = vertex_normals(moved);
    const ClosestPoint closest(whole);
    PointMap images;
    for (int v = 0; v < moved.vertex_count(); ++v)
        images.push_back(closest(moved.vertex(v), normals.row(v).transpose()).point);
    return images;
}

}  // namespace varimap
