#include "stages/transfer/shape.h"

#include <Eigen/SVD>
#include <cmath>
#include <vector>

#include "varimap/core/parallel.h"
#include "varimap/core/rotation.h"
#include "varimap/mesh/topology.h"
#include "varimap/results/surface_map.h"

namespace varimap {

namespace {

using Frame = Eigen::Matrix3d;
constexpr int smoothing_rounds = 5;

/// Sums that the best similarity at a vertex follows from.
struct Moments {
    Frame covariance = Frame::Zero();
    double from = 0, to = 0;  ///< sums of squared lengths
};

Moments moments_at(int v, const Points& images, const Correspondence& map, const Adjacency& neighbours,
                   const Points& from_normals, const Points& to_normals) {
    Moments sums;
    for (const int w : neighbours[v]) {
        if (map.back[std::size_t(w)].face < 0) continue;
        const Vec3 source = (images.row(w) - images.row(v)).transpose();
        const Vec3 target = (map.to.vertices.row(w) - map.to.vertices.row(v)).transpose();
        sums.covariance += target * source.transpose();
        sums.from += source.squaredNorm();
        sums.to += target.squaredNorm();
    }
    // Normals count as one more neighbour at a mean distance: they settle what a flat fan leaves open.
    const double weight = std::sqrt(sums.from * sums.to) / std::max(1, int(neighbours[v].size()));
    sums.covariance += weight * to_normals.row(v).transpose() * from_normals.row(v);
    return sums;
}

/// Normals of `map.from` at the images.
Points normals_at_images(const Correspondence& map) {
    const TriangleMesh normals{vertex_normals(map.from), map.from.faces};
    Points result = image_positions(map.back, normals, Points::Zero(map.to.vertex_count(), 3));
    for (auto normal : result.rowwise())
        if (normal.norm() > 0) normal.normalize();
    return result;
}

/// The orthogonal matrix nearest to the covariance, of that sign, times the scale.
Frame similarity(const Moments& sums, bool mirrored) {
    if (!(sums.from > 0)) return Frame::Zero();
    return std::sqrt(sums.to / sums.from) * nearest_rotation(sums.covariance, mirrored);
}

std::vector<Frame> smoothed(const std::vector<Frame>& frames, const Adjacency& neighbours) {
    std::vector<Frame> result = frames;
    parallel_for_each_index(int(frames.size()), 512, [&](int v) {
        int count = 1;
        for (const int w : neighbours[v])
            if (!frames[std::size_t(w)].isZero(0)) result[std::size_t(v)] += frames[std::size_t(w)], ++count;
        result[std::size_t(v)] /= count;
    });
    return result;
}

std::vector<Frame> frames_of(const Correspondence& map) {
    const Adjacency neighbours = vertex_neighbours(map.to);
    const Points images = image_positions(map.back, map.from, Points::Zero(map.to.vertex_count(), 3));
    const Points from_normals = normals_at_images(map), to_normals = vertex_normals(map.to);
    std::vector<Moments> moments(std::size_t(map.to.vertex_count()));
    parallel_for_each_index(map.to.vertex_count(), 512, [&](int v) {
        if (map.back[std::size_t(v)].face >= 0)
            moments[std::size_t(v)] = moments_at(v, images, map, neighbours, from_normals, to_normals);
    });
    int reflecting = 0;
    for (const Moments& sums : moments) reflecting += sums.covariance.determinant() < 0 ? 1 : -1;
    std::vector<Frame> frames(moments.size());
    parallel_for_each_index(int(frames.size()), 512, [&](int v) {
        frames[std::size_t(v)] = similarity(moments[std::size_t(v)], reflecting > 0);
    });
    for (int round = 0; round < smoothing_rounds; ++round) frames = smoothed(frames, neighbours);
    return frames;
}

}  // namespace

Points carry_shape(const Correspondence& map, const Points& shape) {
    const std::vector<Frame> frames = frames_of(map);
    const TriangleMesh displacements{shape - map.from.vertices, map.from.faces};
    Points moved = map.to.vertices;
    for (int v = 0; v < map.to.vertex_count(); ++v) {
        const SurfacePoint& image = map.back[std::size_t(v)];
        if (image.face >= 0)
            moved.row(v) += (frames[std::size_t(v)] * position(displacements, image)).transpose();
    }
    return moved;
}

Points carried_vertices(const Correspondence& map) {
    const Box from = bounding_box(map.from), to = bounding_box(map.to);
    const double scale = std::sqrt(surface_area(map.to) / surface_area(map.from));
    Points fallback = map.from.vertices;
    fallback.rowwise() -= ((from.low + from.high) / 2).transpose();
    fallback *= scale;
    fallback.rowwise() += ((to.low + to.high) / 2).transpose();
    return image_positions(map.there, map.to, fallback);
}

}  // namespace varimap
