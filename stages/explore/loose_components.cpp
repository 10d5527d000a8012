#include "stages/explore/loose_components.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "varimap/core/rotation.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/topology.h"
#include "varimap/spectral/local_shape.h"
#include "varimap/surface/pulled_back.h"
#include "varimap/surface/surface.h"

namespace varimap {

namespace {

// Numbers in this file were chosen by hand.

/// Per vertex of the mesh: the component of the input that it lies on; -1 on a bridge.
std::vector<int> component_of_each_vertex(const Surface& surface) {
    std::vector<int> of(std::size_t(surface.mesh.vertex_count()), 0);
    const std::vector<int>& file_face = surface.link.face;
    if (!has_added_faces(surface) || is_cut_out(surface)) return of;
    const std::vector<int> of_input = vertex_components(without_added_faces(surface));
    for (std::size_t v = 0; v < of.size(); ++v) {
        const SurfacePoint& at = surface.on_input[v];
        const bool is_added = file_face[std::size_t(at.face)] < 0 && at.barycentric.maxCoeff() < 1;
        of[v] = is_added ? -1 : of_input[std::size_t(nearest_vertex(surface.input, at))];
    }
    return of;
}

/// Lays components of one surface onto those of another, turned, centre on centre.
class Laying {
  public:
    /// `opposed`: the faces of one of the surfaces look inward.
    Laying(const SurfaceComponents& from, const SurfaceComponents& to, bool opposed)
        : from_(from), to_(to), normals_(vertex_normals(from.mesh()) * (opposed ? -1 : 1)) {}

    void lay(PointMap& map, int component, int onto, const Eigen::Matrix3d& turn) const {
        const std::vector<int> faces = to_.faces(onto);
        const TriangleMesh& mesh = to_.mesh();
        const ClosestPoint closest(TriangleMesh{mesh.vertices, mesh.faces(faces, Eigen::all)});
        const Vec3 here = from_.mean(component, from_.mesh().vertices), there = to_.mean(onto, mesh.vertices);
        const double scale = std::sqrt(to_.area(onto) / from_.area(component));
        for (const int v : from_.vertices(component)) {
            const Vec3 place = there + scale * (turn * (from_.mesh().vertex(v) - here));
            SurfacePoint& image = map[std::size_t(v)];
            image = closest(place, turn * normals_.row(v).transpose()).point;
            image.face = faces[std::size_t(image.face)];
        }
    }

