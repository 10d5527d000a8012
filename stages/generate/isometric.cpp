#include "stages/generate/isometric.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stages/generate/random.h"

namespace varimap::shapes {

namespace {

using std::numbers::pi;

/// Bends what lies beyond `start` from `a` towards `b`, within `length`.
Bend bend_of(const Vec3& a, const Vec3& b, double start, double length, const Vec3& towards, double angle) {
    const Vec3 axis = (b - a).normalized();
    return {a, axis, (towards - towards.dot(axis) * axis).normalized(), start, length, angle};
}

/// A limb with what hangs on it, bent in its middle.
Part bent_limb(const Limb& limb, double root, Random& random, std::vector<Limb> more = {}) {
    const double length = (limb.b - limb.a).norm() - root;
    more.insert(more.begin(), limb);
    const Vec3 towards = random.direction();
    return {more, bend_of(limb.a, limb.b, root, 0.7 * length, towards, random.between(0.4, 0.9))};
}

/// The limb with its end moved, to `factor` times the length.
Limb scaled(const Limb& limb, double factor) {
    return {limb.a, limb.a + factor * (limb.b - limb.a), limb.ra, limb.rb};
}

/// Directions at least `angle` apart.
std::vector<Vec3> separated_directions(int count, double angle, Random& random) {
    std::vector<Vec3> directions;
    while (int(directions.size()) < count) {
        const Vec3 d = random.direction();
        if (std::all_of(directions.begin(), directions.end(),
                        [&](const Vec3& other) { return d.dot(other) < std::cos(angle); }))
            directions.push_back(d);
    }
    return directions;
}

Body blob(Random& random) {
    std::vector<Limb> balls{{{-0.5, 0, 0}, {0.5, 0, 0}, random.between(0.3, 0.5), random.between(0.5, 0.7)}};
    for (const Vec3& d : separated_directions(6, 0.9, random)) {
        const Vec3 centre = random.between(0.6, 1.1) * d.cwiseProduct(Vec3(1.5, 1, 0.8));
        balls.push_back({Vec3::Zero(), centre, 0.3, random.between(0.2, 0.45)});
    }
    return {{unbent(balls)}, bend_of(-Vec3::UnitX(), Vec3::UnitX(), 0.3, 1.4, random.direction(), 0.5)};
}

Body creature(Random& random) {
    const double half = random.between(0.6, 1), radius = random.between(0.32, 0.45);
    Body body{{unbent({{{-half, 0, 0}, {half, 0, 0}, radius, 0.9 * radius}})},
              bend_of(-Vec3::UnitX(), Vec3::UnitX(), 0.6, 0.8, random.direction(), 0.3)};
    const int limbs = int(random.between(5, 8));
    double length = random.between(0.5, 0.7);  // all of different lengths
    for (const Vec3& d : separated_directions(limbs, 0.8, random)) {
        const Vec3 root(half * d[0], 0, 0);
        const double width = random.between(0.12, 0.18);
        body.parts.push_back(
            bent_limb({root, root + (radius + length) * d, width, 0.8 * width}, radius, random));
        length += random.between(0.1, 0.2);
    }
    return body;
}

Body ring(Random& random) {
    constexpr int pieces = 14;
    const double thin = random.between(0.15, 0.2), thick = random.between(0.26, 0.34);
    const auto at = [](double turn) { return Vec3(std::cos(2 * pi * turn), std::sin(2 * pi * turn), 0); };
    const auto radius = [&](double turn) {
        return thin + (thick - thin) * (1 + std::cos(2 * pi * turn)) / 2;
    };
    std::vector<Limb> tube;
    for (int i = 0; i < pieces; ++i) {
        const double begin = double(i) / pieces, end = double(i + 1) / pieces;
        tube.push_back({at(begin), at(end), radius(begin), radius(end)});
    }
    Body body{{unbent(tube)}, bend_of(-at(0.1), at(0.1), 0.5, 1, Vec3::UnitZ(), random.between(0.3, 0.6))};
    double length = random.between(0.4, 0.6);
    for (const double turn : {0.05, 0.3, 0.45, 0.8}) {
        const Vec3 root = at(turn + random.between(0, 0.08));
        const Vec3 out = (root + random.between(-0.8, 0.8) * Vec3::UnitZ()).normalized();
        body.parts.push_back(bent_limb({root, root + (0.3 + length) * out, 0.14, 0.12}, 0.3, random));
        length += random.between(0.1, 0.25);
    }
    return body;
}

/// x forward, y left, z up; its left and right sides are alike.
Body animal(Random& random) {
    const double half = random.between(0.7, 1), fore = random.between(0.9, 1.2),
                 hind = random.between(0.8, 1.2);
    Body body{{unbent({{{-half, 0, 0}, {half, 0, 0.05}, 0.38, 0.42}})},
              bend_of(-Vec3::UnitX(), Vec3::UnitX(), 0.6, 0.8, Vec3::UnitY(), random.between(0.2, 0.4))};
    for (const Limb& leg : {Limb{{0.9 * half, 0.22, -0.2}, {0.9 * half, 0.3, -0.2 - fore}, 0.18, 0.12},
                            Limb{{-0.9 * half, 0.2, -0.2}, {-half, 0.3, -0.2 - hind}, 0.2, 0.13}}) {
        body.parts.push_back(bent_limb(leg, 0.3, random));
        body.parts.push_back(bent_limb(reflected(leg), 0.3, random));
    }
    const Vec3 crown(half + 0.55, 0, random.between(0.5, 0.9));
    const Limb ear{crown + Vec3(-0.05, 0.12, 0.1), crown + Vec3(-0.1, 0.3, 0.45), 0.11, 0.1};
    body.parts.push_back(bent_limb({{half, 0, 0.15}, crown, 0.24, 0.2}, 0.3, random,
                                   {{crown, crown + Vec3(0.4, 0, -0.1), 0.24, 0.14}, ear, reflected(ear)}));
    body.parts.push_back(
        bent_limb({{-half, 0, 0.1}, {-half - random.between(0.7, 1.2), 0, 0.4}, 0.15, 0.11}, 0.35, random));
    return body;
}

/// What tells a person's front from its back.
struct Cues {
    bool feet, face;
    double left_longer;  ///< limbs of the left side by those of the right
};

/// x forward, y left, z up.
Body person(const Cues& cues, Random& random) {
    const double arm = random.between(0.8, 1), leg = random.between(1, 1.25),
                 shoulder = random.between(0.8, 0.9);
    std::vector<Limb> head{{{0, 0, 1.35}, {0.03, 0, 1.5}, 0.2, 0.22}};
    if (cues.face) head.push_back({{0.2, 0, 1.42}, {0.36, 0, 1.38}, 0.09, 0.06});
    Body body{{unbent({{{0, 0, 0}, {0, 0, shoulder}, 0.25, 0.3}}),
               bent_limb({{0, 0, shoulder}, {0, 0, 1.35}, 0.13, 0.13}, 0.3, random, head)},
              bend_of({0, 0, 0.1}, {0, 0, 1}, 0, 0.6, Vec3(1, 0.5, 0), random.between(0.2, 0.4))};
    for (const double left : {1.0, 0.0}) {
        const double longer = left ? cues.left_longer : 1;
        const Limb upper = scaled({{0, 0.2, shoulder}, {0, 0.2 + arm, shoulder - 0.35}, 0.12, 0.09}, longer);
        const Limb lower = scaled({{0, 0.14, 0}, {0, 0.24, -leg}, 0.16, 0.11}, longer);
        std::vector<Limb> foot;
        if (cues.feet) foot.push_back({lower.b, lower.b + Vec3(0.3, 0.04, -0.03), 0.11, 0.08});
        if (!left)
            std::transform(foot.begin(), foot.end(), foot.begin(),
                           [](const Limb& l) { return reflected(l); });
        body.parts.push_back(bent_limb(left ? upper : reflected(upper), 0.3, random));
        body.parts.push_back(bent_limb(left ? lower : reflected(lower), 0.35, random, foot));
    }
    return body;
}

}  // namespace

IsometricShape isometric_shape(unsigned seed) {
    Random random(seed);
    const unsigned kind = seed % 5, variant = seed / 5 % 4;
    if (kind == 0) return {"blob", blob(random)};
    if (kind == 1) return {"creature", creature(random)};
    if (kind == 2) return {"ring", ring(random)};
    if (kind == 3) return {"animal", animal(random)};
    if (variant == 0) return {"person with feet and face", person({true, true, 1}, random)};
    if (variant == 1) return {"person with feet", person({true, false, 1}, random)};
    if (variant == 2) return {"person with face", person({false, true, 1}, random)};
    return {"person of uneven limbs", person({false, false, 1.15}, random)};
}

}  // namespace varimap::shapes
