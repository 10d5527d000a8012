#include "common/known_pair.h"

#include <algorithm>

#include "common/surface_data.h"
#include "stages/preprocess/preprocess.h"

namespace varimap::shapes {

namespace {

/// A surface's vertices in the coordinates of its input.
Points in_input_coordinates(const Surface& surface) {
    return (surface.mesh.vertices / surface.scale).rowwise() + surface.centre.transpose();
}

/// Points given in the coordinates of a surface's input, in those of its mesh.
Points on_mesh(const Surface& surface, const Points& points) {
    return (points.rowwise() - surface.centre.transpose()) * surface.scale;
}

template <class Map>
Points mapped(Points points, const Map& map) {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        points.row(i) = map(points.row(i).transpose()).transpose();
    return points;
}

}  // namespace

int nearest_vertex(const TriangleMesh& mesh, const Vec3& point) {
    int nearest;
    (mesh.vertices.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    return nearest;
}

KnownPair known_pair(const TriangleMesh& rest, const TriangleMesh& other, const Pose& pose, int eigenpairs,
                     const std::vector<Vec3>& landmarks) {
    KnownPair pair{surface_data(preprocess(rest, {}), eigenpairs),
                   surface_data(preprocess(pose(other), {}), eigenpairs),
                   {},
                   {},
                   {}};
    const Surface &A = pair.A.surface, &B = pair.B.surface;
    pair.A_on_B = on_mesh(B, mapped(in_input_coordinates(A), [&](const Vec3& p) { return pose.forward(p); }));
    pair.B_on_A = on_mesh(A, mapped(in_input_coordinates(B), [&](const Vec3& p) { return pose.inverse(p); }));
    for (const Vec3& p : landmarks) {
        const int a = nearest_vertex(A.mesh, on_mesh(A, p.transpose()).row(0).transpose());
        pair.landmarks.emplace_back(a, nearest_vertex(B.mesh, pair.A_on_B.row(a).transpose()));
    }
    return pair;
}

KnownPair figure_pair(double amount, bool with_landmarks) {
    std::vector<Vec3> landmarks;
    if (with_landmarks)
        landmarks = {{.75, .34, -1.38}, {.8, -.36, -1.58}, {-.9, .33, -1.25}, {-2.23, .1, .45}};
    return known_pair(figure(.15), figure(.15, .5), figure_pose(amount), 100, landmarks);
}

double mean_error(const PointMap& map, const TriangleMesh& target, const Points& truth) {
    double sum = 0;
    for (std::size_t v = 0; v < map.size(); ++v)
        sum += (position(target, map[v]) - truth.row(Eigen::Index(v)).transpose()).norm();
    return sum / double(map.size());
}

double mean_error(const Plan& plan, const KnownPair& pair) {
    const VertexMaps maps = read_out(plan, pair.A.surface, pair.B.surface);
    return std::max(mean_error(maps.A_to_B, pair.B.surface.mesh, pair.A_on_B),
                    mean_error(maps.B_to_A, pair.A.surface.mesh, pair.B_on_A));
}

}  // namespace varimap::shapes
