#include "stages/preprocess/preprocess.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "varimap/core/counted.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/mesh/bisection.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/thin_faces.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_repair/bridges.h"
#include "varimap/mesh_repair/handles.h"
#include "varimap/mesh_repair/holes.h"

namespace varimap {
namespace {

/// The used vertices of the input, normalised, with their faces.
struct Normalised {
    TriangleMesh mesh;
    std::vector<int> vertex_of_input;  ///< -1 where no face uses it
};

/// Fills centre and scale.
Normalised normalise(const TriangleMesh& input, Surface& surface) {
    surface.centre = area_centroid(input);
    surface.scale = 1 / std::sqrt(surface_area(input));
    UsedVertices used = used_vertices(input.faces, input.vertex_count());
    Points vertices = input.vertices(used.vertex, Eigen::all);
    vertices.rowwise() -= surface.centre.transpose();
    return {{vertices * surface.scale, std::move(used.faces)}, std::move(used.number)};
}

void log_edge_lengths(const char* when, const TriangleMesh& mesh) {
    std::vector<double> length;
    for (const auto& [a, b] : find_edges(mesh).vertices)
        length.push_back((mesh.vertex(a) - mesh.vertex(b)).norm());
    std::sort(length.begin(), length.end());
    const auto quantile = [&](double q) { return length[std::size_t(q * double(length.size() - 1))]; };
    log("{}: {} vertices, {} faces; edge length / sqrt(area): 5% {:.4f}, median {:.4f}, 95% {:.4f}, max "
        "{:.4f}",
        when, mesh.vertex_count(), mesh.face_count(), quantile(.05), quantile(.5), quantile(.95),
        length.back());
}

/// On thinner faces cotangents and areas have lost their digits; eigenpairs computed with them do not
/// converge. Measured: 1.4e-7 fails, 1e-5 does not.
constexpr double thinnest_face = 1e-6;

void require_no_thin_faces(const ThinFaceRemoval& repair, const FileLink& link) {
    int count = 0, first = -1;
    for (int f = 0; f < repair.mesh.face_count(); ++f)
        if (thinness(repair.mesh, f) < thinnest_face && count++ == 0) first = repair.origin[f];
    if (count > 0)
        throw InputError(
            fmt::format("{} faces have no area, or a height below 1e-6 of their length, and cannot be "
                        "removed, the first is {}; mesh this place anew",
                        count, face_in_words(first, link)));
}

/// The used vertices without thin faces. vertex_of_input leads to what is left.
ThinFaceRemoval repaired(Normalised& normalised, const FileLink& link) {
    ThinFaceRemoval repair = remove_thin_faces(normalised.mesh, thinnest_face);
    require_no_thin_faces(repair, link);
    if (repair.collapsed + repair.turned == 0) return repair;
    std::vector<std::string> done;
    if (repair.collapsed > 0) done.push_back(counted(repair.collapsed, "side collapsed", "sides collapsed"));
    if (repair.turned > 0) done.push_back(counted(repair.turned, "side turned", "sides turned"));
    const int gone = normalised.mesh.vertex_count() - repair.mesh.vertex_count();
    if (gone > 0)
        done.push_back(counted(gone, "vertex is mapped as another is", "vertices are mapped as others are"));
    note("faces without area removed: {}", fmt::join(done, ", "));  // they have no form to lose
    for (int& vertex : normalised.vertex_of_input)
        if (vertex >= 0) vertex = repair.vertex[vertex];
    return repair;
}

/// A point of a repaired face as one of the input: by its corners, each of which is an input vertex.
SurfacePoint before_repair(const SurfacePoint& point, const ThinFaceRemoval& repair,
                           const PointMap& corner_on_input, const TriangleMesh& input) {
    SurfacePoint result{repair.origin[point.face], Vec3::Zero()};
    for (const auto [vertex, weight] : WeightedCorners(repair.mesh, point))
        result.barycentric += weight * barycentric_on(input, result.face, corner_on_input[vertex]);
    return result;
}

/// Fills on_mesh, input_face and on_input, through the repair.
void record_ways(const Bisection& bisection, const ThinFaceRemoval& repair,
                 const std::vector<int>& vertex_of_input, Surface& surface) {
    const PointMap at_vertices = points_at_vertices(bisection.mesh);
    for (const int v : vertex_of_input) surface.on_mesh.push_back(v < 0 ? SurfacePoint{} : at_vertices[v]);
    PointMap corner_on_input(repair.mesh.vertex_count());
    for (int f = surface.input.face_count() - 1; f >= 0; --f)
        for (int c = 2; c >= 0; --c)
            corner_on_input[vertex_of_input[surface.input.faces(f, c)]] = {f, Vec3::Unit(c)};
    for (const int f : bisection.origin) surface.input_face.push_back(repair.origin[f]);
    for (const SurfacePoint& point : bisection.on_origin)
        surface.on_input.push_back(before_repair(point, repair, corner_on_input, surface.input));
}

/// Most vertices that bisection may make. An even triangulation with edges of the automatic target has about
/// as many as the input, or 2500; meshes of the collections grew by 1.6 at most. Slivers alone need more.
int most_vertices(const PreprocessParams& params, int used_vertices) {
    if (params.target_edge_length > 0) return params.max_vertices;
    return std::min(params.max_vertices, 4 * std::max(used_vertices, 2500));
}

/// Units of sqrt(area). With longer edges left, a needle of 10,000 vertices has faces so thin that its
/// eigenpairs do not converge. Measured: .3 fails, .17 does not.
constexpr double longest_of_slivers = .25;

int thinnest_of(const TriangleMesh& mesh) {
    int thinnest = 0;
    for (int f = 1; f < mesh.face_count(); ++f)
        if (thinness(mesh, f) < thinness(mesh, thinnest)) thinnest = f;
    return thinnest;
}

void report_end(const Bisection& bisection, double target, const Surface& surface,
                const PreprocessParams& params) {
    const int vertices = bisection.mesh.vertex_count();
    if (bisection.longest_left == 0) return;
    if (vertices >= params.max_vertices)
        throw InputError(
            fmt::format("bisection to edges of at most {:.3g} needs more than max_vertices = {} vertices; "
                        "choose a larger "
                        "target_edge_length or a larger max_vertices",
                        target, params.max_vertices));
    const int thinnest = thinnest_of(surface.input);
    const double height = thinness(surface.input, thinnest);
    const std::string worst = face_in_words(thinnest, surface.link);
    if (bisection.longest_left > longest_of_slivers)
        throw InputError(
            fmt::format("the surface is a sliver: at {} vertices bisection still leaves edges of {:.2g} "
                        "sqrt(area), the worst is {} (height {:.1g} of its length); mesh it with rounder "
                        "faces, or set target_edge_length",
                        vertices, bisection.longest_left, worst, height));
    warn(
        "slivers, the worst is {} (height {:.1g} of its length): bisection ends at {} vertices, four "
        "times "
        "those of the input or 2500, with edges up to {:.3f} where {:.3f} were wanted; the map is coarse "
        "there",
        worst, height, vertices, bisection.longest_left, target);
}

/// Holes are filled on request alone.
bool any_unasked(RepairCounts counts, const PreprocessParams& params) {
    counts.filled_holes = 0;
    counts.cut_handles -= asked_cuts(counts, params);
    return !in_words(counts).empty();
}

/// A repair that may have changed the surface's form, or left out parts that the user wants, is said loudly.
void report(const RepairedMesh& mesh, const PreprocessParams& params) {
    const RepairCounts& counts = mesh.counts;
    if (const std::string done = in_words(counts); !done.empty())
        (keeps_the_form(counts, mesh.mesh.face_count(), params) ? log_note : log_warning)(
            "repaired: " + done +
            (any_unasked(counts, params) ? "; varimap help meshes says how to do without" : ""));
    constexpr double much = 0.01;
    if (counts.dropped_area > much)
        warn(
            "{:.1f}% of the area is on components that are left out, and has no image; map them on their "
            "own, or with the rest, by --set preprocess.least_component=0.001 or less and without "
            "--components largest",
            100 * counts.dropped_area);
}

}  // namespace

int asked_cuts(const RepairCounts& counts, const PreprocessParams& params) {
    return params.cut_handles == "auto" ? 0 : counts.cut_handles;
}

bool keeps_the_form(const RepairCounts& counts, int faces, const PreprocessParams& params) {
    const auto few = [&](int count, double share) { return count <= std::max(10.0, share * faces); };
    const int elements =
        counts.not_finite + counts.degenerate + counts.duplicates + counts.cut_edges + counts.closed_slits;
    return few(elements, .003) &&
           counts.bridges <= 10
           // Turning faces changes no form; nor does parting what touches in a point, as around the ragged
           // holes of a scan.
           && few(counts.turned, .01) && few(counts.split_vertices, .03) &&
           counts.cut_handles == asked_cuts(counts, params) && counts.opened_edges == 0 &&
           counts.unfilled_holes == 0 &&
           counts.dropped_area <= .001  // specks, as scans have
           // Inner walls are no part of the form, unless they are most of what is there.
           && counts.cavity_area <= .5;
}

double target_edge_length(const PreprocessParams& params, int used_vertices) {
    if (params.target_edge_length > 0) return params.target_edge_length;
    return 2 * 1.0746 / std::sqrt(std::max(used_vertices, 2500));
}

RepairedMesh prepared(const TriangleMesh& file, const PreprocessParams& params, const std::string& path) {
    RepairedMesh mesh = repaired(file, params.repair, path);
    if (welds(params.repair)) mesh = slits_closed(std::move(mesh));
    mesh = holes_filled(std::move(mesh), longest_hole(params.fill_holes));
    const double longest = longest_handle(params.cut_handles, mesh.mesh);
    return bridged(handles_cut(std::move(mesh), longest));
}

Surface preprocess(const TriangleMesh& input, const PreprocessParams& params) {
    return preprocess(RepairedMesh{input, {}, {}}, params);
}

Surface preprocess(RepairedMesh repaired_input, const PreprocessParams& params) {
    report(repaired_input, params);
    Surface surface;
    surface.input = std::move(repaired_input.mesh);
    surface.link = std::move(repaired_input.link);
    const TriangleMesh& input = surface.input;
    Normalised used = normalise(input, surface);
    const TriangleMesh& normalised = used.mesh;
    const TopologySummary topology = summarise_topology(normalised);
    log("genus {}, {} boundary loops, {} unused vertices", topology.genus, topology.boundary_loops,
        input.vertex_count() - normalised.vertex_count());
    log_edge_lengths("input", normalised);

    const ThinFaceRemoval repair = repaired(used, surface.link);
    const double target = target_edge_length(params, normalised.vertex_count());
    const Bisection bisection =
        bisect_longest_edges(repair.mesh, target, most_vertices(params, normalised.vertex_count()));
    report_end(bisection, target, surface, params);
    record_ways(bisection, repair, used.vertex_of_input, surface);
    surface.mesh = bisection.mesh;
    surface.mass = voronoi_masses(surface.mesh);
    if (params.mirror) surface = with_reversed_orientation(std::move(surface));
    log("target edge length {:.4f}", target);
    log_edge_lengths("output", surface.mesh);
    return surface;
}

}  // namespace varimap
