#include "stages/partners/picture.h"

#include <cmath>

#include "varimap/picture/drawing.h"

namespace varimap {

namespace {

/// Towards light grey where the partner is not certain.
Colours carried(const Colours& colours, const std::vector<Partner>& partners) {
    const Eigen::RowVector3d pale = Eigen::RowVector3d::Constant(.85);
    Colours result(Eigen::Index(partners.size()), 3);
    for (std::size_t i = 0; i < partners.size(); ++i) {
        const Partner& partner = partners[i];
        const double share = partner.point < 0 ? 0 : std::sqrt(partner.certainty);
        result.row(Eigen::Index(i)) = (1 - share) * pale;
        if (share > 0) result.row(Eigen::Index(i)) += share * colours.row(partner.point);
    }
    return result;
}

/// The target below the source, so that neither hides the other.
std::string together(const PicturedDomain& source, const PicturedDomain& target, const Points& centres,
                     const Colours& colours) {
    const Points &a = source.domain.mesh.vertices, &b = target.domain.mesh.vertices;
    Points both(a.rows() + b.rows(), 3);
    both << a, b;
    const Eigen::Matrix3d axes = viewing_axes(both);
    const Points seen_a = a * axes;
    Points seen_b = b * axes, images = centres * axes;
    const double lower = seen_b.col(1).maxCoeff() - seen_a.col(1).minCoeff() + .15;
    seen_b.col(1).array() -= lower;
    images.col(1).array() -= lower;
    both << seen_a, seen_b;
    const Frame frame(both, 0);
    Drawing drawing;
    for (Eigen::Index i = 0; i < a.rows(); ++i) drawing.line(seen_a.row(i), images.row(i), "#bbb", .6, frame);
    drawing.domain(source.domain, colours, seen_a, frame);
    drawing.domain(target.domain, carried(colours, target.partners), seen_b, frame);
    return drawing.svg(1);
}

}  // namespace

std::string picture_of(const PicturedDomain& source, const PicturedDomain& target, const Points& centres,
                       Layout layout) {
    const Colours colours = colours_by_place(source.domain);
    if (layout == Layout::together) return together(source, target, centres, colours);
    const Points &a = source.domain.mesh.vertices, &b = target.domain.mesh.vertices;
    const Points seen_a = a * viewing_axes(a), seen_b = b * viewing_axes(b);
    Drawing drawing;
    drawing.domain(source.domain, colours, seen_a, {seen_a, 0});
    drawing.domain(target.domain, carried(colours, target.partners), seen_b, {seen_b, 1});
    return drawing.svg(2);
}

}  // namespace varimap
