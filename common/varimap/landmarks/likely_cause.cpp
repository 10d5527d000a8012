#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "varimap/landmarks/landmark_points.h"
#include "varimap/mesh/closest_point.h"

namespace varimap {
namespace {

/// A change of coordinates, in words.
struct Guess {
    std::string words;
    Eigen::Matrix3d change;
};

Guess other_units(double factor) {
    return {fmt::format("with coordinates {:.6g} times as large they lie on it: other units", factor),
            factor * Eigen::Matrix3d::Identity()};
}

/// Axis i of the mesh is `sign[i]` times axis[i] of the points.
Guess other_axes(const std::array<int, 3>& axis, const std::array<int, 3>& sign) {
    Guess guess{"with", Eigen::Matrix3d::Zero()};
    for (std::size_t i = 0; i < 3; ++i) {
        guess.words += fmt::format(" {}{}", sign[i] < 0 ? "-" : "", "xyz"[axis[i]]);
        guess.change(Eigen::Index(i), axis[i]) = sign[i];
    }
    const bool turned = axis == std::array{0, 1, 2} && sign == std::array{-1, -1, 1};
    guess.words += " for x y z they lie on it: other axes";
    guess.words += turned ? ", RAS for LPS or the reverse (--landmark-space tells)" : "";
    return guess;
}

/// The likelier first.
std::vector<Guess> all_guesses() {
    std::vector<Guess> guesses{other_axes({0, 1, 2}, {-1, -1, 1})};
    for (const double factor : {1e3, 1e-3, 10., .1, 100., .01, 25.4, 1 / 25.4})
        guesses.push_back(other_units(factor));
    std::array<int, 3> axis{0, 1, 2};
    do
        for (int signs = 0; signs < 8; ++signs)
            guesses.push_back(other_axes(axis, {signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1}));
    while (std::next_permutation(axis.begin(), axis.end()));
    return guesses;
}

/// Points shrunk to one, which may lie on the surface by chance, tell nothing.
double extent(const std::vector<Vec3>& points) {
    double farthest = 0;
    for (const Vec3& p : points) farthest = std::max(farthest, (p - points.front()).stableNorm());
    return farthest;
}

}  // namespace

std::string likely_cause(const std::vector<Vec3>& positions, const TriangleMesh& mesh) {
    std::string cause = "is this the list of another mesh?";
    std::size_t most_near = positions.size() / 2;
    const ClosestPoint closest(mesh);
    const double unit = std::sqrt(surface_area(mesh));
    const auto is_near = [&](const Vec3& p) {
        return (p - position(mesh, closest(p).point)).stableNorm() <= far_from_surface * unit;
    };
    for (const Guess& guess : all_guesses()) {
        std::vector<Vec3> changed;
        for (const Vec3& p : positions) changed.push_back(guess.change * p);
        if (extent(changed) < .1 * unit) continue;
        const auto near = std::size_t(std::count_if(changed.begin(), changed.end(), is_near));
        if (near <= most_near) continue;
        most_near = near;
        cause = guess.words;
    }
    return cause;
}

}  // namespace varimap
