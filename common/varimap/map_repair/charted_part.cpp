#include "varimap/map_repair/charted_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "varimap/core/plane.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/polygon_map.h"

namespace varimap {

namespace {

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    return cross(b - a, c - a) * cross(b - a, d - a) <= 0 && cross(d - c, a - c) * cross(d - c, b - c) <= 0;
}

double twice_area(const Points& polygon) {
    double area = 0;
    for (int i = 0; i < polygon.rows(); ++i) {
        const int j = (i + 1) % int(polygon.rows());
        area += cross(Vec2(polygon.row(i).leftCols<2>()), Vec2(polygon.row(j).leftCols<2>()));
    }
    return area;
}

TriangleMesh of_area(TriangleMesh mesh, double area) {
    mesh.vertices *= std::sqrt(area / surface_area(mesh));
    return mesh;
}

/// Of the areas of a layout's faces: a long limb's tip is smaller, and nothing is felt there.
constexpr double least_ratio = 1e-8;

bool has_collapsed(const TriangleMesh& flat) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (int f = 0; f < flat.face_count(); ++f) {
        const double twice = face_normal(flat, f).norm();
        least = std::min(least, twice);
        most = std::max(most, twice);
    }
    return least < least_ratio * most;
}

bool is_upright(const SlidingMap& flat) {
    for (int f = 0; f < flat.source().face_count(); ++f)
        if (flat.rest(f).area > 0 && !(flat.image_triangle(f).D > 0)) return false;
    return true;
}

/// Walks in a chart, whose faces may be almost without area, may end a little outside a face; false where
/// that makes no sense.
bool clean(PointMap& images) {
    for (SurfacePoint& image : images) {
        if (!image.barycentric.allFinite()) return false;
        image.barycentric = image.barycentric.cwiseMax(0).cwiseMin(1);
        const double sum = image.barycentric.sum();
        if (!(sum > 0.5)) return false;
        image.barycentric /= sum;
    }
    return true;
}

}  // namespace

ChartedPart::ChartedPart(const SlidingMap& map, SubMesh part, std::vector<int> rim, std::vector<int> goal)
    : part_(std::move(part)), goal_(map.target(), std::move(goal)), rim_(std::move(rim)) {
    const std::vector<int> boundary = disc_boundary(goal_.mesh);
    if (boundary.empty()) return;
    for (const int v : part_.vertex)
        if (!map.has_image(v)) return;
    chart_ = circular_chart(goal_.mesh, boundary);
    Points corners(Eigen::Index(rim_.size()), 3);
    for (std::size_t i = 0; i < rim_.size(); ++i) {
        const SurfacePoint image = goal_.on_part(map.point(part_.vertex[std::size_t(rim_[i])]));
        if (image.face < 0) return;
        corners.row(Eigen::Index(i)) = position(chart_, image).transpose();
    }
    corners_ = std::move(corners);
}

bool ChartedPart::has_simple_rim() const {
    const int n = int(corners_.rows());
    const auto at = [&](int i) { return Vec2(corners_.row(i % n).leftCols<2>().transpose()); };
    for (int i = 0; i < n; ++i)
        if (at(i) == at(i + 1)) return false;
    if (!(twice_area(corners_) > 0)) return false;
    for (int i = 0; i < n; ++i)
        for (int j = i + 2; j < n; ++j)
            if ((i > 0 || j < n - 1) && segments_meet(at(i), at(i + 1), at(j), at(j + 1))) return false;
    return true;
}

std::vector<int> ChartedPart::free_vertices(const VertexData<bool>& fixed) const {
    const VertexData<bool> on_rim = rim_vertices();
    std::vector<int> free;
    for (int v = 0; v < part_.mesh.vertex_count(); ++v)
        if (const int u = part_.vertex[std::size_t(v)]; !on_rim[v] && !fixed[u]) free.push_back(u);
    return free;
}

PointMap ChartedPart::unfolded(const SlidingMap& map, const VertexData<bool>& fixed) const {
    const int n = part_.mesh.vertex_count();
    const VertexData<bool> on_rim = rim_vertices();
    VertexData<bool> held = on_rim;
    PointMap present;
    std::vector<Pin> pins;
    for (int v = 0; v < n; ++v) {
        const int u = part_.vertex[std::size_t(v)];
        present.push_back(goal_.on_part(map.point(u)));
        if (on_rim[v] || !fixed[u]) continue;
        if (present.back().face < 0) return {};
        held[v] = true;
        pins.push_back({v, position(chart_, present.back())});
    }
    const TriangleMesh flat = circular_chart(part_.mesh, rim_);
    std::optional<PointMap> homeomorphism;  // once it is asked for; empty where there is none
    const auto images = [&](bool anew) {
        const auto is_wanting = [](const SurfacePoint& image) { return image.face < 0; };
        if (!anew && std::ranges::none_of(present, is_wanting)) return present;
        if (!homeomorphism) homeomorphism = on_chart(map_onto_polygon(flat, rim_, corners_, pins));
        PointMap result = homeomorphism->empty() ? PointMap() : present;
        for (int v = 0; v < int(result.size()); ++v)
            if (SurfacePoint& image = result[std::size_t(v)]; !held[v] && (anew || is_wanting(image)))
                image = (*homeomorphism)[std::size_t(v)];
        return result;
    };
    // As large as the polygon: faces much smaller than at rest would all count as collapsed.
    const double area = twice_area(corners_) / 2;
    const TriangleMesh flat_rest = of_area(flat, area), rest = of_area(part_.mesh, area);
    // From where the images are, and from a homeomorphism, which straight faces may fold; where the layout
    // tells nothing, towards the faces' own shapes, too.
    PointMap whole = unfolded_from(images(false), flat_rest, held, {60, 1000, 2});
    if (whole.empty()) whole = unfolded_from(images(true), flat_rest, held, {150, 1000, 4});
    if (whole.empty() && has_collapsed(flat)) whole = unfolded_from(images(true), rest, held, {150, 1000, 4});
    return whole;
}

PointMap ChartedPart::on_chart(const Points& positions) const {
    const ClosestPoint closest(chart_);
    PointMap points;
    for (const auto& position : positions.rowwise()) points.push_back(closest(position.transpose()).point);
    return points;
}

PointMap ChartedPart::unfolded_from(const PointMap& images, const TriangleMesh& rest,
                                    const VertexData<bool>& held, const FoldRemoval& remove_folds) const {
    if (images.empty()) return {};
    SlidingMap in_chart(images, rest, chart_);
    remove_folds(in_chart, held);
    return is_upright(in_chart) ? on_whole(in_chart) : PointMap();
}

VertexData<bool> ChartedPart::rim_vertices() const {
    VertexData<bool> on_rim(part_.mesh.vertex_count(), false);
    for (const int v : rim_) on_rim[v] = true;
    return on_rim;
}

PointMap ChartedPart::on_whole(const SlidingMap& in_chart) const {
    PointMap images;
    for (const SurfacePoint& point : in_chart.points()) images.push_back(goal_.on_whole(point));
    return clean(images) ? images : PointMap();
}

}  // namespace varimap
