#include "varimap/mesh/interpolation.h"

namespace varimap {

Points positions(const TriangleMesh& mesh, const PointMap& points) {
    return pulled_back(mesh.vertices, mesh, points);
}

Points image_positions(const PointMap& map, const TriangleMesh& target, const Points& fallback) {
    Points positions = fallback;
    for (std::size_t i = 0; i < map.size(); ++i)
        if (map[i].face >= 0) positions.row(Eigen::Index(i)) = position(target, map[i]).transpose();
    return positions;
}

StraightImage straight_image(const SurfacePoint& point, const PointMap& map, const TriangleMesh& source,
                             const TriangleMesh& target) {
    return straight_image(point, source, target, [&](int v) { return map[std::size_t(v)]; });
}

}  // namespace varimap
