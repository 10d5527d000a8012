#include "common/limbs.h"
#include "common/shapes.h"

namespace varimap::shapes {
namespace {

/// x forward, y left, z up.
const std::vector<Limb> limbs{
    {{-0.9, 0, 0}, {0.8, 0, 0.05}, 0.42, 0.48},             // trunk
    {{0.95, 0, 0.15}, {1.45, 0, 0.65}, 0.26, 0.2},          // neck
    {{1.5, 0, 0.75}, {2.0, 0.03, 0.6}, 0.27, 0.15},         // head
    {{1.42, 0.17, 0.9}, {1.36, 0.3, 1.22}, 0.13, 0.11},     // left ear
    {{1.42, -0.17, 0.9}, {1.32, -0.33, 1.45}, 0.13, 0.11},  // right ear, longer
    {{0.7, 0.25, -0.2}, {0.75, 0.34, -1.25}, 0.2, 0.13},    // legs, all of different lengths
    {{0.7, -0.25, -0.2}, {0.8, -0.36, -1.45}, 0.2, 0.13},
    {{-0.85, 0.22, -0.2}, {-0.9, 0.33, -1.1}, 0.22, 0.15},
    {{-0.85, -0.22, -0.2}, {-0.8, -0.35, -1.32}, 0.2, 0.12},
    {{-1.2, 0, 0.15}, {-2.1, 0.1, 0.45}, 0.17, 0.13}};  // tail

}  // namespace

TriangleMesh figure(double cell, double shift) {
    const Vec3 offset = shift * cell * Vec3(0.37, 0.71, 0.53);
    const Vec3 low = Vec3(-2.4, -0.85, -1.8) - cell * Vec3::Ones() + offset;
    const Vec3 high = Vec3(2.4, 0.85, 1.75) + cell * Vec3::Ones() + offset;
    return level_set([](const Vec3& p) { return smooth_distance(limbs, p); }, low, high, cell);
}

Pose figure_pose(double amount) {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ(), neck = Vec3(1, 0, 1).normalized();
    return {{
        {{0.72, 0.3, 0}, -z, x, 0.55, 0.4, 0.5 * amount, {1, 1, 0}},        // left foreleg forward
        {{0.75, -0.3, 0}, -z, -x, 0.55, 0.4, 0.4 * amount, {1, -1, 0}},     // right foreleg back
        {{-0.87, 0.28, 0}, -z, x, 0.55, 0.4, 0.3 * amount, {-1, 1, 0}},     // left hind leg forward
        {{-0.83, -0.28, 0}, -z, -x, 0.55, 0.4, 0.4 * amount, {-1, -1, 0}},  // right hind leg back
        {{0.95, 0, 0.15}, neck, y, 0.2, 0.45, 0.5 * amount, {1, 0, 0}},     // head to the left
        {{-0.9, 0.05, 0.3}, -x, -y, 0.4, 0.5, 0.8 * amount, {-1, 0, 0}},    // tail to the right
        {{0, 0, 0}, x, y, -0.3, 0.6, 0.25 * amount},                        // trunk to the left
    }};
}

}  // namespace varimap::shapes
