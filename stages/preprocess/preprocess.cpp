#include "stages/preprocess/preprocess.h"

#include <algorithm>
#include <cmath>

#include "varimap/core/log.h"
#include "varimap/mesh/bisection.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

/// Fills vertex_of_input, centre and scale, and returns the used vertices, normalised, with their faces.
TriangleMesh normalise(const TriangleMesh& input, Surface& surface) {
    surface.centre = area_centroid(input);
    surface.scale = 1 / std::sqrt(surface_area(input));
    surface.vertex_of_input.assign(input.vertex_count(), -1);
    for (int s = 0; s < 3 * input.face_count(); ++s) surface.vertex_of_input[input.faces.data()[s]] = 0;
    TriangleMesh mesh;
    mesh.vertices.resize(input.vertex_count(), 3);
    int used = 0;
    for (int v = 0; v < input.vertex_count(); ++v) {
        if (surface.vertex_of_input[v] < 0) continue;
        mesh.vertices.row(used) = ((input.vertex(v) - surface.centre) * surface.scale).transpose();
        surface.vertex_of_input[v] = used++;
    }
    mesh.vertices.conservativeResize(used, 3);
    mesh.faces = input.faces.unaryExpr([&](int v) { return surface.vertex_of_input[v]; });
    return mesh;
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

}  // namespace

double target_edge_length(const PreprocessParams& params, int used_vertices) {
    if (params.target_edge_length > 0) return params.target_edge_length;
    return 2 * 1.0746 / std::sqrt(std::max(used_vertices, 2500));
}

Surface preprocess(const TriangleMesh& input, const PreprocessParams& params) {
    Surface surface;
    surface.input = input;
    const TriangleMesh normalised = normalise(input, surface);
    const TopologySummary topology = summarise_topology(normalised);
    log("genus {}, {} boundary loops, {} unused vertices", topology.genus, topology.boundary_loops,
        input.vertex_count() - normalised.vertex_count());
    log_edge_lengths("input", normalised);

    const double target = target_edge_length(params, normalised.vertex_count());
    Bisection bisection = bisect_longest_edges(normalised, target, params.max_vertices);
    surface.mesh = std::move(bisection.mesh);
    surface.input_face = std::move(bisection.origin);
    surface.on_input = std::move(bisection.on_origin);
    surface.mass = voronoi_masses(surface.mesh);
    if (params.mirror) surface = with_reversed_orientation(std::move(surface));
    log("target edge length {:.4f}", target);
    log_edge_lengths("output", surface.mesh);
    return surface;
}

}  // namespace varimap
