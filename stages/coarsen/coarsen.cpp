#include "stages/coarsen/coarsen.h"

#include <cmath>

#include "varimap/core/log.h"
#include "varimap/mesh/coarsening.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

/// Brings the mesh to unit area and its centroid to the origin again; what it was coarsened from had both.
void normalise(Surface& surface) {
    const Vec3 shift = area_centroid(surface.mesh);
    const double factor = 1 / std::sqrt(surface_area(surface.mesh));
    surface.mesh.vertices = (surface.mesh.vertices.rowwise() - shift.transpose()) * factor;
    surface.centre += shift / surface.scale;
    surface.scale *= factor;
}

}  // namespace

Surface coarsened(Surface surface, const CoarsenParams& params) {
    if (surface.mesh.vertex_count() <= params.vertices) return surface;
    std::vector<int> vertex;  // per input vertex: the mesh's at it, or -1
    PointMap inside;
    for (const SurfacePoint& point : surface.on_mesh) {
        vertex.push_back(point.face >= 0 ? vertex_of(surface.mesh, point) : -1);
        if (point.face >= 0 && vertex.back() < 0) inside.push_back(point);
    }
    const Coarsening coarsening =
        coarsen(surface.mesh, params.vertices, inside, {params.thin_vertices, params.most_lost});
    log("coarsened from {} vertices to {}, {:.2f}% of the area lost", surface.mesh.vertex_count(),
        coarsening.mesh.vertex_count(), 100 * (1 - surface_area(coarsening.mesh)));
    auto next_inside = coarsening.points.begin();
    for (std::size_t i = 0; i < vertex.size(); ++i)
        if (SurfacePoint& point = surface.on_mesh[i]; point.face >= 0)
            point = vertex[i] >= 0 ? coarsening.on_mesh[std::size_t(vertex[i])] : *next_inside++;
    PointMap on_input;
    for (const int v : coarsening.vertex) on_input.push_back(surface.on_input[std::size_t(v)]);
    surface.on_input = std::move(on_input);
    surface.input_face.clear();
    surface.mesh = coarsening.mesh;
    normalise(surface);
    surface.mass = voronoi_masses(surface.mesh);
    return surface;
}

}  // namespace varimap