  private:
    const SurfaceComponents &from_, &to_;
    Points normals_;  ///< at the vertices
};

}  // namespace

SurfaceComponents::SurfaceComponents(const Surface& surface)
    : surface_(surface), of_(component_of_each_vertex(surface)) {
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

bool SurfaceComponents::are_several() const {
    constexpr double matters = 0.05;
    return std::count_if(areas_.begin(), areas_.end(), [](double area) { return area >= matters; }) > 1;
}

int SurfaceComponents::largest() const {
    return int(std::max_element(areas_.begin(), areas_.end()) - areas_.begin());
}

std::vector<int> SurfaceComponents::faces(int component) const {
    std::vector<int> own;
    for (int f = 0; f < mesh().face_count(); ++f) {
        const auto corners = mesh().faces.row(f);
        if (std::all_of(corners.begin(), corners.end(), [&](int v) { return holds(component, v); }))
            own.push_back(f);
    }
    return own;
}

bool SurfaceComponents::holds_any(int component, const std::vector<int>& of_vertices) const {
    return std::any_of(of_vertices.begin(), of_vertices.end(), [&](int v) { return holds(component, v); });
}

Vec3 SurfaceComponents::mean(int component, const Points& points) const {
    Vec3 sum = Vec3::Zero();
    for (const int v : vertices(component)) sum += surface_.mass[v] * points.row(v).transpose();
    return sum / area(component);
}

Eigen::Matrix3d SurfaceComponents::turn(int component, const Points& images, bool mirrored) const {
    const std::vector<int>& own = vertices(component);
    const Points here = mesh().vertices(own, Eigen::all), there = images(own, Eigen::all);
    return nearest_rotation(here, there, surface_.mass(own), mirrored);
}

std::optional<int> SurfaceComponents::partner(int component, const PointMap& map,
                                              const SurfaceComponents& to) const {
    constexpr double most = 0.7;
    std::vector<double> shares(to.areas_.size());
    for (const int v : vertices(component)) {
        const int image = to.of_[std::size_t(nearest_vertex(to.mesh(), map[std::size_t(v)]))];
        if (image >= 0) shares[std::size_t(image)] += surface_.mass[v];
    }
    const auto best = std::max_element(shares.begin(), shares.end());
    if (*best < most * area(component)) return {};
    return int(best - shares.begin());
}

LooseComponents::LooseComponents(const PairContext& context, const Appraisal& appraisal)
    : context_(context), appraisal_(appraisal), A_(context.A().surface), B_(context.B().surface) {}

std::optional<int> LooseComponents::counterpart(int component, const MapPair& maps) const {
    constexpr std::size_t enough = 8;  // vertices that tell how a component lies
    if (A_.vertices(component).size() < enough) return {};
    const std::optional<int> there = A_.partner(component, maps.A_to_B, B_);
    if (!there || B_.vertices(*there).size() < enough) return {};
    if (B_.partner(*there, maps.B_to_A, A_) != component) return {};
    if (A_.faces(component).empty() || B_.faces(*there).empty()) return {};
    return there;
}

/// How the largest component lies, and how good the map is.
struct LooseComponents::Rest {
    Laying there, back;
    bool opposed;
    Eigen::Matrix3d turn;
    double score;  ///< rough_score
};

/// Takes what is about the place `here` as the largest component is taken there.
struct LooseComponents::Neighbourhood {
    Vec3 here, image;
    Eigen::Matrix3d turn;
    double scale;

    Vec3 operator()(const Vec3& place) const { return image + scale * (turn * (place - here)); }
};

LooseComponents::Neighbourhood LooseComponents::neighbourhood(const Vec3& place, const Points& images,
                                                              bool opposed) const {
    constexpr double wide = 0.2;  // units of sqrt(area)
    const std::vector<int>& vertices = A_.vertices(A_.largest());
    const Points here = A_.mesh().vertices(vertices, Eigen::all), there = images(vertices, Eigen::all);
    const Eigen::VectorXd squared = (here.rowwise() - place.transpose()).rowwise().squaredNorm();
    // Of what is far from all of it the nearest counts.
    const Eigen::VectorXd weights = (-(squared.array() - squared.minCoeff()) / (2 * wide * wide)).exp() *
                                    context_.A().surface.mass(vertices).array();
    const auto middle = [&](const Points& points) {
        return Vec3(points.transpose() * weights / weights.sum());
    };
    return {middle(here), middle(there), nearest_rotation(here, there, weights, opposed),
            std::sqrt(B_.area(B_.largest()) / A_.area(A_.largest()))};
}

std::vector<std::optional<int>> LooseComponents::partners(const MapPair& maps) const {
    std::vector<std::optional<int>> partners(std::size_t(A_.count()));
    for (int a = 0; a < A_.count(); ++a) {
        if (a == A_.largest() || A_.holds_any(a, context_.landmarks_A())) continue;
        const std::optional<int> b = counterpart(a, maps);
        if (b && !B_.holds_any(*b, context_.landmarks_B())) partners[std::size_t(a)] = b;
    }
    return partners;
}

bool LooseComponents::keep(MapPair& maps, MapPair laid, double much, Rest& rest) const {
    const double score = rough_score(appraisal_.cues(laid));
    if (score >= rest.score + much) return false;
    maps = std::move(laid);
    rest.score = score;
    return true;
}

int LooseComponents::exchange(MapPair& maps, const Points& images, Rest& rest) const {
    constexpr double nearer = 0.5, alike = 1.5;
    // Of rough score, for each unit of area: the tubes that distances are measured along stretch from place
    // to place.
    constexpr double clearly = 25;
    const auto are_alike = [](double a, double b) { return std::max(a, b) < alike * std::min(a, b); };
    const auto middle_B = [&](int b) { return B_.mean(b, B_.mesh().vertices); };
    std::vector<std::optional<int>> partner = partners(maps);
    std::vector<Vec3> place(partner.size());
    for (std::size_t a = 0; a < place.size(); ++a) {
        if (!partner[a]) continue;
        const Vec3 middle = A_.mean(int(a), A_.mesh().vertices);
        place[a] = neighbourhood(middle, images, rest.opposed)(middle);
    }
    int exchanged = 0;
    for (int a = 0; a < A_.count(); ++a)
        for (int c = a + 1; c < A_.count(); ++c) {
            auto &b = partner[std::size_t(a)], &d = partner[std::size_t(c)];
            if (!b || !d || !are_alike(A_.area(a), A_.area(c)) || !are_alike(B_.area(*b), B_.area(*d)))
                continue;
            // Between the two: that both lie aside, as on a body that was bent, says nothing.
            const Vec3 expected = place[std::size_t(c)] - place[std::size_t(a)],
                       found = middle_B(*d) - middle_B(*b);
            if ((expected + found).norm() >= nearer * (expected - found).norm()) continue;
            MapPair laid = maps;
            rest.there.lay(laid.A_to_B, a, *d, rest.turn);
            rest.there.lay(laid.A_to_B, c, *b, rest.turn);
            rest.back.lay(laid.B_to_A, *d, a, rest.turn.transpose());
            rest.back.lay(laid.B_to_A, *b, c, rest.turn.transpose());
            if (!keep(maps, std::move(laid), clearly * (A_.area(a) + A_.area(c)), rest)) continue;
            std::swap(b, d);
            exchanged += 2;
        }
    return exchanged;
}

int LooseComponents::turn(MapPair& maps, Rest& rest) const {
    constexpr double otherwise = 20;  // degrees; components of cars that lie right differ by up to 18
    constexpr double clearly = 2;     // as above: what is laid rigidly is not relaxed
    const std::vector<std::optional<int>> partner = partners(maps);
    const Points images = positions(B_.mesh(), maps.A_to_B);
    int turned = 0;
    for (int a = 0; a < A_.count(); ++a) {
        const std::optional<int> b = partner[std::size_t(a)];
        if (!b || degrees(rest.turn.transpose() * A_.turn(a, images, rest.opposed)) < otherwise) continue;
        MapPair laid = maps;
        rest.there.lay(laid.A_to_B, a, *b, rest.turn);
        rest.back.lay(laid.B_to_A, *b, a, rest.turn.transpose());
        turned += keep(maps, std::move(laid), clearly * A_.area(a), rest);
    }
    return turned;
}

int LooseComponents::lay_as_the_rest(MapPair& maps) const {
    const int largest = A_.largest();
    if (A_.count() < 2 || B_.count() < 2 || !counterpart(largest, maps)) return 0;
    const bool opposed = are_opposed(context_.A().surface, context_.B().surface);
    const Points images = positions(B_.mesh(), maps.A_to_B);
    Rest rest{Laying(A_, B_, opposed), Laying(B_, A_, opposed), opposed, A_.turn(largest, images, opposed),
              rough_score(appraisal_.cues(maps))};
    const int exchanged = exchange(maps, images, rest);
    return exchanged + turn(maps, rest);
}

}  // namespace varimap
