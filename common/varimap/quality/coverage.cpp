#include <algorithm>
#include <cmath>
#include <utility>

#include "varimap/core/parallel.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/disc.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/subdivision.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh/unit_area.h"
#include "varimap/quality/image_mesh.h"
#include "varimap/quality/quality.h"

namespace varimap {

namespace {

/// Of a point of a side of the source: the closest to its straight image that faces as the side's ends do.
SurfacePoint image_along(const SurfacePoint& at, const PointMap& map, const TriangleMesh& source,
                         const TriangleMesh& target, const ClosestPoint& closest) {
    const StraightImage image = straight_image(at, map, source, target);
    if (!image.is_whole) return {};
    const int guess = map[std::size_t(nearest_vertex(source, at))].face;
    return closest(image.place, image.normal, guess).point;
}

/// Cuts faces much larger than the target's in four, until they are as small. Their straight images cut
/// through what they lie along, and would seem to leave it out.
void lay_along(const TriangleMesh& target, PointMap& map, TriangleMesh& source) {
    constexpr int as_small = 4;
    const ClosestPointOnDemand closest([&] { return target; });
    while (source.face_count() > 0 && as_small * source.face_count() <= target.face_count()) {
        Subdivision finer = subdivide(source);
        PointMap between;
        for (const SurfacePoint& at : finer.midpoints)
            between.push_back(image_along(at, map, source, target, *closest));
        map.insert(map.end(), between.begin(), between.end());
        source = std::move(finer.mesh);
    }
}

/// The image triangles that have an area. Those that face against the target come both ways round, so that
/// neither a flip nor a sharp crease of the target (where the test for flips may err) counts as a gap.
TriangleMesh visible_image(const ImageMesh& images) {
    TriangleMesh image = images.image;
    image.faces.resize(2 * images.image.face_count(), 3);
    int count = 0;
    for (int f = 0; f < images.image.face_count(); ++f) {
        if (!images.is_mapped(f) || is_degenerate(images.image, f)) continue;
        const Eigen::RowVector3i corners = images.image.faces.row(f);
        image.faces.row(count++) = corners;
        if (images.facing(f) <= 0) image.faces.row(count++) << corners[0], corners[2], corners[1];
    }
    image.faces.conservativeResize(count, 3);
    return image;
}

/// Largest |q - c| / |p - c| of a face that is hit; chosen by hand: 0 behind the image, 1 beside its rim.
constexpr double sideways = 0.8;
/// Of its longest edge: always near enough. One map between two cats covers 0.9943, 0.9958 and 0.9998 by
/// 0.02, 0.05 and 0.25; all published numbers are by 0.05.
constexpr double within_face = 0.05;

/// `guess`: a face of the image that may be near, or -1; then the one that is.
bool is_hit(int f, const TriangleMesh& target, const TriangleMesh& image, const ClosestPoint& on_image,
            const ClosestPoint& on_target, int& guess) {
    const Vec3 centroid = position(target, {f, Vec3::Constant(1.0 / 3)});
    const auto near = on_image(centroid, face_normal(target, f), guess).point;
    guess = near.face;
    const Vec3 p = position(image, near);
    const double limit = std::max(sideways * (p - centroid).norm(), within_face * longest_edge(target, f));
    // What lies closest to p is no farther from it than the centroid.
    const bool faces_p = face_normal(target, f).dot(face_normal(image, near.face)) > 0;
    if (faces_p && 2 * (p - centroid).norm() * (1 + 1e-9) <= limit) return true;
    const Vec3 q = position(target, on_target(p, face_normal(image, near.face), f).point);
    return (q - centroid).norm() <= limit;
}

/// Smaller parts are found at ends of limbs and in folds of most good maps.
constexpr double least_part = 0.005;

/// Those of an area of least_part or more.
std::vector<SubMesh> large_parts(const TriangleMesh& mesh, std::vector<char> uncovered) {
    const double least_area = least_part * surface_area(mesh);
    std::vector<SubMesh> parts;
    for (std::vector<int>& faces : face_components(find_edges(mesh), std::move(uncovered))) {
        std::sort(faces.begin(), faces.end());
        SubMesh part(mesh, std::move(faces));
        if (surface_area(part.mesh) >= least_area) parts.push_back(std::move(part));
    }
    return parts;
}

/// Of the vertices with the fewest claims, the one nearest to the centroid.
int central_vertex(const SubMesh& part, const VertexData<int>& claims) {
    const Vec3 centroid = area_centroid(part.mesh);
    const auto rank = [&](int v) {
        return std::pair(claims[part.vertex[std::size_t(v)]], (part.mesh.vertex(v) - centroid).squaredNorm());
    };
    int best = 0;
    for (int v = 1; v < part.mesh.vertex_count(); ++v)
        if (rank(v) < rank(best)) best = v;
    return part.vertex[std::size_t(best)];
}

/// Parts may touch at vertices: the one that a part is named by is in no other, if any is.
std::vector<UncoveredPart> uncovered_parts(const TriangleMesh& mesh, std::vector<char> uncovered) {
    const std::vector<SubMesh> large = large_parts(mesh, std::move(uncovered));
    VertexData<int> claims(mesh.vertex_count(), 0);
    for (const SubMesh& part : large)
        for (const int v : part.vertex) ++claims[v];
    const double area = surface_area(mesh);
    std::vector<UncoveredPart> parts;
    for (const SubMesh& part : large) {
        parts.push_back({surface_area(part.mesh) / area, central_vertex(part, claims)});
        ++claims[parts.back().vertex];
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const UncoveredPart& a, const UncoveredPart& b) { return a.share > b.share; });
    return parts;
}

}  // namespace

Coverage measure_coverage(PointMap map, TriangleMesh source, const TriangleMesh& target) {
    lay_along(target, map, source);
    const ImageMesh images(map, source, target);
    const TriangleMesh image = visible_image(images);
    std::vector<char> uncovered(std::size_t(target.face_count()), 1);
    if (image.face_count() > 0) {
        const ClosestPoint on_image(image), on_target(images.target);
        parallel_for_each_range(uncovered.size(), 64, [&](std::size_t begin, std::size_t end) {
            int guess = -1;
            for (std::size_t f = begin; f < end; ++f)
                uncovered[f] = !is_hit(int(f), images.target, image, on_image, on_target, guess);
        });
    }
    double hit_area = 0, area = 0;
    for (int f = 0; f < target.face_count(); ++f) {
        const double part = face_normal(images.target, f).norm();
        area += part;
        if (!uncovered[std::size_t(f)]) hit_area += part;
    }
    return {hit_area / area, uncovered_parts(images.target, std::move(uncovered))};
}

}  // namespace varimap
