#include "varimap/relaxation/attachments.h"

#include <cmath>

#include "varimap/mesh/mass.h"

namespace varimap {

namespace {

Vec3 offset(const Attachment& attachment, const MovingMap& map) {
    const auto corners = map.source().faces.row(attachment.from.face);
    Vec3 image = Vec3::Zero();
    for (int k = 0; k < 3; ++k) image += attachment.from.barycentric[k] * map.image(corners[k]);
    return image - attachment.to;
}

}  // namespace

double value(const Attachment& attachment, const MovingMap& map) {
    const double c2 = attachment.reach * attachment.reach;
    return attachment.weight * c2 / 2 * std::log1p(offset(attachment, map).squaredNorm() / c2);
}

AttachmentSystem derivatives(const Attachment& attachment, const MovingMap& map,
                             const std::vector<Eigen::Matrix<double, 3, 2>>& frames) {
    const auto corners = map.source().faces.row(attachment.from.face);
    const Vec3 d = offset(attachment, map);
    Eigen::Matrix<double, 3, 6> J;
    for (int k = 0; k < 3; ++k)
        J.middleCols<2>(2 * k) = attachment.from.barycentric[k] * frames[std::size_t(corners[k])];
    const double u = attachment.weight / (1 + d.squaredNorm() / (attachment.reach * attachment.reach));
    return {u * J.transpose() * d, u * J.transpose() * J};
}

std::vector<Attachment> landmark_attachments(const MovingMap& map, const PointPairs& landmarks) {
    constexpr double weight = 1e4, reach = 1;
    std::vector<Attachment> attachments;
    for (const auto& [from, to] : landmarks)
        if (map.is_mapped(from.face))
            attachments.push_back({from, position(map.target(), to), weight, reach});
    return attachments;
}

std::vector<Attachment> inverse_attachments(const MovingMap& map, const PointMap& back, double weight) {
    const Eigen::VectorXd areas = voronoi_masses(map.target());
    std::vector<Attachment> attachments;
    attachments.reserve(back.size());
    for (int b = 0; b < int(back.size()); ++b) {
        const SurfacePoint& point = back[std::size_t(b)];
        if (point.face >= 0 && map.is_mapped(point.face))
            attachments.push_back({point, map.target().vertex(b), weight * areas[b], inverse_reach});
    }
    return attachments;
}

}  // namespace varimap
