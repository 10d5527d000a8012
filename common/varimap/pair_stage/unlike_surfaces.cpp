#include "varimap/pair_stage/unlike_surfaces.h"

#include <algorithm>
#include <cmath>

#include "varimap/core/log.h"
#include "varimap/mesh/handles.h"
#include "varimap/mesh/topology.h"
#include "varimap/spectral/local_shape.h"

namespace varimap {

namespace {

/// In units of sqrt(area). A person cut at the waist has .9, a head .8, a leg or an arm .3; holes of scans
/// mostly less than .2.
constexpr double long_loop = 0.25;
/// Of that loop: where the other's longest is no longer, it has no such opening.
constexpr double much_shorter = 0.5;

double opening(const Surface& surface) {
    return longest_boundary(surface.input) / std::sqrt(surface_area(surface.input));
}

void warn_of_part(double own, double other, const char* which, const char* whole) {
    if (own < long_loop || other > much_shorter * own) return;
    warn(
        "the {} looks like a part of the {}: it ends at a loop of {:.2f} sqrt(area), where the {} has none "
        "beyond {:.2f}; "
        "a part is stretched over the whole, so cut the {} to the same part",
        which, whole, own, whole, other, whole);
}

}  // namespace

void warn_of_part(const Surface& A, const Surface& B) {
    if (!A.is_surface() || !B.is_surface()) return;
    const double a = opening(A), b = opening(B);
    warn_of_part(a, b, "source", "target");
    warn_of_part(b, a, "target", "source");
}

void warn_of_genus(const Surface& A, const Surface& B) {
    if (!A.is_surface() || !B.is_surface()) return;
    const int a = summarise_topology(A.mesh).genus, b = summarise_topology(B.mesh).genus;
    if (a == b || std::max(a, b) > most_handles) return;  // of noise some is left by preprocessing
    warn(
        "the source has genus {}, the target {}: every map between them folds or leaves something out; "
        "handles and tunnels that are noise are cut by --cut-handles LENGTH",
        a, b);
}

void warn_of_inside_out(const Surface& A, const Surface& B) {
    if (!A.is_surface() || !B.is_surface() || A.mirrored || B.mirrored) return;
    if (!is_closed(A.mesh) || !is_closed(B.mesh)) return;
    const bool A_is = looks_inward(A), B_is = looks_inward(B);
    if (A_is != B_is)
        warn(
            "the {} is inside out: its faces look inward, so that it counts as a mirror image; reverse its "
            "faces, or give --mirror",
            A_is ? "source" : "target");
}

namespace {

/// Root of the mean square distance from the mean.
double spread(const Points& points) {
    return std::sqrt((points.rowwise() - points.colwise().mean()).rowwise().squaredNorm().mean());
}

Points places(const PointPairs& pairs, const TriangleMesh& target) {
    Points places(pairs.size(), 3);
    for (std::size_t k = 0; k < pairs.size(); ++k)
        places.row(Eigen::Index(k)) = position(target, pairs[k].second).transpose();
    return places;
}

/// Root of the mean square distance between images of vertices that are neighbours; 0 if none are.
double step(const PointPairs& from_A, const Points& images, const TriangleMesh& source) {
    std::vector<Eigen::Index> row(std::size_t(source.vertex_count()), -1);
    for (std::size_t k = 0; k < from_A.size(); ++k)
        if (const int v = vertex_of(source, from_A[k].first); v >= 0) row[std::size_t(v)] = Eigen::Index(k);
    double sum = 0;
    int count = 0;
    for (int f = 0; f < source.face_count(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Eigen::Index a = row[std::size_t(source.faces(f, k))],
                               b = row[std::size_t(source.faces(f, (k + 1) % 3))];
            if (a < 0 || b < 0) continue;
            sum += (images.row(a) - images.row(b)).squaredNorm();
            ++count;
        }
    return count > 0 ? std::sqrt(sum / count) : 0;
}

}  // namespace

void warn_of_shapeless_map(const PointPairs& from_A, const Surface& A, const Surface& B) {
    // Images of half a body spread by .5 of the whole's. Steps of a map of which a tenth is wrong at random
    // are .44 of those of a random one, where half is .87.
    constexpr double gathered = 0.2, scattered = 0.87;
    if (!A.is_surface() || !B.is_surface()) return;
    const Points images = places(from_A, B.input);
    const double of_images = spread(images), of_target = spread(B.mesh.vertices) / B.scale;
    if (of_images < gathered * of_target)
        warn(
            "the initial map takes the source to one place of the target (its images spread {:.0f}% as far "
            "as "
            "the target does): is it a map of these two meshes?",
            100 * of_images / of_target);
    else if (step(from_A, images, A.input) > scattered * std::sqrt(2.0) * of_images)
        warn(
            "the initial map takes neighbours to places far from each other, as a random one does: is it a "
            "map of these two meshes, in the order of their vertices?");
}

}  // namespace varimap
