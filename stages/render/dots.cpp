#include "stages/render/dots.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "stages/render/lettering.h"

namespace varimap {

namespace {

/// Towards black (0) or white (255), by a share.
void blend(Image& image, int x, int y, double white, double share) {
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
    unsigned char* pixel = &image.rgb[3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
    for (int k = 0; k < 3; ++k)
        pixel[k] = static_cast<unsigned char>(std::lround((1 - share) * pixel[k] + share * white));
}

/// How much of a pixel lies in a disc whose centre is `distance` away.
double within(double radius, double distance) {
    return std::clamp(radius + .5 - distance, 0., 1.);
}

void draw_disc(const Eigen::Vector2d& centre, double radius, Image& image) {
    const int reach = int(radius) + 2, cx = int(centre[0]), cy = int(centre[1]);
    for (int y = cy - reach; y <= cy + reach; ++y)
        for (int x = cx - reach; x <= cx + reach; ++x) {
            const double distance = (Eigen::Vector2d(x + .5, y + .5) - centre).norm();
            blend(image, x, y, 0, within(radius, distance));
            blend(image, x, y, 255, within(.65 * radius, distance));
        }
}

/// Black letters with a white rim.
void draw_number(int number, const Eigen::Vector2d& at, int letter, Image& image) {
    const std::string text = std::to_string(number);
    const int left = int(at[0]), top = int(at[1]);
    draw_text(text, left, top, letter, [&](int x, int y) {
        for (int dy = -letter; dy <= letter; ++dy)
            for (int dx = -letter; dx <= letter; ++dx) blend(image, x + dx, y + dy, 255, 1);
    });
    draw_text(text, left, top, letter, [&](int x, int y) { blend(image, x, y, 0, 1); });
}

/// Whether a ray towards the point meets the surface nowhere before it.
bool is_seen(const Vec3& point, const Eigen::Vector2d& pixel, const Panel& panel) {
    constexpr double skin = .01;  // units of sqrt(area)
    const SurfacePoint hit =
        panel.figure->rays().first_hit(panel.ray_origin(pixel[0], pixel[1]), -panel.view.row(2).transpose());
    if (hit.face < 0) return true;  // on the outline
    return panel.view.row(2).dot(position(panel.figure->mesh(), hit) - point) < skin;
}

}  // namespace

void draw_dots(const std::vector<Vec3>& points, const Panel& panel, int letter, Image& image) {
    const double radius = 2.5 * letter;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector2d pixel = panel.to_pixel(panel.view * points[i]);
        if (!is_seen(points[i], pixel, panel)) continue;
        const Eigen::Vector2d centre = pixel + Eigen::Vector2d(panel.x, panel.y);
        draw_disc(centre, radius, image);
        draw_number(int(i) + 1, centre + radius * Eigen::Vector2d(1.4, -2), letter, image);
    }
}

}  // namespace varimap
