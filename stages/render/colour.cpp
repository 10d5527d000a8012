#include "stages/render/colour.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stages/render/bounds.h"
#include "varimap/mesh/pattern_axes.h"

namespace varimap {

namespace {

/// Dark blue to yellow, of growing lightness: sRGB as it is encoded. The viewer's page has the same.
const std::array<Vec3, 5> cividis{Vec3(0x00, 0x22, 0x4e) / 255., Vec3(0x3b, 0x49, 0x6c) / 255.,
                                  Vec3(0x7c, 0x7b, 0x78) / 255., Vec3(0xbc, 0xaf, 0x6f) / 255.,
                                  Vec3(0xfe, 0xe8, 0x38) / 255.};

Vec3 ramp(double t) {
    const double s = std::clamp(t, 0., 1.) * (cividis.size() - 1);
    const std::size_t i = std::min(cividis.size() - 2, std::size_t(s));
    return cividis[i] + (s - double(i)) * (cividis[i + 1] - cividis[i]);
}

Vec3 mixed(const Vec3& colour, double grey, double share) {
    return (1 - share) * colour + Vec3::Constant(share * grey);
}

double decode_channel(double encoded) {
    return encoded <= .04045 ? encoded / 12.92 : std::pow((encoded + .055) / 1.055, 2.4);
}

}  // namespace

SourceColour::SourceColour(const TriangleMesh& source, double cell)
    : middle_(bounds(source.vertices, source.faces).center()), cell_(cell) {
    axes_ = pattern_axes(source);
    reach_ = std::max(bounds(source.vertices, source.faces).sizes()[axes_[0]], 1e-12);
}

Colour SourceColour::operator()(const Vec3& point) const {
    Vec3 place;
    for (int k = 0; k < 3; ++k) place[k] = point[axes_[std::size_t(k)]] - middle_[axes_[std::size_t(k)]];
    // The grid is shifted so that planes of symmetry do not coincide with its cells' faces.
    const Vec3 cell = (place / cell_ + Vec3(.5, .37, .43)).array().floor();
    const bool dark = (long(cell[0]) + long(cell[1]) + long(cell[2])) & 1;
    const double contrast = place[1] > 0 ? .34 : .12;
    Vec3 colour = mixed(ramp(place[0] / reach_ + .5), dark ? 0 : 1, contrast);
    const double across = 2 * (place[0] + place[1]) / cell_;
    if (place[2] > 0 && across - std::floor(across) < .3) colour = mixed(colour, dark ? 1 : 0, .6);
    return colour.unaryExpr(&decode_channel);
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
