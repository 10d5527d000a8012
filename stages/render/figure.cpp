#include "stages/render/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "stages/render/openness.h"
#include "varimap/mesh/interpolation.h"

namespace varimap {

namespace {

const Vec3 key =
    Vec3(-.45, .65, .75).normalized();  ///< towards the main light: right, up, towards the viewer

/// Share of a white light that a surface with this normal (right, up, towards the viewer) sends back.
double illumination(const Vec3& normal, double openness) {
    static const Vec3 fill = Vec3(.8, .1, .6).normalized();
    const double sky = .5 + .5 * normal[1];  // hemisphere light: ground to sky
    const double ambient = (.42 + .2 * sky) * openness;
    const double direct = .58 * std::max(0., normal.dot(key)) + .14 * std::max(0., normal.dot(fill));
    return ambient + direct * (.45 + .55 * openness);
}

}  // namespace

Figure::Figure(TriangleMesh mesh, Paint paint, std::vector<bool> flagged)
    : mesh_(std::move(mesh)),
      paint_(std::move(paint)),
      flagged_(std::move(flagged)),
      rays_(mesh_),
      normals_(vertex_normals(mesh_)) {
    constexpr double reach = .5;  // in units of sqrt(area)
    openness_ = ambient_openness(mesh_, normals_, rays_, reach);
}

Colour Figure::shade(const SurfacePoint& point, const Eigen::Matrix3d& view) const {
    Vec3 normal = Vec3::Zero();
    for (const auto [vertex, weight] : WeightedCorners(mesh_, point))
        normal += weight * normals_.row(vertex).transpose();
    const double openness = interpolated(openness_, mesh_, point);
    normal = (view * normal).normalized();
    if ((view.row(2) * face_normal(mesh_, point.face))[0] < 0)
        normal = -normal;  // the inside, through a hole
    const Vec3 half_way = (key + Vec3::UnitZ()).normalized();
    const double gloss = .05 * openness * std::pow(std::max(0., normal.dot(half_way)), 24);
    const Colour colour = flagged_[size_t(point.face)] ? flipped_colour : paint_(point);
    return colour * illumination(normal, openness) + Colour::Constant(gloss);
}

std::vector<bool> reversed_faces(const ImageMesh& images, bool mirror) {
    const double sign = mirror ? -1 : 1;
    std::vector<bool> reversed(size_t(images.source.face_count()));
    for (int f = 0; f < images.source.face_count(); ++f)
        reversed[size_t(f)] = images.is_mapped(f) && !(sign * images.facing(f) > 0);
    return reversed;
}

std::string reversed_text(const std::vector<bool>& source, const std::vector<bool>& target) {
    const auto count = [](const std::vector<bool>& flags) {
        return std::count(flags.begin(), flags.end(), true);
    };
    return fmt::format("reversed, in magenta: {} triangles of the source, {} of the target", count(source),
                       count(target));
}

}  // namespace varimap
