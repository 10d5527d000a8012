#include "stages/transfer/shape.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "varimap/core/parallel.h"
#include "varimap/core/rotation.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_repair/weld.h"

namespace varimap {

namespace {

using Frame = Eigen::Matrix3d;
constexpr int smoothing_rounds = 5;
constexpr std::size_t anchors_of_vertex = 32;                   ///< that a vertex without an image follows
constexpr std::size_t most_anchors = 10'000, most_asked = 200;  ///< of a mesh, and of a part: to save time

/// A mesh of a file as one surface: where vertices lie in the same place, or nearly, and have one image or
/// none, its faces meet at the lowest of them. Vertices and faces keep their numbers.
struct WeldedMesh {
    std::vector<int> vertex;  ///< per vertex: the one that faces have in its place
    TriangleMesh mesh;
};

/// The faces that name no vertex twice.
TriangleMesh without_degenerate_faces(const TriangleMesh& mesh) {
    std::vector<int> kept;
    for (int f = 0; f < mesh.face_count(); ++f)
        if (!repeats_vertex(mesh.faces, f)) kept.push_back(f);
    return {mesh.vertices, mesh.faces(kept, Eigen::all), mesh.space};
}

/// Images part what the map was made of as two, such as the rims of a slit that was left open.
WeldedMesh welded(const TriangleMesh& mesh, const PointMap& images) {
    std::vector<int> vertex = welded_vertices(without_degenerate_faces(mesh), 0);
    std::map<std::tuple<int, int, double, double>, int> lowest;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const auto& [face, at] = images[std::size_t(v)];
        int& own = vertex[std::size_t(v)];
        own = lowest.try_emplace({own, face, at[0], at[1]}, v).first->second;
    }
    TriangleMesh joined = mesh;
    for (int& corner : joined.faces.reshaped()) corner = vertex[std::size_t(corner)];
    return {std::move(vertex), std::move(joined)};
}

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

/// Vertices without a frame, as those without an image, do not count, and take the mean of their neighbours.
std::vector<Frame> smoothed(const std::vector<Frame>& frames, const Adjacency& neighbours) {
    std::vector<Frame> result = frames;
    parallel_for_each_index(int(frames.size()), 512, [&](int v) {
        int count = frames[std::size_t(v)].isZero(0) ? 0 : 1;
        for (const int w : neighbours[v])
            if (!frames[std::size_t(w)].isZero(0)) result[std::size_t(v)] += frames[std::size_t(w)], ++count;
        if (count > 1) result[std::size_t(v)] /= count;
    });
    return result;
}

/// Of the vertices that faces have.
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
    for (const Moments& sums : moments) {
        const double determinant = sums.covariance.determinant();
        reflecting += int(determinant < 0) - int(determinant > 0);
    }
    std::vector<Frame> frames(moments.size());
    parallel_for_each_index(int(frames.size()), 512, [&](int v) {
        frames[std::size_t(v)] = similarity(moments[std::size_t(v)], reflecting > 0);
    });
    for (int round = 0; round < smoothing_rounds; ++round) frames = smoothed(frames, neighbours);
    return frames;
}

std::vector<char> with_image(const PointMap& map) {
    std::vector<char> known;
    for (const SurfacePoint& image : map) known.push_back(image.face >= 0);
    return known;
}

/// Vertices, of those that are not known: in one list those that hang together without known ones.
std::vector<std::vector<int>> unknown_parts(const WeldedMesh& welded, const std::vector<char>& known) {
    const TriangleMesh& mesh = welded.mesh;
    std::vector<int> unknown_faces;
    for (int f = 0; f < mesh.face_count(); ++f)
        if (!known[std::size_t(mesh.faces(f, 0))] && !known[std::size_t(mesh.faces(f, 1))] &&
            !known[std::size_t(mesh.faces(f, 2))])
            unknown_faces.push_back(f);
    const std::vector<int> component =
        connected_components({mesh.vertices, mesh.faces(unknown_faces, Eigen::all)}).of_vertex;
    std::map<int, std::vector<int>> joined;  // by component; where faces join none, by vertex behind these
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (known[std::size_t(v)]) continue;
        const int own = welded.vertex[std::size_t(v)], number = component[std::size_t(own)];
        joined[number < 0 ? mesh.vertex_count() + own : number].push_back(v);
    }
    std::vector<std::vector<int>> parts;
    for (auto& [number, part] : joined) parts.push_back(std::move(part));
    return parts;
}

