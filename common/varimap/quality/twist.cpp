#include "varimap/quality/twist.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "varimap/core/index_set.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/geodesic_graph.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh/unit_area.h"
#include "varimap/quality/image_mesh.h"
#include "varimap/quality/quality.h"

namespace varimap {

namespace {

// Chosen by hand on people and animals, with doubtful_twist (results/candidate.h).
constexpr double least_area = 0.15, least_explained = 0.25;
constexpr double ring_width = 0.06;  ///< or three long edges; units of sqrt(area)
constexpr double crumb = 2e-4;       ///< share of the area below which a component is no ring of its own

/// Of the longest edges of the triangles, by area.
double median_longest_edge(const TriangleMesh& mesh) {
    std::vector<double> longest, area;
    for (int f = 0; f < mesh.face_count(); ++f) {
        longest.push_back(longest_edge(mesh, f));
        area.push_back(face_normal(mesh, f).norm());
    }
    return weighted_quantile(longest, area, 0.5);
}

/// How far corner c of a triangle is from the source that is u_a and u_b from its other corners, if the way
/// straight on from there crosses the triangle; else infinite.
double across(const Vec3& a, const Vec3& b, const Vec3& c, double u_a, double u_b) {
    constexpr double never = std::numeric_limits<double>::infinity();
    const double side = (b - a).norm();
    if (!(side > 0)) return never;
    const Vec3 along = (b - a) / side;
    const double c_along = along.dot(c - a), c_off = (c - a - c_along * along).norm();
    const double along_side = (u_a * u_a - u_b * u_b + side * side) / (2 * side);
    const double off = std::sqrt(std::max(0.0, u_a * u_a - along_side * along_side));
    if (!(c_off + off > 0)) return never;
    const double crossing = along_side + (c_along - along_side) * off / (c_off + off);
    if (crossing < 0 || crossing > side) return never;
    return std::hypot(c_along - along_side, c_off + off);
}

/// Along edges; 0 on other components.
Eigen::VectorXd distances_from(const std::vector<int>& sources, const GeodesicGraph& graph) {
    Eigen::VectorXd distance = Eigen::VectorXd::Zero(graph.vertex_count());
    GeodesicBall(graph).grow(sources, [&](int vertex, double length) {
        distance[vertex] = length;
        return true;
    });
    return distance;
}

/// Of a mesh of unit area, from one of its ends: all that is about as far as can be from an end. Distances
/// from a single vertex, on one side of a shaft, would rise aslant along it; and lengths of paths along edges
/// do by 20 degrees here and there, so that they are made shorter straight across triangles, from near to
/// far.
Eigen::VectorXd distances_from_an_end(const TriangleMesh& mesh, double width) {
    const GeodesicGraph graph(mesh);
    int farthest = 0;
    distances_from({mesh.faces(0, 0)}, graph).maxCoeff(&farthest);
    Eigen::VectorXd u = distances_from({farthest}, graph);
    const double length = u.maxCoeff();
    std::vector<int> end;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (u[v] > length - width) end.push_back(v);
    u = distances_from(end, graph);
    std::vector<int> order = all_indices(mesh.face_count());
    std::vector<double> least;
    for (int f = 0; f < mesh.face_count(); ++f) least.push_back(u(mesh.faces.row(f)).minCoeff());
    std::stable_sort(order.begin(), order.end(),
                     [&](int f, int g) { return least[std::size_t(f)] < least[std::size_t(g)]; });
    constexpr int sweeps = 4;
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (const int f : order)
            for (int k = 0; k < 3; ++k) {
                const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3),
                          c = mesh.faces(f, (k + 2) % 3);
                u[c] = std::min(u[c], across(mesh.vertex(a), mesh.vertex(b), mesh.vertex(c), u[a], u[b]));
            }
    return u;
}

/// Of a triangle under the map, in the frame of the gradient e of u and of n x e.
struct Shear {
    double along;  ///< J e . J(n x e) / |J(n x e)|
    Vec3 around;   ///< J(n x e)
};
/// None where u hardly rises, or the triangle has no image.
std::optional<Shear> shear_of(const ImageMesh& images, const Eigen::VectorXd& u, int f) {
    constexpr double least_rise = 0.3;
    if (!images.is_mapped(f) || is_degenerate(images.source, f)) return {};
    const auto corners = images.source.faces.row(f);
    Eigen::Matrix<double, 3, 2> sides, image_sides;
    Eigen::Vector2d rise;
    for (int k : {0, 1}) {
        sides.col(k) = images.source.vertex(corners[k + 1]) - images.source.vertex(corners[0]);
        image_sides.col(k) = images.image.vertex(corners[k + 1]) - images.image.vertex(corners[0]);
        rise[k] = u[corners[k + 1]] - u[corners[0]];
    }
    const Vec3 gradient = sides * (sides.transpose() * sides).inverse() * rise;
    if (!(gradient.norm() > least_rise)) return {};
    Eigen::Matrix<double, 3, 2> frame;
    frame.col(0) = gradient.normalized();
    frame.col(1) = face_normal(images.source, f).normalized().cross(frame.col(0));
    const Eigen::Matrix<double, 3, 2> J = image_sides * (frame.transpose() * sides).inverse();
    const Vec3 around = J.col(1);
    if (!(around.norm() > 0)) return {};
    return Shear{J.col(0).dot(around) / around.norm(), around};
}

struct Ring {
    int band = 0, vertex = -1;
    double area = 0;
    double weight = 0, along = 0, along_squared = 0, around = 0;       ///< sums over areas
    double least = std::numeric_limits<double>::infinity(), most = 0;  ///< of u
    bool is_closed = true;
    std::vector<int> next, before;  ///< in the bands beside it; of no crumbs

