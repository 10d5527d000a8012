#include "stages/generate/merged.h"

#include <cmath>
#include <numbers>

namespace varimap::shapes {

namespace {

/// A ball, and half a ring that stands on it.
Body ball_with_handle(double size, bool has_handle) {
    const double ring = 0.32 + 0.35 * size, tube = 0.2 * ring;
    constexpr double half = 0.01;  // of the axis that tells directions
    std::vector<Limb> limbs{{{-half, 0, 0}, {half, 0, 0}, 1, 1}};
    constexpr int pieces = 8;
    const auto at = [&](int piece) {
        const double angle = std::numbers::pi * piece / pieces;
        return Vec3(ring * std::cos(angle), 0, 1 - tube + 1.15 * ring * std::sin(angle));
    };
    for (int i = 0; i < pieces; ++i) limbs.push_back({at(i), at(i + 1), tube, tube, !has_handle});
    return {{unbent(limbs)}, unbent({}).bend};
}

/// x forward, y left, z up. The left arm is stretched out, or lies at the chest and is one with it.
Body person(bool in_contact) {
    const double shoulder = 0.85, arm = 0.95, leg = 1.1;
    std::vector<Limb> limbs{{{0, 0, 0}, {0, 0, shoulder}, 0.25, 0.3},
                            {{0, 0, shoulder}, {0, 0, 1.35}, 0.13, 0.14},
                            {{0, 0, 1.35}, {0.03, 0, 1.5}, 0.2, 0.22},
                            {{0.2, 0, 1.42}, {0.36, 0, 1.38}, 0.09, 0.06}};
    for (const double side : {1.0, -1.0}) {
        const Vec3 armpit(0, 0.22 * side, shoulder - 0.02), groin(0, 0.15 * side, 0);
        const Vec3 heel = groin + leg * Vec3(0, 0.1 * side, -1);
        const bool merges = in_contact && side > 0;
        const Vec3 along = merges ? Vec3(0.34, 0.02, -0.94) : Vec3(0.1, 0.9 * side, -0.35);
        limbs.push_back({armpit, armpit + arm * along.normalized(), 0.12, 0.1});
        limbs.push_back({groin, heel, 0.16, 0.11});
        limbs.push_back({heel, heel + Vec3(0.3, 0.04 * side, -0.03), 0.11, 0.08});
    }
    return {{unbent(limbs)}, unbent({}).bend};
}

}  // namespace

const std::vector<std::string>& merged_names() {
    static const std::vector<std::string> names{"handle", "contact"};
    return names;
}

std::optional<std::pair<Body, Body>> merged_pair(const std::string& name, const GenerateParams& params) {
    if (name == "handle")
        return std::pair(ball_with_handle(params.variation, false), ball_with_handle(params.variation, true));
    if (name == "contact") return std::pair(person(false), person(true));
    return {};
}

}  // namespace varimap::shapes
