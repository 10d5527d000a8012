#include "stages/render/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "stages/render/bounds.h"

namespace varimap {

SourceColour::SourceColour(const TriangleMesh& source, double cell)
    : low_(bounds(source.vertices, source.faces).min()),
      extent_(bounds(source.vertices, source.faces).sizes()),
      cell_(cell) {
    std::array<int, 3> axes{0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return extent_[a] > extent_[b]; });
    first_ = axes[0], second_ = axes[1], third_ = axes[2];
    extent_ = extent_.cwiseMax(1e-12);
}

Colour SourceColour::operator()(const Vec3& point) const {
    const Vec3 t = (point - low_).cwiseQuotient(extent_);
    // The grid is shifted so that planes of symmetry do not coincide with its cells' faces.
    const Vec3 cell = ((point - low_ - extent_ / 2) / cell_ + Vec3(.5, .37, .43)).array().floor();
    const bool dark = (long(cell[0]) + long(cell[1]) + long(cell[2])) & 1;
    const double hue = 2 * std::numbers::pi * (.06 + .70 * t[first_] + .24 * (t[second_] - .5));
    const double lightness = .76 + .12 * (t[second_] - .5) - .1 * (t[third_] - .5) - (dark ? .17 : 0);
    const double chroma = .12 + .1 * (t[third_] - .5);  // pale on one side: mirrored maps must show
    return from_oklch(lightness, chroma, hue);
}

Colour from_oklch(double lightness, double chroma, double hue) {
    const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
    const auto cube = [](double x) { return x * x * x; };
    const double l = cube(lightness + .3963377774 * a + .2158037573 * b);
    const double m = cube(lightness - .1055613458 * a - .0638541728 * b);
    const double s = cube(lightness - .0894841775 * a - 1.2914855480 * b);
    const Colour rgb(4.0767416621 * l - 3.3077115913 * m + .2309699292 * s,
                     -1.2684380046 * l + 2.6097574011 * m - .3413193965 * s,
                     -.0041960863 * l - .7034186147 * m + 1.7076147010 * s);
    return rgb.cwiseMax(0).cwiseMin(1);
}

unsigned char encode_channel(double linear) {
    const double x = std::clamp(linear, 0., 1.);
    const double encoded = x <= .0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - .055;
    return static_cast<unsigned char>(std::lround(255 * encoded));
}

}  // namespace varimap
