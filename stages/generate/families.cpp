#include "stages/generate/families.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace varimap::shapes {

namespace {

using std::numbers::pi;

/// Lengths and angles of one member. x forward, y left, z up.
class Proportions {
  public:
    Proportions(const GenerateParams& params, Random& random) : params_(params), random_(random) {}

    /// `typical` times or by up to exp(spread).
    double length(double typical, double spread) {
        return typical * std::exp(params_.variation * spread * random_.between(-1, 1));
    }
    /// `typical` more or less up to `spread`.
    double shifted(double typical, double spread) {
        return typical + params_.variation * spread * random_.between(-1, 1);
    }
    /// From 0, slender, to 1, as a hippopotamus. Nothing is drawn where all are slender.
    double stoutness() { return params_.build > 0 ? params_.build * random_.between(0, 1) : 0; }
    /// Limbs, bent about the middle of the first.
    Part bent(std::vector<Limb> limbs, double root) {
        const Limb& limb = limbs.front();
        const double reach = std::max((limb.b - limb.a).norm() - root, 0.1);
        const Bend bend = any_bend(limb.a, (limb.b - limb.a).normalized(), root, 0.7 * reach, 0.8);
        return {std::move(limbs), bend};
    }
    /// Bends by up to `angle`, towards anywhere, what lies beyond `start` along the axis.
    Bend any_bend(const Vec3& from, const Vec3& axis, double start, double reach, double angle) {
        const Vec3 towards = random_.direction();
        return {from,  axis,  (towards - towards.dot(axis) * axis).normalized(),
                start, reach, params_.bending * random_.between(0, angle)};
    }
    /// A limb that a member can do without.
    Limb dispensable(Limb limb) {
        limb.missing = random_.between(0, 1) < params_.missing;
        return limb;
    }
    /// Both sides' limbs, bent each in its way.
    void add_sides(Body& body, const std::vector<Limb>& left, double root) {
        std::vector<Limb> right = reflected(left);
        const double longer = std::exp(0.3 * params_.asymmetry * random_.between(-1, 1));
        const Vec3 from = right.front().a;
        for (Limb& limb : right) {
            limb.a = from + longer * (limb.a - from);
            limb.b = from + longer * (limb.b - from);
        }
        body.parts.push_back(bent(left, root));
        body.parts.push_back(bent(right, root));
    }
    std::vector<Ripple> relief() {
        constexpr int count = 12;
        std::vector<Ripple> ripples;
        for (int i = 0; i < count; ++i) {
            const double length = random_.between(0.25, 0.8), phase = random_.between(0, 2 * pi);
            ripples.push_back(
                {2 * pi / length * random_.direction(), phase, params_.relief * std::sqrt(2.0 / count)});
        }
        return ripples;
    }

