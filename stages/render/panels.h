#pragma once

#include "stages/render/figure.h"
#include "stages/render/render.h"
#include "stages/render/view.h"

namespace varimap {

/// One figure from one side, and the rectangle of the picture that shows it.
struct Panel {
    const Figure* figure;
    View view;
    Points seen;                              ///< the vertices: right, up, towards the viewer
    Eigen::AlignedBox3d box;                  ///< of the faces there
    int x = 0, y = 0, width = 0, height = 0;  ///< pixels, y downwards
    double scale = 1;                         ///< pixels per unit

    Panel(const Figure& figure, const View& view);
    /// Pixel coordinates within the panel of a seen point.
    Eigen::Vector2d to_pixel(const Vec3& p) const;
    Vec3 ray_origin(double px, double py) const;
};

/// White space around every panel's figure, in units of sqrt(area).
inline constexpr double panel_margin = .12;

/// Does nothing outside the image.
void set_pixel(Image& image, int x, int y, const Colour& colour);

/// Draws the panels, with that many rays per pixel, into the rectangles they say.
void trace_panels(const std::vector<Panel>& panels, int samples, Image& image);

/// A figure, its view, what is written above it, and points of it that are marked with dots and numbers from
/// 1 where they can be seen.
struct Exhibit {
    const Figure* figure;
    View view;
    std::string label;
    std::vector<Vec3> points = {};
};

/// Lays out and traces the figures side by side, each from its view (moved as the parameters say) and from
/// the opposite one; `caption`: lines below.
Image draw_panels(const std::vector<Exhibit>& exhibits, const std::vector<std::string>& caption,
                  const RenderParams& params);

}  // namespace varimap
