#include "varimap/quality/rings.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "varimap/core/index_set.h"
#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/unit_area.h"
#include "varimap/quality/quality.h"

namespace varimap {

namespace {

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

/// Along edges; 0 where none leads.
Eigen::VectorXd distances_from(const std::vector<int>& sources, const GeodesicGraph& graph) {
    Eigen::VectorXd distance = Eigen::VectorXd::Zero(graph.vertex_count());
    GeodesicBall(graph).grow(sources, [&](int vertex, double length) {
        distance[vertex] = length;
        return true;
    });
    return distance;
}

/// Of each component the vertex where u is largest.
std::vector<int> farthest(const Eigen::VectorXd& u, const std::vector<int>& component) {
    std::vector<int> result;
    for (int v = 0; v < u.size(); ++v) {
        const int c = component[std::size_t(v)];
        if (c < 0) continue;
        if (c == std::ssize(result)) result.push_back(v);  // numbered by lowest vertex
        if (u[v] > u[result[std::size_t(c)]]) result[std::size_t(c)] = v;
    }
    return result;
}

/// Paths along edges are longer than the way: makes distances shorter straight across triangles, from near to
/// far.
void shorten(Eigen::VectorXd& u, const TriangleMesh& mesh) {
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
}

/// On a mesh of unit area, from one of the ends of each component: all that is about as far as can be from
/// an end. Distances from a single vertex, on one side of a shaft, would rise aslant along it, as lengths of
/// paths along edges do by 20 degrees here and there.
Eigen::VectorXd distances_from_ends(const TriangleMesh& mesh, double width) {
    const GeodesicGraph graph(mesh);
    const std::vector<int> component = connected_components(mesh).of_vertex;
    const auto u_from = [&](const std::vector<int>& sources) { return distances_from(sources, graph); };
    const Eigen::VectorXd nowhere = Eigen::VectorXd::Zero(mesh.vertex_count());
    const Eigen::VectorXd along = u_from(farthest(u_from(farthest(nowhere, component)), component));
    const std::vector<int> tips = farthest(along, component);
    std::vector<int> ends;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (const int c = component[std::size_t(v)]; c >= 0)
            if (along[v] > along[tips[std::size_t(c)]] - width) ends.push_back(v);
    Eigen::VectorXd u = u_from(ends);
    shorten(u, mesh);
    return u;
}

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

}  // namespace

double Ring::radius(double width) const {
    return weight > 0 ? around / weight * area / (2 * std::numbers::pi * width) : 0;
}

double Ring::turn(double width) const {
    return weight > 0 && around > 0 ? along / weight * width / radius(width) : 0;
}

Rings::Rings(const ImageMesh& images)
    : images_(images),
      edges_(find_edges(images.source)),
      width_(std::max(ring_width, 3 * median_longest_edge(images.source))),
      u_(distances_from_ends(images.source, width_)) {
    std::vector<int> band;
    for (int f = 0; f < images.source.face_count(); ++f) band.push_back(int(mean_at(f) / width_));
    number_components(band);
    for (int f = 0; f < images.source.face_count(); ++f) add(f, band[std::size_t(f)]);
    join();
}

double Rings::mean_at(int f) const {
    const auto corners = images_.source.faces.row(f);
    return (u_[corners[0]] + u_[corners[1]] + u_[corners[2]]) / 3;
}

double Rings::radius_at(int f) const {
    const Ring& ring = (*this)[of_face(f)];
    double radius = ring.radius(width_);
    if (ring.before.empty()) radius = std::min(radius, mean_at(f) - ring.least);
    if (ring.next.empty()) radius = std::min(radius, ring.most - mean_at(f));
    return radius;
}

std::optional<Shear> Rings::shear(int f) const {
    return shear_of(images_, u_, f);
}

void Rings::number_components(const std::vector<int>& band) {
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
                for (const int half_edge : edges_.half_edges[edges_.of_half_edge[std::size_t(3 * f + k)]]) {
                    const auto g = std::size_t(half_edge / 3);
                    if (ring_of_[g] >= 0 || band[g] != band[std::size_t(f)]) continue;
                    ring_of_[g] = count;
                    ahead.push_back(int(g));
                }
        }
        ++count;
    }
    rings_.resize(std::size_t(count));
}

void Rings::add(int f, int band) {
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

void Rings::join() {
    for (int e = 0; e < edges_.size(); ++e) {
        const auto half_edges = edges_.half_edges[e];
        const int a = ring_of_[std::size_t(half_edges[0] / 3)];
        if (half_edges.size() == 1) rings_[std::size_t(a)].is_closed = false;
        for (std::size_t k = 1; k < half_edges.size(); ++k) join(a, ring_of_[std::size_t(half_edges[k] / 3)]);
    }
    for (Ring& ring : rings_) make_set(ring.next), make_set(ring.before);
}

void Rings::join(int a, int b) {
    Ring *low = &rings_[std::size_t(a)], *high = &rings_[std::size_t(b)];
    if (low->band > high->band) std::swap(low, high), std::swap(a, b);
    if (low->band + 1 != high->band || low->area <= crumb || high->area <= crumb) return;
    low->next.push_back(b);
    high->before.push_back(a);
}

std::vector<Tube> tubes(const Rings& rings) {
    std::vector<Tube> all;
    for (int r = 0; r < int(rings.all().size()); ++r)
        if (begins(r, rings))
            if (Tube tube = tube_from(r, rings); !tube.empty()) all.push_back(std::move(tube));
    return all;
}

std::vector<double> turns(const Tube& tube, const Rings& rings) {
    std::vector<double> found(tube.size(), 0);
    for (std::size_t i = 1; i + 1 < tube.size(); ++i) found[i] = rings[tube[i]].turn(rings.width());
    return found;
}

}  // namespace varimap