  private:
    const GenerateParams& params_;
    Random& random_;
};

Part biped_head(Proportions& p, const Vec3& shoulder, double chest) {
    const double head = p.length(0.21, 0.2), jaw = p.length(0.14, 0.6), stoop = p.shifted(0.03, 0.1);
    const Vec3 crown = shoulder + Vec3(stoop, 0, chest + p.length(0.4, 0.3));
    const Limb face{crown, crown + Vec3(head + jaw, 0, -0.08), 0.6 * head, 0.3 * head};
    return p.bent({{shoulder, crown, p.length(0.13, 0.3), head}, p.dispensable(face)}, 0.3);
}

/// Upright, from people to apes: shoulders ahead of the hips, bellies, arms longer than legs.
Body biped(Proportions& p) {
    const double height = p.length(0.85, 0.2), hip = p.length(0.25, 0.25), chest = p.length(0.3, 0.25);
    const double lean = p.shifted(0.1, 0.2), width = p.length(0.2, 0.3), belly = p.length(0.22, 0.4);
    const Vec3 shoulder(lean, 0, height), waist(0, 0, 0.3 * height);
    Body body;
    body.parts.push_back(
        unbent({{Vec3::Zero(), shoulder, hip, chest}, {waist, waist + Vec3(0.5 * belly, 0, 0), hip, belly}}));
    body.parts.push_back(biped_head(p, shoulder, chest));
    const double arm = p.length(0.95, 0.35), leg = p.length(1.1, 0.3);
    const double thin = p.length(0.12, 0.35), thick = p.length(0.16, 0.3);
    const Vec3 armpit = shoulder + Vec3(0, width, -0.05), wrist = armpit + arm * Vec3(0.1, 0.9, -0.35);
    const Limb hand{wrist, wrist + Vec3(0.1, 0.12, -0.06), 0.9 * thin, 0.7 * thin};
    p.add_sides(body, {{armpit, wrist, thin, 0.8 * thin}, p.dispensable(hand)}, 0.25);
    const double foot = p.length(0.28, 0.35), sole = p.length(0.1, 0.2);
    const Vec3 groin(0, std::max(0.7 * width, thick), 0), heel = groin + leg * Vec3(0, 0.12, -1);
    p.add_sides(
        body, {{groin, heel, thick, 0.65 * thick}, {heel, heel + Vec3(foot, 0.05, -0.02), sole, 0.75 * sole}},
        0.3);
    body.bend = p.any_bend({0, 0, 0.1}, Vec3::UnitZ(), 0, 0.6 * height, 0.4);
    return body;
}

/// Neck, head, snout and ears.
Part quadruped_head(Proportions& p, const Vec3& withers, double girth, double stoutness) {
    const double neck = p.length(0.6 * std::exp(-0.5 * stoutness), 0.45),
                 rise = p.shifted(0.8 - 0.5 * stoutness, 0.5);
    const double head = p.length(0.22 * std::exp(0.4 * stoutness), 0.3);
    const double snout = p.length(0.4, 0.5), ear = p.length(0.3 * std::exp(-1.2 * stoutness), 0.6);
    const double muzzle = 0.6 + 0.3 * stoutness;
    const Vec3 crown = withers + neck * Vec3(std::cos(rise), 0, std::sin(rise)) + Vec3(0.6 * girth, 0, 0);
    std::vector<Limb> limbs{{withers, crown, p.length(0.22, 0.3), head},
                            {crown, crown + Vec3(snout, 0, -0.12), head, p.length(muzzle, 0.3) * head}};
    for (const double side : {0.7, -0.7}) {
        const Limb limb{crown + Vec3(-0.04, side * head, 0.4 * head),
                        crown + Vec3(-0.08, side * (head + 0.6 * ear), 0.5 * head + ear), 0.1, 0.08};
        limbs.push_back(p.dispensable(limb));
    }
    return p.bent(limbs, 0.3);
}

/// Legs of one member are apart at rest, so that they do not grow together.
Body quadruped(Proportions& p) {
    const double stoutness = p.stoutness(), wide = std::exp(0.35 * stoutness);
    const double half = p.length(0.8, 0.25), girth = p.length(0.38 * wide, 0.3),
                 rump = p.length(0.38 * wide, 0.25);
    const double fore = p.length(0.95 * std::exp(-0.5 * stoutness), 0.4), hind = fore * p.length(1, 0.2);
    const double stout = p.length(0.16 * std::exp(0.25 * stoutness), 0.35);
    const double rise = p.shifted(0.05, 0.1), belly = p.length(0.1, 0.8);
    Body body;
    body.parts.push_back(unbent(
        {{{-half, 0, 0}, {half, 0, rise}, rump, girth}, {{-0.2, 0, 0}, {0.2, 0, -belly}, girth, girth}}));
    const double track = std::max(p.length(0.22 * wide, 0.25), 1.2 * stout), hoof = p.length(0.14, 0.4);
    for (const auto& [x, length] : {std::pair(0.85 * half, fore), std::pair(-0.85 * half, hind)}) {
        const Vec3 top(x, track, -0.15), end(x + (x < 0 ? -0.06 : 0.03), 1.15 * track, -0.2 - length);
        p.add_sides(body,
                    {{top, end, 1.1 * stout, 0.75 * stout},
                     {end, end + Vec3(hoof, 0, -0.02), 0.8 * stout, 0.7 * stout}},
                    0.3);
    }
    body.parts.push_back(quadruped_head(p, {half, 0, 0.1}, girth, stoutness));
    const double tail = p.length(0.8 * std::exp(-1.2 * stoutness), 0.6), droop = p.shifted(0, 0.6);
    const Vec3 dock(-half, 0, 0.1), away(-std::cos(droop), 0, -std::sin(droop));
    body.parts.push_back(p.bent(
        {p.dispensable({dock, dock + (tail + rump) * away, p.length(0.13, 0.3), p.length(0.09, 0.3)})}, 0.3));
    body.bend = p.any_bend(-Vec3::UnitX(), Vec3::UnitX(), 0.6, 0.8, 0.4);
    return body;
}

Part palm_of_hand(Proportions& p, double palm, double breadth, double thick) {
    std::vector<Limb> bones;
    for (const double side : {-1.0, -0.33, 0.33, 1.0})
        bones.push_back(
            {{-0.5 * palm, 0.6 * side * breadth, 0}, {0.5 * palm, side * breadth, 0}, 1.1 * thick, thick});
    const double wrist = p.length(0.6, 0.4);
    bones.push_back({{-0.5 * palm, 0, 0}, {-0.5 * palm - wrist, 0, 0}, 1.5 * thick, 1.4 * thick});
    bones.push_back({{-0.3 * palm, 0.7 * breadth, -0.05}, {0, 0.7 * breadth, -0.14}, thick, thick});
    return unbent(bones);
}

/// Of a right hand: fingers along x, the thumb towards y, the back up. Fingers are so thin that they are
/// apart.
Body hand(Proportions& p) {
    const double palm = p.length(0.7, 0.2), breadth = p.length(0.5, 0.2), thick = p.length(0.16, 0.25);
    Body body;
    body.parts.push_back(palm_of_hand(p, palm, breadth, thick));
    const double lengths[] = {0.6, 0.8, 0.85, 0.75};
    for (int k = 0; k < 4; ++k) {
        const double side = -1 + 2 * k / 3.0, length = p.length(lengths[k], 0.25);
        const double width = std::min(p.length(0.12, 0.2), breadth / 3 - 0.05);
        const Vec3 knuckle(0.5 * palm, side * breadth, 0);
        const Limb finger{knuckle, knuckle + (length + thick) * Vec3(1, 0.2 * side, 0), width, 0.8 * width};
        body.parts.push_back(p.bent({p.dispensable(finger)}, thick));
    }
    const double length = p.length(0.7, 0.25), width = p.length(0.14, 0.2);
    const Vec3 root(-0.2 * palm, 0.9 * breadth, -0.08);
    const Limb thumb{root, root + (length + thick) * Vec3(0.55, 0.8, -0.2), width, 0.8 * width};
    body.parts.push_back(p.bent({p.dispensable(thumb)}, thick));
    body.bend = p.any_bend(-Vec3::UnitX(), Vec3::UnitX(), 0.8, 0.6, 0.2);
    return body;
}

/// A thigh bone: a ball on a neck, a knob beside it, a knob on the shaft, two unequal condyles.
Body bone(Proportions& p) {
    const double length = p.length(2, 0.25), shaft = p.length(0.16, 0.3), neck = p.length(0.45, 0.3);
    const double ball = p.length(0.24, 0.2), knob = p.length(0.3, 0.35), inner = p.length(0.26, 0.2);
    const Vec3 top(0, 0, length), head = top + neck * Vec3(0.2, 0.8, 0.5), middle(0, 0, 0.75 * length);
    const Limb beside{top, top + knob * Vec3(-0.3, -0.6, 0.6), 1.1 * shaft, 0.9 * shaft};
    const Limb on_shaft{middle, {-0.16, p.shifted(0.05, 0.05), 0.7 * length}, shaft, 0.6 * shaft};
    Body body;
    body.parts.push_back(
        unbent({{Vec3::Zero(), top, shaft, shaft},
                {top, head, 0.8 * ball, ball},
                p.dispensable(beside),
                {{0, 0, 0.1}, {-0.22, p.length(0.25, 0.2), -0.1}, shaft, inner},
                {{0, 0, 0.1}, {-0.2, -p.length(0.25, 0.2), -0.06}, shaft, inner * p.length(0.8, 0.1)},
                p.dispensable(on_shaft)}));
    body.bend = p.any_bend(Vec3::Zero(), Vec3::UnitZ(), 0.2 * length, 0.6 * length, 0.35);
    return body;
}

/// A claw hammer.
Body tool(Proportions& p) {
    const double handle = p.length(2, 0.3), grip = p.length(0.15, 0.3), neck = p.length(0.12, 0.2);
    const double face = p.length(0.55, 0.35), claw = p.length(0.7, 0.35), head = p.length(0.17, 0.25);
    const Vec3 top(0, 0, handle);
    const auto prong = [&](double side) {
        const Vec3 tip(-claw, side * p.length(0.22, 0.3), -0.25);
        return p.dispensable({top - Vec3(0.15, 0, 0), top + tip, 0.11, 0.07});
    };
    const Limb left = prong(1), right = prong(-1);
    Body body;
    body.parts.push_back(
        unbent({{{0, 0, 0}, top, grip, neck},
                {top - Vec3(0.1, 0, 0), top + Vec3(face, 0, 0), head, head},
                {top + Vec3(0.9 * face, 0, 0), top + Vec3(face + 0.05, 0, 0), 1.2 * head, 1.2 * head},
                left,
                right}));
    body.bend = p.any_bend(Vec3::Zero(), Vec3::UnitZ(), 0.3, 0.6 * handle, 0.3);
    return body;
}

/// Seat and back are of slats so thick that no gaps are left; without its back it is a stool.
Body chair(Proportions& p) {
    const double wide = p.length(0.5, 0.2), deep = p.length(0.5, 0.25), leg = p.length(0.9, 0.35);
    const double back = p.length(1, 0.35), recline = p.shifted(0.15, 0.15);
    const double thin = std::max(p.length(0.1, 0.25), wide / 5);
    const bool has_back = !p.dispensable({}).missing;
    std::vector<Limb> slats;
    for (int k = -3; k <= 3; ++k) {
        const Vec3 side(0, k / 3.0 * wide, 0), rear = side - Vec3(deep, 0, 0);
        slats.push_back({rear, side + Vec3(deep, 0, 0), thin, thin});
        slats.push_back({rear, rear + Vec3(-recline * back, 0, back), thin, thin, !has_back});
    }
    Body body;
    body.parts.push_back(unbent(slats));
    for (const double x : {0.9 * deep, -0.9 * deep})
        p.add_sides(body, {{{x, 0.9 * wide, 0}, {x, wide, -leg}, 1.1 * thin, thin}}, 0.2);
    body.bend = p.any_bend(-Vec3::UnitX(), Vec3::UnitX(), 0.6, 0.8, 0.1);
    return body;
}

struct Family {
    const char* name;
    Body (*member)(Proportions&);
};
constexpr Family families[] = {{"biped", biped}, {"quadruped", quadruped}, {"hand", hand},
                               {"bone", bone},   {"tool", tool},           {"chair", chair}};

}  // namespace

const std::vector<std::string>& family_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Family& family : families) list.push_back(family.name);
        return list;
    }();
    return names;
}

Body family_member(int family, const GenerateParams& params, Random& random) {
    Proportions proportions(params, random);
    Body body = families[family].member(proportions);
    body.relief = proportions.relief();
    return body;
}

}  // namespace varimap::shapes
