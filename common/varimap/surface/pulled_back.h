#pragma once

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Values of a mesh's vertices, row by row, linear on its faces, at points of it, none of them nowhere.
template <class Values>
Values pulled_back(const Values& values, const TriangleMesh& mesh, const PointMap& points) {
    Values result(Eigen::Index(points.size()), values.cols());
    for (std::size_t v = 0; v < points.size(); ++v) {
        auto row = result.row(Eigen::Index(v));
        row.setZero();
        for (int k = 0; k < 3; ++k)
            row += points[v].barycentric[k] * values.row(mesh.faces(points[v].face, k));
    }
    return result;
}

/// Where points of a mesh, none of them nowhere, lie in space.
inline Points positions(const TriangleMesh& mesh, const PointMap& points) {
    return pulled_back(mesh.vertices, mesh, points);
}

/// The same of images on `target` that may be nowhere: there the rows of `fallback`.
inline Points image_positions(const PointMap& map, const TriangleMesh& target, const Points& fallback) {
    Points positions = fallback;
    for (std::size_t i = 0; i < map.size(); ++i)
        if (map[i].face >= 0) positions.row(Eigen::Index(i)) = position(target, map[i]).transpose();
    return positions;
}

}  // namespace varimap
