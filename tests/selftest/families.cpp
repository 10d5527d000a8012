#include "selftest/families.h"

#include <algorithm>
#include <cmath>

namespace varimap::shapes {

namespace {

/// Lengths and angles of one member. x forward, y left, z up.
class Proportions {
  public:
    Proportions(double variation, double bending, Random& random)
        : variation_(variation), bending_(bending), random_(random) {}

    /// `typical` times or by up to exp(spread).
    double length(double typical, double spread) {
        return typical * std::exp(variation_ * spread * random_.between(-1, 1));
    }
    /// `typical` more or less up to `spread`.
    double shifted(double typical, double spread) {
        return typical + variation_ * spread * random_.between(-1, 1);
    }
    /// A limb with what hangs on it, bent in its middle.
    Part bent(std::vector<Limb> limbs, double root) {
        const Limb& limb = limbs.front();
        const Vec3 axis = (limb.b - limb.a).normalized(), towards = random_.direction();
        const double reach = std::max((limb.b - limb.a).norm() - root, 0.1);
        const Vec3 direction = (towards - towards.dot(axis) * axis).normalized();
        return {std::move(limbs),
                {limb.a, axis, direction, root, 0.7 * reach, bending_ * random_.between(0, 0.8)}};
    }
    Bend trunk(const Vec3& from, const Vec3& axis, double start, double reach, double angle) {
        const Vec3 towards = random_.direction();
        return {from,  axis,  (towards - towards.dot(axis) * axis).normalized(),
                start, reach, bending_ * random_.between(0, angle)};
    }

