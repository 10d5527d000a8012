#include "stages/explore/loose_components.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "varimap/core/rotation.h"
#include "varimap/mesh/interpolation.h"

namespace varimap {

// Numbers in this file were chosen by hand.

LooseComponents::LooseComponents(const PairContext& context, const Appraisal& appraisal)
    : context_(context), appraisal_(appraisal), A_(appraisal.components_A()), B_(appraisal.components_B()) {}

std::optional<int> LooseComponents::counterpart(int component, const MapPair& maps) const {
    if (!A_.can_be_laid(component)) return {};
    const std::optional<int> there = A_.partner(component, maps.A_to_B, B_);
    if (!there || !B_.can_be_laid(*there) || B_.partner(*there, maps.B_to_A, A_) != component) return {};
    return there;
}

/// How the largest component lies, and how good the map is.
struct LooseComponents::Rest {
    ComponentLaying there, back;
    bool opposed;
    Eigen::Matrix3d turn;
    double score;  ///< rough_score

    /// One component of A onto one of B, and back, turned as the largest one is.
    void lay(MapPair& maps, int a, int b) const {
        there.lay(maps.A_to_B, a, b, turn);
        back.lay(maps.B_to_A, b, a, turn.transpose());
    }
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

std::vector<Vec3> LooseComponents::places_beside_largest(const std::vector<std::optional<int>>& partner,
                                                         const Points& images, bool opposed) const {
    std::vector<Vec3> place(partner.size());
    for (std::size_t a = 0; a < place.size(); ++a) {
        if (!partner[a]) continue;
        const Vec3 middle = A_.mean(int(a), A_.mesh().vertices);
        place[a] = neighbourhood(middle, images, opposed)(middle);
    }
    return place;
}

int LooseComponents::exchange(MapPair& maps, const Points& images, Rest& rest) const {
    constexpr double nearer = 0.5, alike = 1.5;
    // Of rough score, for each unit of area: the tubes that distances are measured along stretch from place
    // to place.
    constexpr double clearly = 25;
    const auto are_alike = [](double a, double b) { return std::max(a, b) < alike * std::min(a, b); };
    const auto middle_B = [&](int b) { return B_.mean(b, B_.mesh().vertices); };
    std::vector<std::optional<int>> partner = partners(maps);
    const std::vector<Vec3> place = places_beside_largest(partner, images, rest.opposed);
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
            rest.lay(laid, a, *d);
            rest.lay(laid, c, *b);
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
        rest.lay(laid, a, *b);
        turned += keep(maps, std::move(laid), clearly * A_.area(a), rest);
    }
    return turned;
}

int LooseComponents::lay_as_the_rest(MapPair& maps) const {
    const int largest = A_.largest();
    if (A_.count() < 2 || B_.count() < 2 || !counterpart(largest, maps)) return 0;
    const bool opposed = appraisal_.handedness().are_opposite();
    const Points images = positions(B_.mesh(), maps.A_to_B);
    Rest rest{ComponentLaying(A_, B_, opposed), ComponentLaying(B_, A_, opposed), opposed,
              A_.turn(largest, images, opposed), rough_score(appraisal_.cues(maps))};
    const int exchanged = exchange(maps, images, rest);
    return exchanged + turn(maps, rest);
}

}  // namespace varimap