/// At most so many, evenly.
std::vector<int> thinned(const std::vector<int>& vertices, std::size_t most) {
    std::vector<int> kept;
    for (std::size_t i = 0; i < vertices.size(); i += 1 + (vertices.size() - 1) / most)
        kept.push_back(vertices[i]);
    return kept;
}

/// Of the known vertices, those nearest to v; fewer where there are not as many.
std::vector<int> nearest_known(int v, const Points& places, std::vector<int> known) {
    const std::size_t count = std::min(anchors_of_vertex, known.size());
    const auto nearer = [&](int a, int b) {
        return (places.row(a) - places.row(v)).squaredNorm() < (places.row(b) - places.row(v)).squaredNorm();
    };
    std::nth_element(known.begin(), known.begin() + std::ptrdiff_t(count), known.end(), nearer);
    known.resize(count);
    return known;
}

Vec3 mean_of(const Points& places, const std::vector<int>& vertices) {
    return places(vertices, Eigen::all).colwise().mean().transpose();
}

/// A similarity of space.
struct Motion {
    Vec3 from, to;
    Frame frame;
    Vec3 operator()(const Vec3& place) const { return to + frame * (place - from); }
};

/// That which takes these vertices nearest to their images.
Motion best_motion(const Points& places, const Points& images, const std::vector<int>& vertices,
                   bool mirrored) {
    const Vec3 from = mean_of(places, vertices), to = mean_of(images, vertices);
    Moments sums;
    for (const int v : vertices) {
        const Vec3 source = places.row(v).transpose() - from, target = images.row(v).transpose() - to;
        sums.covariance += target * source.transpose();
        sums.from += source.squaredNorm();
        sums.to += target.squaredNorm();
    }
    return {from, to, sums.from > 0 ? similarity(sums, mirrored) : Frame(Frame::Identity())};
}

/// Puts a part where the best similarity from anchors to their images takes it.
void move_part(const std::vector<int>& part, const std::vector<int>& anchors, const Points& places,
               bool mirrored, Points& images) {
    const Motion motion = best_motion(places, images, anchors, mirrored);
    for (const int v : part) images.row(v) = motion(places.row(v).transpose()).transpose();
}

/// Images of all vertices, of which those of the known ones are given.
Points follow_known(const WeldedMesh& welded, const std::vector<char>& known, bool mirrored, Points images) {
    const Points& places = welded.mesh.vertices;
    std::vector<int> choice;
    for (int v = 0; v < int(places.rows()); ++v)
        if (known[std::size_t(v)] && welded.vertex[std::size_t(v)] == v) choice.push_back(v);
    if (choice.empty()) return images;
    choice = thinned(choice, most_anchors);
    const auto parts = unknown_parts(welded, known);
    parallel_for_each_index(int(parts.size()), 1, [&](int p) {
        std::vector<int> anchors;
        for (const int v : thinned(parts[std::size_t(p)], most_asked))
            for (const int anchor : nearest_known(v, places, choice)) anchors.push_back(anchor);
        move_part(parts[std::size_t(p)], anchors, places, mirrored, images);
    });
    return images;
}

/// How another shape of a mesh lies to it, by the vertices that faces use.
class ShapeToMesh {
  public:
    ShapeToMesh(const TriangleMesh& mesh, const Points& shape)
        : mesh_(mesh),
          shape_(shape),
          used_(thinned(used_vertices(mesh.faces, mesh.vertex_count()).vertex, most_anchors)),
          size_(apart(mean_of(mesh.vertices, used_).transpose().replicate(shape.rows(), 1))) {}

