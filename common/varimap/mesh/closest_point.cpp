#include "varimap/mesh/closest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "varimap/mesh/private/embree_scene.h"

namespace varimap {

double closest_on_segment(const Vec3& query, const Vec3& a, const Vec3& b) {
    const Vec3 ab = b - a;
    const double length = ab.squaredNorm(), t = (query - a).dot(ab);
    return t <= 0 || length <= 0 ? 0 : std::min(1.0, t / length);
}

namespace {

/// Barycentric coordinates of q's projection onto the plane; all -1 if rounding leaves the triangle none.
Vec3 project_to_plane(const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = (b - a).cross(c - a);
    const double squared = normal.squaredNorm();
    constexpr double least = 1e-20;  // squared sine of the angle at a
    if (!(squared > least * (b - a).squaredNorm() * (c - a).squaredNorm())) return Vec3::Constant(-1);
    const double v = (q - a).cross(c - a).dot(normal) / squared;
    const double w = (b - a).cross(q - a).dot(normal) / squared;
    return Vec3(1 - v - w, v, w);
}

}  // namespace

// A point inside the triangle competes with the closest points of the sides that it does not lie well inside
// of by the distance that is really reached, so needles need no case of their own.
Vec3 closest_barycentric(const Vec3& query, const Vec3& a, const Vec3& b, const Vec3& c) {
    constexpr double well_inside = 1e-3;
    const std::array<Vec3, 3> corner{a, b, c};
    Vec3 best = Vec3::UnitX();
    double least = std::numeric_limits<double>::infinity();
    const auto offer = [&](const Vec3& candidate) {
        const double d = (candidate[0] * a + candidate[1] * b + candidate[2] * c - query).squaredNorm();
        if (d < least) {
            least = d;
            best = candidate;
        }
    };
    const Vec3 inside = project_to_plane(query, a, b, c);
    if (inside.minCoeff() >= 0) offer(inside);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (inside[(i + 2) % 3] > well_inside) continue;  // that side does not face the query
        Vec3 on_side = Vec3::Zero();
        on_side[j] = closest_on_segment(query, corner[i], corner[j]);
        on_side[i] = 1 - on_side[j];
        offer(on_side);
    }
    return best;
}

namespace {

/// The bits of a number below 2^16, with two zeros before each.
std::uint64_t spread_bits(std::uint64_t x) {
    x = (x | x << 16) & 0x0000ff0000ffull;
    x = (x | x << 8) & 0x00f00f00f00full;
    x = (x | x << 4) & 0x0c30c30c30c3ull;
    return (x | x << 2) & 0x249249249249ull;
}

/// Faces along a Morton curve, so that those beside each other in space are so in memory.
std::vector<int> along_a_curve(const TriangleMesh& mesh, const Vec3& low, double scale) {
    std::vector<std::pair<std::uint64_t, int>> keys(std::size_t(mesh.face_count()));
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Vec3 middle =
            position(mesh, {f, Vec3::Constant(1.0 / 3)}).cwiseMax(low) - low;  // not below, by rounding
        std::uint64_t key = 0;
        for (int i = 0; i < 3; ++i) {
            const double share = middle[i] * scale;
            key |= spread_bits(share < 1 ? std::uint64_t(share * 65535) : 65535) << i;
        }
        keys[std::size_t(f)] = {key, f};
    }
    std::sort(keys.begin(), keys.end());
    std::vector<int> order;
    order.reserve(keys.size());
    for (const auto& [key, f] : keys) order.push_back(f);
    return order;
}

/// The faces in that order, and the vertices that they use in the order in which they do.
TriangleMesh in_order(const TriangleMesh& mesh, const std::vector<int>& order) {
    TriangleMesh result{{}, Faces(Eigen::Index(order.size()), 3)};
    std::vector<int> number(std::size_t(mesh.vertex_count()), -1), used;
    for (std::size_t i = 0; i < order.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            int& n = number[std::size_t(mesh.faces(order[i], k))];
            if (n < 0) {
                n = int(used.size());
                used.push_back(mesh.faces(order[i], k));
            }
            result.faces(Eigen::Index(i), k) = n;
        }
    result.vertices = mesh.vertices(used, Eigen::all);
    return result;
}

}  // namespace

struct ClosestPoint::State {
    State(const TriangleMesh& whole, const Box& box);

    Vec3 centre;
    double scale;              ///< Embree sees (x - centre) * scale, within the unit cube
    std::vector<int> given;    ///< per face the number it was given with
    TriangleMesh mesh;         ///< its faces along a curve
    std::vector<int> present;  ///< the other way: per face as given
    EmbreeScene scene;

    Hit search(const Vec3& asked, const Vec3* normal, int guess = -1) const;
};

namespace {

/// The factor that makes the longest side 1.
double to_unit_size(const Box& box) {
    const double extent = (box.high - box.low).maxCoeff();
    return extent > 0 ? 1 / extent : 1;
}

std::vector<int> inverse(const std::vector<int>& permutation) {
    std::vector<int> result(permutation.size());
    for (std::size_t i = 0; i < permutation.size(); ++i) result[std::size_t(permutation[i])] = int(i);
    return result;
}

}  // namespace

