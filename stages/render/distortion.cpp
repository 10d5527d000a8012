#include "stages/render/distortion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "stages/render/lettering.h"
#include "stages/render/panels.h"
#include "varimap/core/log.h"
#include "varimap/mesh/interpolation.h"

namespace varimap {

namespace {

/// Blue at 1 / range, light grey at 1, red at range, in steps of the logarithm.
Colour ratio_colour(double ratio, double range) {
    if (!std::isfinite(ratio)) return unmapped_colour;
    const double t = std::clamp(std::log(std::max(ratio, 1e-300)) / std::log(range), -1., 1.);
    return from_oklch(.93 - .42 * std::abs(t), .18 * std::abs(t), t < 0 ? 4.6 : .5);
}

/// Light yellow at 1 to dark violet at range.
Colour conformal_colour(double distortion, double range) {
    if (!std::isfinite(distortion)) return unmapped_colour;
    const double t = std::clamp(std::log(distortion) / std::log(range), 0., 1.);
    return from_oklch(.95 - .62 * t, .06 + .1 * t, 1.8 - 3.1 * t);
}

/// What a column shows: its name, its values and its scale.
struct Quantity {
    std::string name;
    std::function<double(const DistortedSurface&, const SurfacePoint&)> value;
    std::function<Colour(double)> colour;
    double low, high;  ///< ends of the scale, logarithmic
};

double mass_ratio(const DistortedSurface& surface, const SurfacePoint& p) {
    return interpolated(surface.mass_ratio, surface.mesh, p);
}

const TriangleDistortion& triangle(const DistortedSurface& surface, const SurfacePoint& p) {
    return surface.triangles[size_t(p.face)];
}

std::array<Quantity, 3> quantities(const RenderParams& params) {
    const auto ratio = [r = params.ratio_range](double x) { return ratio_colour(x, r); };
    const auto conformal = [r = params.conformal_range](double x) { return conformal_colour(x, r); };
    const auto measured = [](const DistortedSurface& s, const SurfacePoint& p,
                             double TriangleDistortion::*value) {
        return triangle(s, p).area > 0 ? triangle(s, p).*value : std::nan("");
    };
    return {
        Quantity{"mass ratio", mass_ratio, ratio, 1 / params.ratio_range, params.ratio_range},
        Quantity{
            "area ratio",
            [=](const auto& s, const auto& p) { return measured(s, p, &TriangleDistortion::area_ratio); },
            ratio, 1 / params.ratio_range, params.ratio_range},
        Quantity{"conformal distortion",
                 [=](const auto& s, const auto& p) { return measured(s, p, &TriangleDistortion::conformal); },
                 conformal, 1, params.conformal_range}};
}

/// A bar of the quantity's colours between its ends, with numbers at both ends and in the middle, and its
/// name.
void draw_scale(const Quantity& quantity, int left, int top, int width, int letter, Image& image) {
    const int bar = width * 3 / 5, start = left + (width - bar) / 2, height = 2 * letter_height * letter;
    for (int x = 0; x < bar; ++x) {
        const double value = quantity.low * std::pow(quantity.high / quantity.low, (x + .5) / bar);
        for (int y = 0; y < height; ++y) set_pixel(image, start + x, top + y, quantity.colour(value));
    }
    const auto write = [&](const std::string& text, int centre, int y) {
        draw_text(text, centre - text_width(text) * letter / 2, y, letter,
                  [&](int px, int py) { set_pixel(image, px, py, Colour::Zero()); });
    };
    const int below = top + height + letter_height * letter / 2;
    for (const double share : {0., .5, 1.})
        write(fmt::format("{:.3g}", quantity.low * std::pow(quantity.high / quantity.low, share)),
              start + int(share * bar), below);
    write(quantity.name, left + width / 2, below + 3 * letter_height * letter / 2);
}

/// Rows of panels, each of the height its surface needs; returns the height of all.
int lay_out_grid(std::vector<Panel>& panels, int columns, int picture_width) {
    double widest = 0, highest = 0;
    for (const Panel& p : panels) {
        widest = std::max(widest, p.box.sizes()[0] + panel_margin);
        highest = std::max(highest, p.box.sizes()[1] + panel_margin);
    }
    // A long thin figure must not make the picture endless.
    const double scale = std::min(picture_width / (columns * widest), 2 * picture_width / highest);
    int top = 0;
    for (size_t first = 0; first < panels.size(); first += size_t(columns)) {
        const int height = int(std::lround((panels[first].box.sizes()[1] + panel_margin) * scale));
        for (int c = 0; c < columns; ++c) {
            Panel& p = panels[first + size_t(c)];
            p.x = c * picture_width / columns, p.width = picture_width / columns;
            p.y = top, p.height = height, p.scale = scale;
        }
        top += height;
    }
    return top;
}

/// Per triangle: whether it is reversed or collapsed, and that is to be shown.
std::vector<bool> flagged(const DistortedSurface& surface, const RenderParams& params) {
    std::vector<bool> flags;
    for (const TriangleDistortion& t : surface.triangles)
        flags.push_back(params.flips && t.area > 0 && (t.collapsed || t.flipped != params.mirror));
    return flags;
}

}  // namespace

Image draw_distortion(const DistortedSurface& source, const DistortedSurface& target,
                      const RenderParams& params) {
    const auto columns = quantities(params);
    std::vector<Figure> figures;
    figures.reserve(6);
    std::vector<Panel> panels;
    const std::vector<bool> source_flags = flagged(source, params), target_flags = flagged(target, params);
    if (params.flips) log("{}", reversed_text(source_flags, target_flags));
    for (const DistortedSurface* surface : {&source, &target})
        for (const Quantity& q : columns) {
            figures.emplace_back(
                surface->mesh,
                [&q, surface](const SurfacePoint& p) { return q.colour(q.value(*surface, p)); },
                surface == &source ? source_flags : target_flags);
            panels.emplace_back(figures.back(), surface->view);
        }
    const int letter = std::max(1, params.width / 600), scale_height = 7 * letter_height * letter;
    const int height = lay_out_grid(panels, int(columns.size()), params.width);
    Image image{params.width, height + scale_height, {}};
    image.rgb.assign(3 * size_t(image.width) * size_t(image.height), 255);
    trace_panels(panels, params.samples, image);
    for (int c = 0; c < int(columns.size()); ++c)
        draw_scale(columns[size_t(c)], panels[size_t(c)].x, height + letter_height * letter,
                   panels[size_t(c)].width, letter, image);
    return image;
}

}  // namespace varimap