    /// Whether the vertices lie about elsewhere, and none to speak of where they were: those at rest say that
    /// the others moved in the mesh's own axes and units.
    bool is_away() const {
        constexpr double much = 0.1;  // of the mesh's size; chosen by hand, as the others
        return apart() > much * size_ && share_at_rest(shape_) < 0.1;
    }
    /// The shape laid onto the mesh by the similarity, or that which mirrors, that takes half of the vertices
    /// nearest to their places: an expression leaves the most part at rest, and the others would spoil it.
    Points laid(bool mirrored) const {
        constexpr int most_rounds = 20;
        std::vector<int> fitted = used_;
        Points laid;
        for (int round = 0; round < most_rounds; ++round) {
            laid = moved(best_motion(shape_, mesh_.vertices, fitted, mirrored));
            std::vector<int> nearest = nearest_half(laid);
            if (nearest == fitted) break;
            fitted = std::move(nearest);
        }
        return laid;
    }
    bool is_mostly_at_rest(const Points& other) const { return share_at_rest(other) > 0.5; }
    double apart() const { return apart(shape_); }
    double apart(const Points& other) const {
        return (other(used_, Eigen::all) - mesh_.vertices(used_, Eigen::all)).norm();
    }

  private:
    double distance(const Points& other, int v) const {
        return (other.row(v) - mesh_.vertices.row(v)).norm();
    }
    double share_at_rest(const Points& other) const {
        const double rest = 1e-4 * size_ / std::sqrt(double(used_.size()));
        const auto count = std::ranges::count_if(used_, [&](int v) { return distance(other, v) <= rest; });
        return double(count) / double(used_.size());
    }
    Points moved(const Motion& motion) const {
        Points moved(shape_.rows(), 3);
        for (Eigen::Index v = 0; v < shape_.rows(); ++v)
            moved.row(v) = motion(shape_.row(v).transpose()).transpose();
        return moved;
    }
    std::vector<int> nearest_half(const Points& other) const {
        std::vector<int> half = used_;
        std::ranges::sort(half, {}, [&](int v) { return std::pair(distance(other, v), v); });
        half.resize((half.size() + 1) / 2);
        std::ranges::sort(half);
        return half;
    }

    const TriangleMesh& mesh_;
    const Points& shape_;
    std::vector<int> used_;
    double size_;  ///< root of the sum of squared distances from the centre
};

/// Of the displacements: what may be left of them where they are those of a motion.
constexpr double most_left = 0.5;

}  // namespace

std::optional<LaidShape> laid_onto(const TriangleMesh& mesh, const Points& shape) {
    const ShapeToMesh lie(mesh, shape);
    if (!lie.is_away()) return std::nullopt;
    Points laid = lie.laid(false);
    const bool is_mirrored =
        !lie.is_mostly_at_rest(laid) && lie.apart(lie.laid(true)) < most_left * lie.apart(laid);
    if (!is_mirrored && lie.apart(laid) >= most_left * lie.apart()) return std::nullopt;
    return LaidShape{std::move(laid), is_mirrored};
}

Points carry_shape(const Correspondence& map, const Points& shape) {
    const WeldedMesh from = welded(map.from, map.there), to = welded(map.to, map.back);
    const std::vector<Frame> frames =
        frames_of({map.from_file, map.to_file, from.mesh, to.mesh, map.there, map.back});
    const TriangleMesh displacements{shape - map.from.vertices, map.from.faces};
    Points moved = map.to.vertices;
    for (int v = 0; v < map.to.vertex_count(); ++v) {
        const SurfacePoint& image = map.back[std::size_t(v)];
        if (image.face < 0) continue;
        const Frame& frame = frames[std::size_t(to.vertex[std::size_t(v)])];
        moved.row(v) += (frame * position(displacements, image)).transpose();
    }
    return follow_known(to, with_image(map.back), false, moved);
}

Points carried_vertices(const Correspondence& map) {
    const Points images = image_positions(map.there, map.to, map.from.vertices);
    return follow_known(welded(map.from, map.there), with_image(map.there), reverses_orientation(map),
                        images);
}

bool reverses_orientation(const Correspondence& map) {
    const TriangleMesh carried{image_positions(map.there, map.to, map.from.vertices), map.from.faces};
    double front = 0;
    for (int f = 0; f < carried.face_count(); ++f) {
        Vec3 below = Vec3::Zero();  // the sum of the target's unit normals under the corners
        bool mapped = true;
        for (int k = 0; k < 3; ++k) {
            const int face = map.there[std::size_t(carried.faces(f, k))].face;
            mapped = mapped && face >= 0;
            if (mapped) below += face_normal(map.to, face).normalized();
        }
        if (mapped) front += face_normal(carried, f).dot(below);
    }
    return front < 0;
}

}  // namespace varimap
