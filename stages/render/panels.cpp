#include "stages/render/panels.h"

#include <algorithm>
#include <cmath>

#include "stages/render/bounds.h"
#include "stages/render/dots.h"
#include "stages/render/lettering.h"
#include "varimap/core/parallel.h"

namespace varimap {

namespace {

/// Places the panels (each figure, then its back) below a strip of height `top`; returns the height of the
/// picture.
int lay_out(std::vector<Panel>& panels, int picture_width, int top) {
    double sum = 0, height = 0;
    std::vector<double> widths;
    for (size_t i = 0; i < panels.size(); i += 2) {
        const Vec3 a = panels[i].box.sizes(), b = panels[i + 1].box.sizes();
        sum += widths.emplace_back(std::max(a[0], b[0]) + panel_margin);
        height = std::max({height, a[1] + panel_margin, b[1] + panel_margin});
    }
    const bool in_a_row = height > .8 * sum;
    const double total = (in_a_row ? 2 : 1) * sum;
    // A long thin figure must not make the picture endless.
    const double scale = std::min(picture_width / total, 2. * picture_width / ((in_a_row ? 1 : 2) * height));
    const int panel_height = std::max(1, int(std::lround(height * scale)));
    double left = 0;
    for (size_t i = 0; i < panels.size(); ++i) {
        Panel& p = panels[i];
        const double right = left + widths[i / 2];
        p.x = int(std::lround(left / total * picture_width));
        p.width = int(std::lround(right / total * picture_width)) - p.x;
        p.y = top + (!in_a_row && i % 2 ? panel_height : 0);
        p.height = panel_height;
        p.scale = scale;
        if (in_a_row || i % 2) left = right;
    }
    return top + (in_a_row ? panel_height : 2 * panel_height);
}

/// Black letters around the middle `x`.
void write(const std::string& text, int x, int y, int size, Image& image) {
    draw_text(text, x - size * text_width(text) / 2, y, size,
              [&](int px, int py) { set_pixel(image, px, py, Colour::Zero()); });
}

/// Writes each label above the middle of its panel.
void write_labels(const std::vector<Exhibit>& exhibits, const std::vector<Panel>& panels, int size,
                  Image& image) {
    for (size_t i = 0; i < exhibits.size(); ++i)
        write(exhibits[i].label, panels[2 * i].x + panels[2 * i].width / 2, size * letter_height / 2, size,
              image);
}

/// Pixels whose rays may hit the figure: those under the bounding boxes of its triangles.
std::vector<bool> touched_pixels(const Panel& panel) {
    std::vector<bool> touched(size_t(panel.width) * size_t(panel.height));
    const TriangleMesh& mesh = panel.figure->mesh();
    for (int f = 0; f < mesh.face_count(); ++f) {
        Eigen::Array2d low = Eigen::Array2d::Constant(1e9), high = -low;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Array2d p = panel.to_pixel(panel.seen.row(mesh.faces(f, k)).transpose()).array();
            low = low.min(p), high = high.max(p);
        }
        const int x_end = std::min(panel.width, int(high[0] + .01) + 1);
        const int y_end = std::min(panel.height, int(high[1] + .01) + 1);
        for (int y = std::max(0, int(low[1] - .01)); y < y_end; ++y)
            for (int x = std::max(0, int(low[0] - .01)); x < x_end; ++x)
                touched[size_t(y) * size_t(panel.width) + size_t(x)] = true;
    }
    return touched;
}

/// Places within a pixel: the R2 sequence (Roberts 2018), evenly spread for any number.
std::vector<Eigen::Vector2d> sample_places(int count) {
    std::vector<Eigen::Vector2d> places;
    for (int i = 0; i < count; ++i) {
        const double u = .5 + .7548776662466927 * i, v = .5 + .5698402909980532 * i;
        places.emplace_back(u - std::floor(u), v - std::floor(v));
    }
    return places;
}

Colour sample_colour(const Panel& panel, double px, double py) {
    const SurfacePoint hit =
        panel.figure->rays().first_hit(panel.ray_origin(px, py), -panel.view.row(2).transpose());
    if (hit.face < 0) return Colour::Ones();
    return panel.figure->shade(hit, panel.view).cwiseMin(1);
}

/// Mean over the places; where the first few agree, the pixel lies inside a cell and needs no more.
Colour pixel_colour(const Panel& panel, int x, int y, const std::vector<Eigen::Vector2d>& places) {
    constexpr int few = 4;
    constexpr double agreement = .015;
    Colour sum = Colour::Zero(), low = Colour::Ones(), high = Colour::Zero();
    int count = 0;
    for (const auto& place : places) {
        const Colour colour = sample_colour(panel, x + place[0], y + place[1]);
        sum += colour, low = low.cwiseMin(colour), high = high.cwiseMax(colour);
        if (++count == few && (high - low).maxCoeff() < agreement) break;
    }
    return sum / count;
}

void trace(const Panel& panel, const std::vector<Eigen::Vector2d>& places, Image& image) {
    const auto touched = touched_pixels(panel);
    parallel_for_each_index(panel.height, 4, [&](int y) {
        for (int x = 0; x < panel.width; ++x) {
            if (!touched[size_t(y) * size_t(panel.width) + size_t(x)]) continue;
            const Colour colour = pixel_colour(panel, x, y, places);
            unsigned char* pixel =
                &image.rgb[3 * (size_t(panel.y + y) * size_t(image.width) + size_t(panel.x + x))];
            for (int k = 0; k < 3; ++k) pixel[k] = encode_channel(colour[k]);
        }
    });
}

}  // namespace