    /// Of its image.
    double radius(double width) const {
        return weight > 0 ? around / weight * area / (2 * std::numbers::pi * width) : 0;
    }
    /// By which the map turns its ends against each other, in radians.
    double turn(double width) const {
        return weight > 0 && around > 0 ? along / weight * width / radius(width) : 0;
    }
};

/// Components of the bands of u.
class Rings {
  public:
    explicit Rings(const ImageMesh& images)
        : images_(images),
          edges_(find_edges(images.source)),
          width_(std::max(ring_width, 3 * median_longest_edge(images.source))),
          u_(distances_from_an_end(images.source, width_)) {
        std::vector<int> band;
        for (int f = 0; f < images.source.face_count(); ++f) band.push_back(int(mean_at(f) / width_));
        find(band);
        for (int f = 0; f < images.source.face_count(); ++f) add(f, band[std::size_t(f)]);
        join();
    }
    const std::vector<Ring>& all() const { return rings_; }
    const Ring& operator[](int ring) const { return rings_[std::size_t(ring)]; }
    int of_face(int f) const { return ring_of_[std::size_t(f)]; }
    double width() const { return width_; }
    /// Mean u of a face's corners.
    double mean_at(int f) const {
        const auto corners = images_.source.faces.row(f);
        return (u_[corners[0]] + u_[corners[1]] + u_[corners[2]]) / 3;
    }
    /// Of the image of the ring there: towards a tip, with no ring behind, the distance from it.
    double radius_at(int f) const {
        const Ring& ring = (*this)[of_face(f)];
        double radius = ring.radius(width_);
        if (ring.before.empty()) radius = std::min(radius, mean_at(f) - ring.least);
        if (ring.next.empty()) radius = std::min(radius, ring.most - mean_at(f));
        return radius;
    }
    std::optional<Shear> shear(int f) const { return shear_of(images_, u_, f); }

