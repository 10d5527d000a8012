#include "stages/locate/starts.h"

#include <cmath>

#include "stages/locate/rigid_body.h"
#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/results/read_out.h"

namespace varimap {

namespace {

/// The row that is most like x; differences count relative to the distance.
int most_alike(const Eigen::RowVectorXd& x, const RowMatrix& rows) {
    constexpr double least = 0.1;
    const Eigen::RowVectorXd weight = (x.array() + least).inverse();
    int best;
    ((rows.rowwise() - x) * weight.asDiagonal()).rowwise().squaredNorm().minCoeff(&best);
    return best;
}

}  // namespace

PointMap images_alike_far(const RowMatrix& of_part, const RowMatrix& of_whole, const TriangleMesh& whole) {
    std::vector<int> vertices;
    for (Eigen::Index v = 0; v < of_part.rows(); ++v)
        vertices.push_back(most_alike(of_part.row(v), of_whole));
    return images_at(vertices, whole);
}

PointMap images_by_landmarks(const Sketches& sketches, const Sides& sides, double share) {
    return images_alike_far(
        std::sqrt(share) * distances_from_each(sketches.part.graph, sides.landmarks_part).transpose(),
        distances_from_each(sketches.whole.graph, sides.landmarks_whole).transpose(), sides.whole.mesh);
}

PointMap rigid_images(const Sides& sides, double share) {
    const RigidBody body(sides, share);
    const Points from = body.points()(sides.landmarks_part, Eigen::all),
                 to = sides.whole.mesh.vertices(sides.landmarks_whole, Eigen::all);
    return body.images(body.fitted(from, to, Eigen::VectorXd::Ones(from.rows())));
}

}  // namespace varimap