Panel::Panel(const Figure& f, const View& v)
    : figure(&f), view(v), seen(f.mesh().vertices * v.transpose()), box(bounds(seen, f.mesh().faces)) {}

Eigen::Vector2d Panel::to_pixel(const Vec3& p) const {
    return {width / 2. + (p[0] - box.center()[0]) * scale, height / 2. - (p[1] - box.center()[1]) * scale};
}

Vec3 Panel::ray_origin(double px, double py) const {
    return view.transpose() * Vec3(box.center()[0] + (px - width / 2.) / scale,
                                   box.center()[1] - (py - height / 2.) / scale, box.max()[2] + 1);
}

void trace_panels(const std::vector<Panel>& panels, int samples, Image& image) {
    const auto places = sample_places(samples);
    for (const Panel& panel : panels) trace(panel, places, image);
}

void set_pixel(Image& image, int x, int y, const Colour& colour) {
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
    for (int k = 0; k < 3; ++k)
        image.rgb[3 * (size_t(y) * size_t(image.width) + size_t(x)) + size_t(k)] = encode_channel(colour[k]);
}

Image draw_panels(const std::vector<Exhibit>& exhibits, const std::vector<std::string>& caption,
                  const RenderParams& params) {
    std::vector<Panel> panels;
    for (const Exhibit& e : exhibits)
        for (const double turn : {0., 180.})
            panels.emplace_back(*e.figure, moved(e.view, params.azimuth + turn, params.elevation));
    const int letter = std::max(1, params.width / 600), line = 2 * letter * letter_height;
    const int bottom = lay_out(panels, params.width, line);
    Image image{params.width, bottom + line * int(caption.size()), {}};
    image.rgb.assign(3 * size_t(image.width) * size_t(image.height), 255);
    trace_panels(panels, params.samples, image);
    for (size_t i = 0; i < panels.size(); ++i) draw_dots(exhibits[i / 2].points, panels[i], letter, image);
    write_labels(exhibits, panels, letter, image);
    for (size_t i = 0; i < caption.size(); ++i)
        write(caption[i], params.width / 2, bottom + int(i) * line, letter, image);
    return image;
}

}  // namespace varimap