  private:
    /// Numbers the components.
    void find(const std::vector<int>& band) {
        ring_of_.assign(band.size(), -1);
        std::vector<int> ahead;
        int count = 0;
        for (std::size_t first = 0; first < band.size(); ++first) {
            if (ring_of_[first] >= 0) continue;
            ring_of_[first] = count;
            ahead.assign(1, int(first));
            while (!ahead.empty()) {
                const int f = ahead.back();
                ahead.pop_back();
                for (int k = 0; k < 3; ++k)
                    for (const int side : edges_.sides[edges_.of_side[std::size_t(3 * f + k)]]) {
                        const auto g = std::size_t(side / 3);
                        if (ring_of_[g] >= 0 || band[g] != band[std::size_t(f)]) continue;
                        ring_of_[g] = count;
                        ahead.push_back(int(g));
                    }
            }
            ++count;
        }
        rings_.resize(std::size_t(count));
    }
    void add(int f, int band) {
        Ring& ring = rings_[std::size_t(ring_of_[std::size_t(f)])];
        const double area = face_normal(images_.source, f).norm() / 2;
        ring.band = band;
        if (ring.vertex < 0) ring.vertex = images_.source.faces(f, 0);
        ring.area += area;
        for (const int v : images_.source.faces.row(f)) {
            ring.least = std::min(ring.least, u_[v]);
            ring.most = std::max(ring.most, u_[v]);
        }
        const std::optional<Shear> here = shear(f);
        if (!here) return;
        ring.weight += area;
        ring.along += area * here->along;
        ring.along_squared += area * here->along * here->along;
        ring.around += area * here->around.norm();
    }
    void join() {
        for (int e = 0; e < edges_.size(); ++e) {
            const auto sides = edges_.sides[e];
            const int a = ring_of_[std::size_t(sides[0] / 3)];
            if (sides.size() == 1) rings_[std::size_t(a)].is_closed = false;
            for (std::size_t k = 1; k < sides.size(); ++k) join(a, ring_of_[std::size_t(sides[k] / 3)]);
        }
        for (Ring& ring : rings_) make_set(ring.next), make_set(ring.before);
    }
    void join(int a, int b) {
        Ring *low = &rings_[std::size_t(a)], *high = &rings_[std::size_t(b)];
        if (low->band > high->band) std::swap(low, high), std::swap(a, b);
        if (low->band + 1 != high->band || low->area <= crumb || high->area <= crumb) return;
        low->next.push_back(b);
        high->before.push_back(a);
    }

    const ImageMesh& images_;
    const Edges edges_;
    const double width_;
    const Eigen::VectorXd u_;
    std::vector<int> ring_of_;  ///< per face
    std::vector<Ring> rings_;
};

/// Closed rings behind each other, each of which goes on in the next alone.
using Tube = std::vector<int>;

Tube tube_from(int first, const Rings& rings) {
    Tube tube;
    for (int ring = first; rings[ring].is_closed;) {
        tube.push_back(ring);
        if (rings[ring].next.size() != 1) break;
        ring = rings[ring].next[0];
        if (rings[ring].before.size() != 1) break;
    }
    return tube;
}

/// Whether a tube begins there.
bool begins(int ring, const Rings& rings) {
    const std::vector<int>& before = rings[ring].before;
    return before.size() != 1 || !rings[before[0]].is_closed || rings[before[0]].next.size() != 1;
}

/// Per ring of a tube. The first and the last, which close it or where others begin, do not count.
std::vector<double> turns(const Tube& tube, const Rings& rings) {
    std::vector<double> found(tube.size(), 0);
    for (std::size_t i = 1; i + 1 < tube.size(); ++i) found[i] = rings[tube[i]].turn(rings.width());
    return found;
}

Twist twist_of(const Tube& tube, const Rings& rings) {
    double area = 0, explained = 0, in_all = 0;
    for (std::size_t i = 0; i < tube.size(); ++i) {
        const Ring& ring = rings[tube[i]];
        area += ring.area;
        if (i == 0 || i + 1 == tube.size() || !(ring.weight > 0)) continue;
        explained += ring.along * ring.along / ring.weight;
        in_all += ring.along_squared;
    }
    if (area < least_area || explained < least_explained * in_all) return {};
    double sum = 0, least = 0, most = 0;
    for (const double turn : turns(tube, rings)) {
        sum += turn;
        least = std::min(least, sum);
        most = std::max(most, sum);
    }
    return {(most - least) * 180 / std::numbers::pi, rings[tube[tube.size() / 2]].vertex, area};
}

struct TwistedTube {
    Tube rings;
    Twist twist;
};
TwistedTube most_twisted(const Rings& rings) {
    TwistedTube worst;
    for (int r = 0; r < int(rings.all().size()); ++r) {
        if (!begins(r, rings)) continue;
        Tube tube = tube_from(r, rings);
        if (tube.empty()) continue;
        if (const Twist twist = twist_of(tube, rings); twist.degrees > worst.twist.degrees)
            worst = {std::move(tube), twist};
    }
    return worst;
}

/// How far what lies at the faces is to be turned back.
class Turns {
  public:
    Turns(const Tube& tube, const Rings& rings)
        : rings_(rings), place_(rings.all().size(), nowhere), turn_(turns(tube, rings)) {
        for (std::size_t i = 0; i < tube.size(); ++i) place_[std::size_t(tube[i])] = int(i);
        mark_behind(tube);
        leads_around_ =
            std::any_of(place_.begin(), place_.end(), [](int place) { return place == behind; }) &&
            meets_beginning(tube);
        take_out_full_turns();
        before_.resize(turn_.size());
        std::exclusive_scan(turn_.begin(), turn_.end(), before_.begin(), 0.0);
    }
    bool can_be() const { return all_ == 0 || !leads_around_; }
    double at(int f) const {
        const int ring = rings_.of_face(f), place = place_[std::size_t(ring)];
        if (place == behind) return all_;
        if (place == nowhere) return 0;
        const double within = rings_.mean_at(f) / rings_.width() - rings_[ring].band;
        return before_[std::size_t(place)] + std::clamp(within, 0.0, 1.0) * turn_[std::size_t(place)];
    }