  private:
    double variation_, bending_;
    Random& random_;
};

Vec3 reflected(const Vec3& p) {
    return {p[0], -p[1], p[2]};
}
std::vector<Limb> reflected(std::vector<Limb> limbs) {
    for (Limb& limb : limbs) limb.a = reflected(limb.a), limb.b = reflected(limb.b);
    return limbs;
}
/// Both sides' parts, bent each in its way.
void add_sides(Body& body, const std::vector<Limb>& left, double root, Proportions& p) {
    body.parts.push_back(p.bent(left, root));
    body.parts.push_back(p.bent(reflected(left), root));
}
Part unbent(std::vector<Limb> limbs) {
    return {std::move(limbs), {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 0, 1, 0}};
}

/// Upright, from people to apes: shoulders ahead of the hips, bellies, arms longer than legs.
Body biped(Proportions p) {
    const double height = p.length(0.85, 0.2), hip = p.length(0.25, 0.25), chest = p.length(0.3, 0.25);
    const double lean = p.shifted(0.1, 0.2), width = p.length(0.2, 0.3);
    const Vec3 shoulder(lean, 0, height);
    Body body;
    const double belly = p.length(0.22, 0.4);
    body.parts.push_back(unbent({{Vec3::Zero(), shoulder, hip, chest},
                                 {{0, 0, 0.3 * height}, {0.12 * belly / 0.22, 0, 0.3 * height}, hip, belly}}));
    const double head = p.length(0.21, 0.2), jaw = p.length(0.14, 0.6);
    const Vec3 crown = shoulder + Vec3(p.shifted(0.03, 0.1), 0, chest + p.length(0.4, 0.3));
    const double neck = p.length(0.13, 0.3);
    body.parts.push_back(p.bent({{shoulder, crown, neck, head},
                                 {crown, crown + Vec3(head + jaw, 0, -0.08), 0.6 * head, 0.3 * head}},
                                0.3));
    const double arm = p.length(0.95, 0.35), leg = p.length(1.1, 0.3);
    const double thin = p.length(0.12, 0.35), thick = p.length(0.16, 0.3);
    const Vec3 armpit = shoulder + Vec3(0, width, -0.05), hand = armpit + arm * Vec3(0.1, 0.9, -0.35);
    add_sides(body,
              {{armpit, hand, thin, 0.8 * thin},
               {hand, hand + Vec3(0.1, 0.12, -0.06), 0.9 * thin, 0.7 * thin}},
              0.25, p);
    const Vec3 groin(0, 0.7 * width, 0), heel = groin + leg * Vec3(0, 0.12, -1);
    const double foot = p.length(0.28, 0.35), sole = p.length(0.1, 0.2);
    add_sides(body,
              {{groin, heel, thick, 0.65 * thick}, {heel, heel + Vec3(foot, 0.05, -0.02), sole, 0.75 * sole}},
              0.3, p);
    body.bend = p.trunk({0, 0, 0.1}, Vec3::UnitZ(), 0, 0.6 * height, 0.4);
    return body;
}

Body quadruped(Proportions p) {
    const double half = p.length(0.8, 0.25), girth = p.length(0.38, 0.3), rump = p.length(0.38, 0.25);
    const double fore = p.length(0.95, 0.4), hind = fore * p.length(1, 0.2), stout = p.length(0.16, 0.35);
    Body body;
    body.parts.push_back(unbent({{{-half, 0, 0}, {half, 0, p.shifted(0.05, 0.1)}, rump, girth},
                                 {{-0.2, 0, 0}, {0.2, 0, -p.length(0.1, 0.8)}, girth, girth}}));
    const double track = p.length(0.22, 0.25), hoof = p.length(0.14, 0.4);
    for (const auto& [x, length] : {std::pair(0.85 * half, fore), std::pair(-0.85 * half, hind)}) {
        const Vec3 top(x, track, -0.15), end(x + (x < 0 ? -0.06 : 0.03), 1.15 * track, -0.2 - length);
        add_sides(body,
                  {{top, end, 1.2 * stout, 0.75 * stout},
                   {end, end + Vec3(hoof, 0, -0.02), 0.8 * stout, 0.7 * stout}},
                  0.3, p);
    }
    const double neck = p.length(0.6, 0.45), rise = p.shifted(0.8, 0.5), head = p.length(0.22, 0.3);
    const Vec3 withers(half, 0, 0.1), crown = withers + neck * Vec3(std::cos(rise), 0, std::sin(rise)) +
                                             Vec3(0.6 * girth, 0, 0);
    const double snout = p.length(0.4, 0.5), ear = p.length(0.3, 0.6);
    const std::vector<Limb> left_ear{{crown + Vec3(-0.04, 0.5 * head, 0.3 * head),
                                      crown + Vec3(-0.08, 0.7 * head + 0.4 * ear, 0.4 * head + ear), 0.1, 0.08}};
    std::vector<Limb> front{{withers, crown, p.length(0.22, 0.3), head},
                            {crown, crown + Vec3(snout, 0, -0.12), head, p.length(0.6, 0.3) * head}};
    front.insert(front.end(), left_ear.begin(), left_ear.end());
    for (const Limb& limb : reflected(left_ear)) front.push_back(limb);
    body.parts.push_back(p.bent(front, 0.3));
    const double tail = p.length(0.8, 0.6), droop = p.shifted(0, 0.6);
    const Vec3 dock(-half, 0, 0.1);
    body.parts.push_back(p.bent({{dock, dock + (tail + rump) * Vec3(-std::cos(droop), 0, -std::sin(droop)),
                                  p.length(0.13, 0.3), p.length(0.09, 0.3)}},
                                0.3));
    body.bend = p.trunk(-Vec3::UnitX(), Vec3::UnitX(), 0.6, 0.8, 0.4);
    return body;
}

/// Of a right hand: fingers along x, the thumb towards y, the back up.
Body hand(Proportions p) {
    const double palm = p.length(0.7, 0.2), breadth = p.length(0.5, 0.2), thick = p.length(0.16, 0.25);
    Body body;
    std::vector<Limb> bones;
    for (const double side : {-1.0, -0.33, 0.33, 1.0})
        bones.push_back({{-0.5 * palm, 0.6 * side * breadth, 0}, {0.5 * palm, side * breadth, 0}, 1.1 * thick, thick});
    const double wrist = p.length(0.6, 0.4);
    bones.push_back({{-0.5 * palm, 0, 0}, {-0.5 * palm - wrist, 0, 0}, 1.5 * thick, 1.4 * thick});
    bones.push_back({{-0.3 * palm, 0.7 * breadth, -0.05}, {0, 0.7 * breadth, -0.14}, thick, thick});
    body.parts.push_back(unbent(bones));
    const double lengths[] = {0.6, 0.8, 0.85, 0.75};
    for (int k = 0; k < 4; ++k) {
        const double side = -1 + 2 * k / 3.0, length = p.length(lengths[k], 0.25), width = p.length(0.12, 0.2);
        const Vec3 knuckle(0.5 * palm, side * breadth, 0);
        body.parts.push_back(
            p.bent({{knuckle, knuckle + (length + thick) * Vec3(1, 0.2 * side, 0), width, 0.8 * width}}, thick));
    }
    const double thumb = p.length(0.7, 0.25), width = p.length(0.14, 0.2);
    const Vec3 root(-0.2 * palm, 0.9 * breadth, -0.08);
    body.parts.push_back(p.bent({{root, root + (thumb + thick) * Vec3(0.55, 0.8, -0.2), width, 0.8 * width}}, thick));
    body.bend = p.trunk(-Vec3::UnitX(), Vec3::UnitX(), 0.8, 0.6, 0.2);
    return body;
}

/// A thigh bone: a ball on a neck, a knob beside it, two unequal condyles.
Body bone(Proportions p) {
    const double length = p.length(2, 0.25), shaft = p.length(0.16, 0.3), neck = p.length(0.45, 0.3);
    const double ball = p.length(0.24, 0.2), knob = p.length(0.3, 0.35), inner = p.length(0.26, 0.2);
    const Vec3 top(0, 0, length), head = top + neck * Vec3(0.2, 0.8, 0.5);
    Body body;
    body.parts.push_back(unbent(
        {{Vec3::Zero(), top, shaft, shaft},
         {top, head, 0.8 * ball, ball},
         {top, top + knob * Vec3(-0.3, -0.6, 0.6), 1.1 * shaft, 0.9 * shaft},
         {{0, 0, 0.1}, {-0.22, p.length(0.25, 0.2), -0.1}, shaft, inner},
         {{0, 0, 0.1}, {-0.2, -p.length(0.25, 0.2), -0.06}, shaft, inner * p.length(0.8, 0.1)},
         {{0, 0, 0.75 * length}, {-0.16, p.shifted(0.05, 0.05), 0.7 * length}, shaft, 0.6 * shaft}}));
    body.bend = p.trunk(Vec3::Zero(), Vec3::UnitZ(), 0.2 * length, 0.6 * length, 0.35);
    return body;
}

/// A claw hammer.
Body tool(Proportions p) {
    const double handle = p.length(2, 0.3), grip = p.length(0.15, 0.3), neck = p.length(0.12, 0.2);
    const double face = p.length(0.55, 0.35), claw = p.length(0.7, 0.35), head = p.length(0.17, 0.25);
    const Vec3 top(0, 0, handle);
    const auto prong = [&](double side) {
        return Limb{top - Vec3(0.15, 0, 0), top + Vec3(-claw, side * p.length(0.22, 0.3), -0.25), 0.11, 0.07};
    };
    Body body;
    const Limb left = prong(1), right = prong(-1);
    body.parts.push_back(unbent({{{0, 0, 0}, top, grip, neck},
                                 {top - Vec3(0.1, 0, 0), top + Vec3(face, 0, 0), head, head},
                                 {top + Vec3(0.9 * face, 0, 0), top + Vec3(face + 0.05, 0, 0), 1.2 * head, 1.2 * head},
                                 left,
                                 right}));
    body.bend = p.trunk(Vec3::Zero(), Vec3::UnitZ(), 0.3, 0.6 * handle, 0.3);
    return body;
}

Body chair(Proportions p) {
    const double wide = p.length(0.5, 0.2), deep = p.length(0.5, 0.25), leg = p.length(0.9, 0.35);
    const double back = p.length(1, 0.35), thin = p.length(0.1, 0.25), recline = p.shifted(0.15, 0.15);
    Body body;
    std::vector<Limb> slats;
    for (int k = -3; k <= 3; ++k)
        slats.push_back({{-deep, k / 3.0 * wide, 0}, {deep, k / 3.0 * wide, 0}, thin, thin});
    for (int k = -3; k <= 3; ++k)
        slats.push_back({{-deep, k / 3.0 * wide, 0}, {-deep - recline * back, k / 3.0 * wide, back}, thin, thin});
    body.parts.push_back(unbent(slats));
    for (const double x : {0.9 * deep, -0.9 * deep})
        add_sides(body, {{{x, 0.9 * wide, 0}, {x, wide, -leg}, 1.1 * thin, thin}}, 0.2, p);
    body.bend = p.trunk(-Vec3::UnitX(), Vec3::UnitX(), 0.6, 0.8, 0.1);
    return body;
}

struct Family {
    const char* name;
    Body (*member)(Proportions);
};
constexpr Family families[] = {{"biped", biped}, {"quadruped", quadruped}, {"hand", hand},
                               {"bone", bone},   {"tool", tool},           {"chair", chair}};

/// Along a limb, and across towards a direction of its own.
Eigen::Matrix3d frame_of(const Limb& limb, int reference) {
    Eigen::Matrix3d frame;
    frame.col(0) = (limb.b - limb.a).normalized();
    const Vec3 other = Vec3::Unit(reference);
    frame.col(1) = (other - other.dot(frame.col(0)) * frame.col(0)).normalized();
    frame.col(2) = frame.col(0).cross(frame.col(1));
    return frame;
}

/// Where the ray from inside leaves the surface.
Vec3 way_out(const std::vector<Limb>& limbs, const Vec3& from, const Vec3& direction, double reach) {
    double inside = 0, outside = reach;
    for (int step = 0; step < 50; ++step) {
        const double middle = (inside + outside) / 2;
        (smooth_distance(limbs, from + middle * direction) < 0 ? inside : outside) = middle;
    }
    return from + inside * direction;
}

}  // namespace

const std::vector<std::string>& family_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Family& family : families) list.push_back(family.name);
        return list;
    }();
    return names;
}

Body family_member(int family, double variation, double bending, Random& random) {
    return families[family].member(Proportions(variation, bending, random));
}

std::optional<Vec3> partner(const Body& from, const Body& to, const Vec3& point) {
    constexpr double clear = 0.08;  // the next limb is farther by that
    const std::vector<Limb> limbs = from.limbs(), others = to.limbs();
    std::vector<double> distance;
    for (const Limb& limb : limbs) distance.push_back(limb.distance(point));
    const std::size_t k =
        std::size_t(std::min_element(distance.begin(), distance.end()) - distance.begin());
    for (std::size_t i = 0; i < limbs.size(); ++i)
        if (i != k && distance[i] < distance[k] + clear) return {};
    const Limb &limb = limbs[k], &other = others[k];
    const Vec3 axis = limb.b - limb.a;
    const double t = std::clamp((point - limb.a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    int reference;
    axis.cwiseAbs().minCoeff(&reference);
    const Vec3 direction =
        frame_of(other, reference) * frame_of(limb, reference).transpose() * (point - limb.a - t * axis).normalized();
    const Vec3 centre = other.a + t * (other.b - other.a);
    return way_out(others, centre, direction, 3 * std::max(other.ra, other.rb) + 0.3);
}

}  // namespace varimap::shapes
