#include "varimap/verification/map_degree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "varimap/core/parallel.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

constexpr int sample_count = 256;

/// Whether `p` lies to the left of the line from vertex a to b, seen along the third axis. Evaluated the same
/// way from both sides of an edge, so that every point is on one side of it only.
bool is_left(const TriangleMesh& mesh, int a, int b, const Vec3& p, double& doubled_area) {
    const int low = std::min(a, b), high = std::max(a, b);
    const double ux = mesh.vertices(low, 0) - p[0], uy = mesh.vertices(low, 1) - p[1];
    const double vx = mesh.vertices(high, 0) - p[0], vy = mesh.vertices(high, 1) - p[1];
    const double value = ux * vy - uy * vx;
    doubled_area = a < b ? value : -value;
    return (a < b) == (value > 0);
}

/// +1 or -1 if the ray from `p` along the third axis leaves or enters through the face, else 0.
int crossing(const TriangleMesh& mesh, int f, const Vec3& p) {
    const int a = mesh.faces(f, 0), b = mesh.faces(f, 1), c = mesh.faces(f, 2);
    double at_a, at_b, at_c;
    const bool left = is_left(mesh, b, c, p, at_a);
    if (is_left(mesh, c, a, p, at_b) != left || is_left(mesh, a, b, p, at_c) != left) return 0;
    const double height = at_a * (mesh.vertices(a, 2) - p[2]) + at_b * (mesh.vertices(b, 2) - p[2]) +
                          at_c * (mesh.vertices(c, 2) - p[2]);
    return left ? height > 0 : -(height < 0);
}

/// How often a closed mesh goes round points. A face counts for points that have its extent along the first
/// axis, so only those are asked: faces are listed by slabs across that axis.
class WindingNumber {
  public:
    explicit WindingNumber(const TriangleMesh& mesh)
        : mesh_(mesh), low_(mesh.vertices.col(0).minCoeff()), faces_(slab_count) {
        width_ = (mesh.vertices.col(0).maxCoeff() - low_) / slab_count;
        for (int f = 0; f < mesh.face_count(); ++f) {
            const auto [least, largest] =
                std::minmax({mesh.vertices(mesh.faces(f, 0), 0), mesh.vertices(mesh.faces(f, 1), 0),
                             mesh.vertices(mesh.faces(f, 2), 0)});
            for (int s = slab(least); s <= slab(largest); ++s) faces_[std::size_t(s)].push_back(f);
        }
    }
    int operator()(const Vec3& p) const {
        int sum = 0;
        for (const int f : faces_[std::size_t(slab(p[0]))]) sum += crossing(mesh_, f, p);
        return sum;
    }

  private:
    static constexpr int slab_count = 256;
    /// Rises with x, so that a face is listed wherever its points are.
    int slab(double x) const {
        return width_ > 0 ? int(std::clamp((x - low_) / width_, 0.0, slab_count - 1.0)) : 0;
    }
    const TriangleMesh& mesh_;
    double low_, width_;
    std::vector<std::vector<int>> faces_;
};

double mean_edge(const TriangleMesh& mesh) {
    double sum = 0;
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k)
            sum += (mesh.vertex(mesh.faces(f, k)) - mesh.vertex(mesh.faces(f, (k + 1) % 3))).norm();
    return sum / (3 * mesh.face_count());
}

/// Points spread evenly over a surface, the same ones every time (a low-discrepancy sequence within faces).
std::vector<SurfacePoint> spread_points(const TriangleMesh& mesh) {
    std::vector<SurfacePoint> points;
    const double total = surface_area(mesh);
    double passed = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        passed += face_normal(mesh, f).norm() / 2;
        while (int(points.size()) < sample_count &&
               (double(points.size()) + 0.5) / sample_count * total < passed) {
            const double i = double(points.size()) + 0.5;
            const double root = std::sqrt(i * 0.7548776662466927 - std::floor(i * 0.7548776662466927));
            const double v = i * 0.5698402909980532 - std::floor(i * 0.5698402909980532);
            points.push_back({f, Vec3(1 - root, root * (1 - v), root * v)});
        }
    }
    return points;
}

struct Ball {
    Vec3 centre;
    double radius;
};

/// A ball that touches the surface at `point` from the side of `inward` and holds none of it, almost as large
/// as there is. Not the largest, whose centre may be as far from many faces, which makes it slow to find.
Ball shrink_ball(const ClosestPoint& closest, const TriangleMesh& mesh, const Vec3& point, const Vec3& inward,
                 double radius) {
    constexpr double part = 0.8;
    for (int step = 0; step < 50; ++step) {
        const auto hit = closest(point + radius * inward);
        if (hit.squared_distance > radius * radius * (1 - 1e-6)) break;
        const Vec3 offset = position(mesh, hit.point) - point;
        const double through_both = offset.squaredNorm() / (2 * offset.dot(inward));
        radius = part * (through_both > 0 ? std::min(through_both, radius) : radius);
    }
    return {point + radius * inward, radius};
}

}  // namespace

std::optional<double> map_degree(const TriangleMesh& image, const TriangleMesh& target) {
    const auto [low, high] = bounding_box(target);
    const double inside = signed_volume(target, (low + high) / 2) < 0 ? 1 : -1,
                 thinnest = mean_edge(image) / 2;
    const ClosestPoint to_target(target), to_image(image);
    const WindingNumber around_image(image), around_target(target);
    const std::vector<SurfacePoint> samples = spread_points(target);
    std::vector<std::array<int, 2>> windings(samples.size(), {0, 0});  // of the image, of the target
    parallel_for_each_index(samples.size(), std::size_t(8), [&](std::size_t i) {
        const Vec3 inward = inside * face_normal(target, samples[i].face).stableNormalized();
        const Ball ball =
            shrink_ball(to_target, target, position(target, samples[i]), inward, (high - low).norm() / 2);
        if (ball.radius < thinnest) return;
        if (to_image(ball.centre).squared_distance < ball.radius * ball.radius / 4) return;
        windings[i] = {around_image(ball.centre), around_target(ball.centre)};
    });
    double sum = 0;
    int count = 0;
    for (const auto& [of_image, of_target] : windings) {
        if (of_target == 0) continue;
        sum += double(of_image) / of_target;
        ++count;
    }
    if (count == 0) return std::nullopt;
    return sum / count;
}

}  // namespace varimap
