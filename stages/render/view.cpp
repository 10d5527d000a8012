#include "stages/render/view.h"

#include <algorithm>
#include <numbers>

#include "varimap/mesh/pattern_axes.h"

namespace varimap {

namespace {

constexpr int x = 0, y = 1, z = 2;

View view_along(int towards, double sign, int up) {
    View view;
    view.row(1) = Vec3::Unit(up);
    view.row(2) = sign * Vec3::Unit(towards);
    view.row(0) = view.row(1).cross(view.row(2));
    return view;
}

}  // namespace

View natural_view(const TriangleMesh& mesh, const std::string& up_name) {
    Vec3 areas = projected_areas(mesh);
    const int up = up_name == "auto" ? likely_up(mesh) : up_name.back() - 'x';
    areas[up] = 0;
    if (up != x) areas[x] /= 1.1;
    const int towards = int(std::max_element(areas.begin(), areas.end()) - areas.begin());
    // Figures face +z where y is up, and -y where z is up.
    View view = view_along(towards, up == z && towards == y ? -1 : 1, up);
    if (up_name.starts_with('-')) view.topRows(2) *= -1;
    return view;
}

View matching_view(const TriangleMesh& mesh, const Points& images, const std::vector<bool>& has_image,
                   const View& other_view) {
    Vec3 centre = Vec3::Zero(), image_centre = Vec3::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double count = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (!has_image[size_t(v)]) continue;
        ++count;
        centre += mesh.vertex(v);
        image_centre += images.row(v).transpose();
        covariance += images.row(v).transpose() * mesh.vertices.row(v);
    }
    covariance -= image_centre * centre.transpose() / std::max(count, 1.);
    const auto agreement_of = [&](const View& view) {
        return (other_view * covariance * view.transpose()).trace();
    };
    View best = natural_view(mesh, "auto");  // stays where the map says nothing
    double best_agreement = agreement_of(best);
    for (int up = 0; up < 3; ++up)
        for (int towards = 0; towards < 3; ++towards)
            for (int signs = 0; signs < 4 && up != towards; ++signs) {
                View view = view_along(towards, signs & 1 ? -1 : 1, up);
                if (signs & 2) view.topRows(2) *= -1;
                const double agreement = agreement_of(view);
                if (agreement > best_agreement) best = view, best_agreement = agreement;
            }
    return best;
}

View moved(const View& view, double azimuth, double elevation) {
    const double degree = std::numbers::pi / 180;
    return Eigen::AngleAxisd(elevation * degree, Vec3::UnitX()) *
           Eigen::AngleAxisd(-azimuth * degree, Vec3::UnitY()) * view;
}

}  // namespace varimap