  private:
    static constexpr int nowhere = -1, behind = -2;

    /// Rings that hang together with the end of the tube, but over the tube.
    void mark_behind(const Tube& tube) {
        std::vector<int> ahead = rings_[tube.back()].next;
        while (!ahead.empty()) {
            const int ring = ahead.back();
            ahead.pop_back();
            if (place_[std::size_t(ring)] != nowhere) continue;
            place_[std::size_t(ring)] = behind;
            for (const auto* beside : {&rings_[ring].next, &rings_[ring].before})
                ahead.insert(ahead.end(), beside->begin(), beside->end());
        }
    }
    bool meets_beginning(const Tube& tube) const {
        const std::vector<int>& before = rings_[tube.front()].before;
        return std::any_of(before.begin(), before.end(),
                           [&](int ring) { return place_[std::size_t(ring)] == behind; });
    }
    void take_out_full_turns() {
        constexpr double full = 2 * std::numbers::pi, about = full / 4;
        for (const double turn : turn_) all_ += turn;
        const double whole = full * std::round(all_ / full);
        if (whole == 0 || std::abs(all_ - whole) > about) return;
        for (double& turn : turn_) turn *= whole / all_;
        all_ = 0;
    }

    const Rings& rings_;
    std::vector<int> place_;             ///< per ring: in the tube
    std::vector<double> turn_, before_;  ///< per ring of the tube, and summed over those before it
    double all_ = 0;
    bool leads_around_ = false;
};

}  // namespace

Twist measure_twist(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target) {
    if (source.face_count() == 0) return {};
    return most_twisted(Rings(ImageMesh(map, source, target))).twist;
}

std::optional<Untwisting> untwisting(const PointMap& map, const TriangleMesh& source,
                                     const TriangleMesh& target, double least) {
    if (source.face_count() == 0) return {};
    const ImageMesh images(map, source, target);
    const Rings rings(images);
    const auto [tube, twist] = most_twisted(rings);
    if (tube.empty() || twist.degrees < least) return {};
    const Turns turns(tube, rings);
    if (!turns.can_be()) return {};
    Untwisting result{twist, std::vector<double>(map.size(), 0), std::vector<Vec3>(map.size(), Vec3::Zero())};
    std::vector<double> weight(map.size(), 0);
    for (int f = 0; f < source.face_count(); ++f) {
        const std::optional<Shear> shear = rings.shear(f);
        if (!shear) continue;
        const double area = face_normal(images.source, f).norm() / 2, turn = turns.at(f);
        const Vec3 around = rings.radius_at(f) * shear->around.normalized();
        for (const int v : source.faces.row(f)) {
            result.turn[std::size_t(v)] += area * turn;
            result.around[std::size_t(v)] += area * around;
            weight[std::size_t(v)] += area;
        }
    }
    for (std::size_t v = 0; v < weight.size(); ++v)
        if (weight[v] > 0) result.turn[v] /= weight[v], result.around[v] /= weight[v];
    return result;
}

}  // namespace varimap
