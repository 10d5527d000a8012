#include "stages/explore/components.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "varimap/core/log.h"
#include "varimap/core/rotation.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/pulled_back.h"
#include "varimap/mesh/topology.h"
#include "varimap/results/surface_map.h"
#include "varimap/spectral/local_shape.h"

namespace varimap {

namespace {

// Numbers in this file were chosen by hand.

int nearest_corner(const TriangleMesh& mesh, const SurfacePoint& point) {
    Eigen::Index corner;
    point.barycentric.maxCoeff(&corner);
    return mesh.faces(point.face, corner);
}

double degrees_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    const double cosine = ((a.transpose() * b).trace() - 1) / 2;
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// Lays a component onto its partner, turned, centre on centre. `opposed`: faces of the one look inward.
void lay(PointMap& map, const Components& from, int component, const Components& to, int onto,
         const Eigen::Matrix3d& turn, bool opposed) {
    const std::vector<int> faces = to.faces(onto);
    if (faces.empty()) return;
    const ClosestPoint closest(TriangleMesh{to.mesh().vertices, to.mesh().faces(faces, Eigen::all)});
    const Points normals = vertex_normals(from.mesh());
    const Vec3 here = from.mean(component, from.mesh().vertices), there = to.mean(onto, to.mesh().vertices);
    const double scale = std::sqrt(to.area(onto) / from.area(component));
    for (const int v : from.vertices(component)) {
        const Vec3 normal = turn * normals.row(v).transpose() * (opposed ? -1 : 1);
        SurfacePoint& image = map[std::size_t(v)];
        image = closest(there + scale * (turn * (from.mesh().vertex(v) - here)), normal).point;
        image.face = faces[std::size_t(image.face)];
    }
}

bool has_landmark(const Components& components, int component, const std::vector<int>& landmarks) {
    return std::any_of(landmarks.begin(), landmarks.end(),
                       [&](int vertex) { return components.holds(component, vertex); });
}

}  // namespace

Components::Components(const Surface& surface) : surface_(surface) {
    of_.resize(std::size_t(mesh().vertex_count()), 0);
    // Nothing was repaired: there are no bridges.
    if (!surface.link.is_identity()) {
        const std::vector<int> of_input = vertex_components(without_added_faces(surface));
        for (std::size_t v = 0; v < of_.size(); ++v) {
            const SurfacePoint& at = surface.on_input[v];
            const bool is_added =
                surface.link.face[std::size_t(at.face)] < 0 && at.barycentric.maxCoeff() < 1;
            of_[v] = is_added ? -1 : of_input[std::size_t(nearest_corner(surface.input, at))];
        }
    }
    const auto count = std::size_t(*std::max_element(of_.begin(), of_.end()) + 1);
    vertices_.resize(count);
    areas_.resize(count);
    for (int v = 0; v < mesh().vertex_count(); ++v) {
        if (of_[std::size_t(v)] < 0) continue;
        const auto component = std::size_t(of_[std::size_t(v)]);
        vertices_[component].push_back(v);
        areas_[component] += surface.mass[v];
    }
}

int Components::largest() const {
    return int(std::max_element(areas_.begin(), areas_.end()) - areas_.begin());
}

std::vector<int> Components::faces(int component) const {
    std::vector<int> own;
    for (int f = 0; f < mesh().face_count(); ++f)
        if (holds(component, mesh().faces(f, 0)) && holds(component, mesh().faces(f, 1)) &&
            holds(component, mesh().faces(f, 2)))
            own.push_back(f);
    return own;
}

Vec3 Components::mean(int component, const Points& points) const {
    Vec3 sum = Vec3::Zero();
    for (const int v : vertices(component)) sum += surface_.mass[v] * points.row(v).transpose();
    return sum / area(component);
}

Eigen::Matrix3d Components::turn(int component, const Points& images, bool mirrored) const {
    const Vec3 here = mean(component, mesh().vertices), there = mean(component, images);
    Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
    for (const int v : vertices(component))
        M += surface_.mass[v] * (images.row(v).transpose() - there) * (mesh().vertex(v) - here).transpose();
    return nearest_rotation(M, mirrored);
}

std::optional<int> Components::partner(int component, const PointMap& map, const Components& to) const {
    constexpr double most = 0.7;
    std::vector<double> shares(to.areas_.size());
    for (const int v : vertices(component)) {
        const int image = to.of_[std::size_t(nearest_corner(to.mesh(), map[std::size_t(v)]))];
        if (image >= 0) shares[std::size_t(image)] += surface_.mass[v];
    }
    const auto best = std::max_element(shares.begin(), shares.end());
    if (*best < most * area(component)) return {};
    return int(best - shares.begin());
}

ComponentTurns::ComponentTurns(const PairContext& context, const Appraisal& appraisal)
    : context_(context), appraisal_(appraisal), A_(context.A().surface), B_(context.B().surface) {}

void ComponentTurns::as_the_rest(MapPair& maps) const {
    if (!A_.are_several() || !B_.are_several()) return;
    constexpr double turned = 20;  // degrees; components of cars that lie right differ by up to 18
    // Of rough score, for each unit of area: what is laid rigidly is not relaxed.
    constexpr double clearly = 2;
    constexpr std::size_t enough = 8;  // vertices that tell how a component lies
    const bool opposed = are_opposed(context_.A().surface, context_.B().surface);
    const Points images = pulled_back(B_.mesh().vertices, B_.mesh(), maps.A_to_B);
    const Eigen::Matrix3d rest = A_.turn(A_.largest(), images, opposed);
    for (int a = 0; a < A_.count(); ++a) {
        if (a == A_.largest() || A_.vertices(a).size() < enough) continue;
        const std::optional<int> b = A_.partner(a, maps.A_to_B, B_);
        if (!b || *b == B_.largest() || B_.vertices(*b).size() < enough) continue;
        if (B_.partner(*b, maps.B_to_A, A_) != a || has_landmark(A_, a, context_.landmarks_A())) continue;
        const double degrees = degrees_between(rest, A_.turn(a, images, opposed));
        if (degrees < turned) continue;
        MapPair other = maps;
        lay(other.A_to_B, A_, a, B_, *b, rest, opposed);
        lay(other.B_to_A, B_, *b, A_, a, rest.transpose(), opposed);
        const double as_it_is = rough_score(appraisal_.cues(maps)),
                     as_the_rest = rough_score(appraisal_.cues(other));
        log("a component of {:.1f}% of the area is turned by {:.0f} degrees: score {:.2f}, as the rest "
            "{:.2f}",
            100 * A_.area(a), degrees, as_it_is, as_the_rest);
        if (as_the_rest < as_it_is + clearly * A_.area(a)) maps = std::move(other);
    }
}

}  // namespace varimap
