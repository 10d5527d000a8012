#include "varimap/pair_stage/unlike_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "varimap/core/log.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_repair/handles.h"
#include "varimap/surface/surface.h"

namespace varimap {

namespace {

/// In units of sqrt(area). A person cut at the waist has .9, a head .8, a leg or an arm .3, all but a hand .2
/// to .3; ragged holes of a jaw's scan, .2 to .8 long, .07 to .17.
constexpr double wide = 0.18;
/// Of that opening: where the other's widest is no wider, it has no such opening.
constexpr double much_narrower = 0.4;
/// Up to that a hole of a scan may be as wide.
constexpr double as_holes = 0.4;
/// Scans from a few sides have dozens of holes, eleven synthetic ones 34 to 199 that are no pinholes. One
/// from the front, open all around, was mapped .56 from the truth, and .04 when they were filled.
constexpr int as_many_as_scans = 10;
constexpr double pinhole = 0.02;

/// Per vertex whether it lies on the component of the largest area. Others hang on it by a tube (bridges.h):
/// a body is whole if it wears an open jacket.
std::vector<char> on_largest_component(const Surface& surface) {
    const TriangleMesh mesh = without_added_faces(surface);
    const ConnectedComponents components = connected_components(mesh);
    const std::vector<double> areas = components.areas(mesh);
    const auto largest = std::max_element(areas.begin(), areas.end()) - areas.begin();
    std::vector<char> marks;
    for (const int c : components.of_vertex) marks.push_back(c == largest);
    return marks;
}

/// The loop at which a surface is open widest.
struct Opening {
    double width = 0;    ///< loop_openings (boundary.h); sqrt(area)
    int edges = 0;       ///< of the loop
    int long_loops = 0;  ///< all that are as long as wide ones, though they may be holes in a wall
    int loops = 0;       ///< all but pinholes
};
Opening widest_opening(const Surface& surface) {
    const Edges edges = find_edges(surface.input);
    const Boundary boundary = find_boundary(surface.input, edges);
    if (boundary.loops == 0) return {};
    std::vector<double> widths = loop_openings(surface.input, edges, boundary);
    std::vector<double> lengths = loop_lengths(surface.input, boundary);
    const std::vector<char> counts = on_largest_component(surface);
    for (std::size_t i = 0; i < boundary.edges.size(); ++i)
        if (const auto loop = std::size_t(boundary.loop[i]); !counts[std::size_t(boundary.edges[i][0])])
            widths[loop] = lengths[loop] = 0;
    const double unit = std::sqrt(surface_area(surface.input));
    const auto at_least = [&](double length) {
        return int(
            std::count_if(lengths.begin(), lengths.end(), [&](double l) { return l >= length * unit; }));
    };
    const auto widest = std::max_element(widths.begin(), widths.end());
    return {*widest / unit,
            int(std::count(boundary.loop.begin(), boundary.loop.end(), int(widest - widths.begin()))),
            at_least(wide), at_least(pinhole)};
}

/// To be tried first: of a whole with holes that is taken for a part more can go wrong than the other way
/// round. Empty where it is no hole.
std::string how_to_close(const Opening& own) {
    if (own.long_loops > 1)
        return fmt::format("If its {} long loops are holes, --fill-holes all closes them; try that first. ",
                           own.long_loops);
    if (own.loops >= as_many_as_scans)
        return fmt::format(
            "If its {} loops are holes of a scan, --fill-holes all closes them; try that first. ", own.loops);
    if (own.width < as_holes) return fmt::format("If it is a hole, --fill-holes {} closes it. ", own.edges);
    return "";
}

void warn_of_part(const Opening& own, const Opening& other, const char* which, const char* whole) {
    if (own.width < wide || other.width > much_narrower * own.width) return;
    warn(
        "the {} looks like a part of the {}: it ends at a loop, {:.2f} sqrt(area) around, where the {} has "
        "none beyond {:.2f}. {}If it is a part, it is stretched over the whole: give --part {}, or cut the "
        "{} "
        "to the same part",
        which, whole, own.width, whole, other.width, how_to_close(own), which, whole);
}

/// Clothes have up to four loops, and two of a kind as many.
void warn_of_other_holes(const Opening& a, const Opening& b) {
    constexpr int several = 3;
    if (std::min(a.long_loops, b.long_loops) < several || a.long_loops == b.long_loops) return;
    warn(
        "the surfaces are open at {} and {} long loops, and a map goes around holes that lie at other "
        "places: --fill-holes all closes them before the map is made",
        a.long_loops, b.long_loops);
}

}  // namespace

void warn_of_part(const Surface& A, const Surface& B) {
    if (!A.is_surface() || !B.is_surface() || is_cut_out(A) || is_cut_out(B)) return;
    const Opening a = widest_opening(A), b = widest_opening(B);
    // A sheet's rim leads out to all sides of it as it lies flat, and to one as it is rolled up.
    if (!is_sheet(A.input) || !is_sheet(B.input)) {
        warn_of_part(a, b, "source", "target");
        warn_of_part(b, a, "target", "source");
    }
    warn_of_other_holes(a, b);
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
    if (one_is_inside_out(A, B))
        warn(
            "the {} is inside out: its faces look inward, so that it is mapped as a mirror image. If it "
            "is one, as a mesh that was mirrored by a change of sign, all is well; if not, give "
            "--mirror, which reverses the faces",
            signed_volume_when_closed(A.mesh) < 0 ? "source" : "target");
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

/// Per vertex of the source's input the row of the pair that begins there, or -1.
std::vector<Eigen::Index> rows(const PointPairs& from_A, const TriangleMesh& source) {
    std::vector<Eigen::Index> row(std::size_t(source.vertex_count()), -1);
    for (std::size_t k = 0; k < from_A.size(); ++k)
        if (const int v = vertex_of(source, from_A[k].first); v >= 0) row[std::size_t(v)] = Eigen::Index(k);
    return row;
}

/// What a map does to the faces of the source whose corners all have images.
struct ImageFaces {
    double step = 0;      ///< root of the mean square distance between images of corners; 0 without faces
    double mirrored = 0;  ///< share of the images' area that faces the other way than the target
    int count = 0;        ///< of images that have an area
};
ImageFaces image_faces(const PointPairs& from_A, const Points& images, const TriangleMesh& source,
                       const TriangleMesh& target) {
    const std::vector<Eigen::Index> row = rows(from_A, source);
    double squares = 0, area = 0, mirrored_area = 0;
    int sides = 0;
    ImageFaces result;
    for (int f = 0; f < source.face_count(); ++f) {
        const Eigen::Index a = row[std::size_t(source.faces(f, 0))], b = row[std::size_t(source.faces(f, 1))],
                           c = row[std::size_t(source.faces(f, 2))];
        if (a < 0 || b < 0 || c < 0) continue;
        const Vec3 x = images.row(a).transpose(), y = images.row(b).transpose(),
                   z = images.row(c).transpose();
        squares += (x - y).squaredNorm() + (y - z).squaredNorm() + (z - x).squaredNorm();
        sides += 3;
        const Vec3 normal = (y - x).cross(z - x);
        const double side = normal.dot(face_normal(target, from_A[std::size_t(a)].second.face).normalized());
        if (!(std::abs(side) > 0)) continue;
        ++result.count;
        area += std::abs(side);
        if (side < 0) mirrored_area += std::abs(side);
    }
    if (sides > 0) result.step = std::sqrt(squares / sides);
    if (area > 0) result.mirrored = mirrored_area / area;
    return result;
}

}  // namespace

void warn_of_bad_initial_map(const PointPairs& from_A, const Surface& A, const Surface& B) {
    // Images of half a body spread by .5 of the whole's. Steps of a map of which a tenth is wrong at random
    // are .44 of those of a random one, where half is .87. Of a random one half is mirrored.
    constexpr double gathered = 0.2, scattered = 0.87, mostly = 0.7;
    constexpr int enough = 20;
    if (!A.is_surface() || !B.is_surface()) return;
    const Points images = places(from_A, B.input);
    const double of_images = spread(images), of_target = spread(B.mesh.vertices) / B.scale;
    const ImageFaces faces = image_faces(from_A, images, A.input, B.input);
    if (of_images < gathered * of_target)
        warn(
            "the initial map takes the source to one place of the target (its images spread {:.0f}% as far "
            "as "
            "the target does): is it a map of these two meshes?",
            100 * of_images / of_target);
    else if (faces.step > scattered * std::sqrt(2.0) * of_images)
        warn(
            "the initial map takes neighbours to places far from each other, as a random one does: is it a "
            "map of these two meshes, in the order of their vertices?");
    else if (faces.count >= enough && faces.mirrored > mostly)
        warn(
            "the initial map mirrors {:.0f}% of the source, left and right exchanged, and what begins from "
            "it "
            "comes out wrong: correct it, or give --mirror where the surfaces are mirror images",
            100 * faces.mirrored);
}

}  // namespace varimap