ClosestPoint::State::State(const TriangleMesh& whole, const Box& box)
    : centre(0.5 * (box.low + box.high)),
      scale(to_unit_size(box)),
      given(along_a_curve(whole, box.low, scale)),
      mesh(in_order(whole, given)),
      present(inverse(given)),
      scene(mesh, centre, scale) {}

namespace {

struct Search {
    const TriangleMesh& mesh;
    const std::vector<int>& given;
    const Vec3& query;
    const Vec3* normal;
    double scale;
    double slack;  ///< bounds the error of Embree's single precision, in its units
    ClosestPoint::Hit best{{}, std::numeric_limits<double>::infinity()};  ///< its face as it was given
};

/// Whether the face's box is farther than the best point, beyond doubt.
bool is_beyond(const Search& search, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 below = a.cwiseMin(b).cwiseMin(c) - search.query,
               above = search.query - a.cwiseMax(b).cwiseMax(c);
    const double rounding = 1e-14 / search.scale;
    return below.cwiseMax(above).cwiseMax(0).squaredNorm() >
           search.best.squared_distance * (1 + 1e-9) + rounding * rounding;
}

/// Whether the face's plane is, beyond doubt; `normal`: (b - a) x (c - a). False for needles, whose normal
/// rounding may turn.
bool is_plane_beyond(const Search& search, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
    const double squared = normal.squaredNorm();
    if (!(squared > 1e-8 * (b - a).squaredNorm() * (c - a).squaredNorm())) return false;
    const Vec3 way = search.query - a;
    const double along = way.dot(normal);
    return along * along > squared * (search.best.squared_distance * (1 + 1e-6) + 1e-16 * way.squaredNorm());
}

/// Offers one face; true if it is the best so far.
bool offer(Search& search, int f) {
    const auto corners = search.mesh.faces.row(f);
    const Vec3 a = search.mesh.vertex(corners[0]), b = search.mesh.vertex(corners[1]),
               c = search.mesh.vertex(corners[2]);
    if (is_beyond(search, a, b, c)) return false;
    const Vec3 normal = (b - a).cross(c - a);
    if (search.normal && !(normal.dot(*search.normal) > 0)) return false;
    if (is_plane_beyond(search, a, b, c, normal)) return false;
    const Vec3 at = closest_barycentric(search.query, a, b, c);
    const double squared = (at[0] * a + at[1] * b + at[2] * c - search.query).squaredNorm();
    const int face = search.given[std::size_t(f)];
    ClosestPoint::Hit& best = search.best;
    if (squared > best.squared_distance || (squared == best.squared_distance && face >= best.point.face))
        return false;
    best = {{face, at}, squared};
    return true;
}

/// Slightly too large, so that no face as close as the best one is ever skipped: the result is then the same
/// for every order in which Embree may visit the boxes.
float radius(const Search& search) {
    return float(std::sqrt(search.best.squared_distance) * search.scale * (1 + 1e-5) + search.slack);
}

/// Called by Embree for every face whose box meets the ball of the current radius.
bool visit(RTCPointQueryFunctionArguments* arguments) {
    Search& search = *static_cast<Search*>(arguments->userPtr);
    if (!offer(search, int(arguments->primID)) || radius(search) >= arguments->query->radius) return false;
    arguments->query->radius = radius(search);
    return true;
}

}  // namespace

ClosestPoint::Hit ClosestPoint::State::search(const Vec3& asked, const Vec3* normal, int guess) const {
    constexpr double far = 1e6;  // squared distances stay numbers, in single precision too
    const Vec3 place = (asked - centre) * scale, local = place.cwiseMax(-far).cwiseMin(far);
    const Vec3 query = local == place ? asked : Vec3(centre + local / scale);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    Search search{mesh, given, query, normal, scale, 1e-6 * (1 + local.cwiseAbs().maxCoeff())};
    if (guess >= 0) offer(search, present[std::size_t(guess)]);
    RTCPointQuery ball{float(local[0]), float(local[1]), float(local[2]), 0, radius(search)};
    rtcPointQuery(scene.get(), &ball, &context, visit, &search);
    return search.best;
}

ClosestPoint::ClosestPoint(const TriangleMesh& mesh)
    : state_(std::make_unique<State>(mesh, bounding_box(mesh))) {}
ClosestPoint::~ClosestPoint() = default;
ClosestPoint::ClosestPoint(ClosestPoint&&) noexcept = default;

ClosestPoint::Hit ClosestPoint::operator()(const Vec3& query, int guess) const {
    return state_->search(query, nullptr, guess);
}

ClosestPoint::Hit ClosestPoint::operator()(const Vec3& query, const Vec3& normal, int guess) const {
    const Hit hit = state_->search(query, &normal, guess);
    return hit.point.face >= 0 ? hit : state_->search(query, nullptr, guess);
}

}  // namespace varimap
