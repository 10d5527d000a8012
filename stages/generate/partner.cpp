#include "stages/generate/partner.h"

#include <algorithm>
#include <cmath>

namespace varimap::shapes {

namespace {

/// The limb that alone decides there: the next one is farther by more than limbs blend over. -1: none does.
int deciding_limb(const std::vector<Limb>& limbs, const Vec3& point) {
    constexpr double clear = 0.08;
    std::vector<double> distance;
    for (const Limb& limb : limbs) distance.push_back(limb.distance(point));
    const auto nearest = std::min_element(distance.begin(), distance.end());
    const auto near = [&](double d) { return d < *nearest + clear; };
    return std::count_if(distance.begin(), distance.end(), near) == 1 ? int(nearest - distance.begin()) : -1;
}

/// Where the ray from inside first leaves the surface.
Vec3 way_out(const BodyDistance& distance, const Vec3& from, const Vec3& direction) {
    constexpr double step = 0.01;
    double outside = step;
    while (outside < 10 && distance(from + outside * direction) < 0) outside += step;
    double inside = outside - step;
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = (inside + outside) / 2;
        (distance(from + middle * direction) < 0 ? inside : outside) = middle;
    }
    return from + inside * direction;
}

}  // namespace

Partner::Partner(const Body& from, const Body& to)
    : limbs_(from.limbs()), others_(to.limbs()), distance_(to) {}

/// Limbs of different directions are laid onto each other by the least rotation.
std::optional<Vec3> Partner::operator()(const Vec3& point) const {
    const int k = deciding_limb(limbs_, point);
    if (k < 0 || others_[std::size_t(k)].missing) return {};
    const Limb &limb = limbs_[std::size_t(k)], &other = others_[std::size_t(k)];
    const Vec3 axis = limb.b - limb.a, other_axis = other.b - other.a;
    const double t = std::clamp((point - limb.a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    const Vec3 direction =
        Eigen::Quaterniond::FromTwoVectors(axis, other_axis) * (point - limb.a - t * axis).normalized();
    const Vec3 image = way_out(distance_, other.a + t * other_axis, direction);
    if (deciding_limb(others_, image) != k) return {};
    return image;
}

}  // namespace varimap::shapes
