#include "varimap/mesh_repair/bridges.h"

#include <algorithm>
#include <limits>

#include "varimap/core/index_set.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_repair/private/face_price.h"

namespace varimap {
namespace {

/// A tube between two faces: one goes round forward, the other backward, corner i facing corner shift - i.
struct Tube {
    int here = -1, there = -1, shift = 0;
    double cost = std::numeric_limits<double>::infinity();
};

Faces faces_of(const Tube& tube, const Faces& faces) {
    Faces result(6, 3);
    for (int i = 0; i < 3; ++i) {
        const auto there = [&](int k) { return faces(tube.there, ((tube.shift - k) % 3 + 3) % 3); };
        const int a = faces(tube.here, i), b = faces(tube.here, (i + 1) % 3);
        result.row(2 * i) << a, b, there(i + 1);
        result.row(2 * i + 1) << a, there(i + 1), there(i);
    }
    return result;
}

/// Its area, and more where it has thin faces.
double cost_of(const Tube& tube, const TriangleMesh& mesh, double total_area) {
    const Faces sides = faces_of(tube, mesh.faces);
    double cost = 0;
    for (const auto& side : sides.rowwise())
        cost += price_of_face(mesh.vertex(side[0]), mesh.vertex(side[1]), mesh.vertex(side[2]), total_area);
    return cost;
}

/// Tubes up to this multiple of the least cost are as good.
constexpr double as_good = 2;

constexpr int tips = 8;

/// Vertices far out: the one farthest from the centre, then each farthest from those before.
std::vector<Vec3> outermost_points(const TriangleMesh& mesh) {
    std::vector<double> distance(std::size_t(mesh.vertex_count()), -1);
    const Vec3 centre = area_centroid(mesh);
    for (const int v : mesh.faces.reshaped()) distance[std::size_t(v)] = (mesh.vertex(v) - centre).norm();
    std::vector<Vec3> points;
    for (int i = 0; i < tips; ++i) {
        const auto farthest = std::max_element(distance.begin(), distance.end()) - distance.begin();
        points.push_back(mesh.vertex(int(farthest)));
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            double& least = distance[std::size_t(v)];
            const double now = (mesh.vertex(v) - points.back()).norm();
            if (least >= 0) least = i == 0 ? now : std::min(least, now);
        }
    }
    return points;
}

/// A lid touches its pot all around, and turns on it with the place of its tube. A shape and its like should
/// be joined at like places, so that of tubes that are as good the one farthest from a tip of the whole is
/// chosen: on a pot opposite to the spout. The way from the centre tells little there, where the body is
/// round: chosen by it, the lids of bent teapots were turned by up to .1.
Tube best_placed_of_cheap(const std::vector<Tube>& tubes, const TriangleMesh& mesh) {
    const auto by_cost = [](const Tube& a, const Tube& b) { return a.cost < b.cost; };
    const double limit = as_good * std::min_element(tubes.begin(), tubes.end(), by_cost)->cost;
    const std::vector<Vec3> points = outermost_points(mesh);
    const auto distance = [&](const Tube& tube) {
        if (tube.cost > limit) return -1.;
        const Vec3 at = position(mesh, {tube.here, Vec3::Constant(1. / 3)});
        double farthest = 0;
        for (const Vec3& point : points) farthest = std::max(farthest, (point - at).norm());
        return farthest;
    };
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < tubes.size(); ++i) order.emplace_back(-distance(tubes[i]), i);
    return tubes[std::min_element(order.begin(), order.end())->second];
}

/// The best tube from a component's faces to the nearest of the others.
Tube best_tube(const TriangleMesh& mesh, const std::vector<int>& component, const std::vector<int>& others) {
    const ClosestPoint closest({mesh.vertices, mesh.faces(others, Eigen::all)});
    const double total_area = surface_area(mesh);
    std::vector<Tube> tubes;
    for (const int f : component) {
        const Vec3 centroid = position(mesh, {f, Vec3::Constant(1. / 3)});
        Tube best, tube{f, others[std::size_t(closest(centroid).point.face)]};
        for (tube.shift = 0; tube.shift < 3; ++tube.shift) {
            tube.cost = cost_of(tube, mesh, total_area);
            if (tube.cost < best.cost) best = tube;
        }
        tubes.push_back(best);
    }
    return best_placed_of_cheap(tubes, mesh);
}

void add(const Tube& tube, RepairedMesh& repaired) {
    Faces& faces = repaired.mesh.faces;
    const Faces sides = faces_of(tube, faces);
    std::vector<int> left;
    for (int f = 0; f < int(faces.rows()); ++f)
        if (f != tube.here && f != tube.there) left.push_back(f);
    Faces joined(Eigen::Index(left.size()) + sides.rows(), 3);
    joined << faces(left, Eigen::all), sides;
    faces = std::move(joined);
    FileLink& link = repaired.link;
    for (std::size_t i = 0; i < left.size(); ++i) {
        link.face[i] = link.face[std::size_t(left[i])];
        link.turned[i] = link.turned[std::size_t(left[i])];
    }
    link.face.resize(left.size());
    link.face.resize(left.size() + std::size_t(sides.rows()), -1);
    link.turned.resize(left.size());
    link.turned.resize(link.face.size(), 0);
    ++repaired.counts.bridges;
}

/// The faces of each component, by falling area; among equals the lowest first.
std::vector<std::vector<int>> components_by_area(const TriangleMesh& mesh) {
    const ConnectedComponents components = connected_components(mesh);
    std::vector<std::vector<int>> faces = components.faces();
    const std::vector<double> area = components.areas(mesh);
    std::vector<int> order = all_indices(std::ssize(area));
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return area[std::size_t(a)] > area[std::size_t(b)]; });
    std::vector<std::vector<int>> result;
    for (const int c : order) result.push_back(std::move(faces[std::size_t(c)]));
    return result;
}

}  // namespace

RepairedMesh bridged(RepairedMesh repaired) {
    for (auto parts = components_by_area(repaired.mesh); parts.size() > 1;
         parts = components_by_area(repaired.mesh)) {
        if (repaired.link.is_identity()) repaired.link = link_to_itself(repaired.mesh);
        add(best_tube(repaired.mesh, parts[1], parts[0]), repaired);
    }
    return repaired;
}

}  // namespace varimap
