#include "varimap/surface/surface_check.h"

#include <algorithm>
#include <cmath>

#include "varimap/artifact/consistency.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/thin_faces.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

void require_mesh(const TriangleMesh& mesh, const char* which) {
    require<Surface>(mesh.face_count() > 0 && mesh.vertices.allFinite(), which);
    for (const int v : mesh.faces.reshaped()) require<Surface>(v >= 0 && v < mesh.vertex_count(), which);
    try {
        require_manifold(mesh, which);
    } catch (const InputError&) {
        require<Surface>(false, which);
    }
}

void require_sizes(const Surface& surface) {
    const TriangleMesh &mesh = surface.mesh, &input = surface.input;
    require<Surface>(surface.mass.size() == mesh.vertex_count(), "masses");
    require<Surface>(int(surface.on_mesh.size()) == input.vertex_count(), "input vertices");
    require<Surface>(surface.input_face.empty() || int(surface.input_face.size()) == mesh.face_count(),
                     "input faces");
    require<Surface>(int(surface.on_input.size()) == mesh.vertex_count(), "points of the input");
    require<Surface>(input.space >= Space::unstated && input.space <= Space::ras, "axes");
}

void require_way_back(const Surface& surface) {
    const TriangleMesh &mesh = surface.mesh, &input = surface.input;
    require<Surface>(are_points(surface.on_mesh, mesh.face_count()), "input vertices");
    for (const int v : input.faces.reshaped())
        require<Surface>(surface.on_mesh[v].face >= 0, "input vertices");
    require<Surface>(are_in_range(surface.input_face, input.face_count()), "input faces");
    require<Surface>(are_points(surface.on_input, input.face_count()), "points of the input");
    require<Surface>(surface.centre.allFinite() && std::isfinite(surface.scale) && surface.scale > 0,
                     "scale");
    constexpr double rounding = 1e-3;  // units of sqrt(area); far more than a repair moves anything
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        require<Surface>(surface.on_input[v].face >= 0, "points of the input");
        const Vec3 there = (position(input, surface.on_input[v]) - surface.centre) * surface.scale;
        require<Surface>((there - mesh.vertex(v)).norm() < rounding, "points of the input");
    }
}

void require_link(const Surface& surface) {
    const FileLink& link = surface.link;
    if (link.is_identity()) return;
    const TriangleMesh &mesh = surface.input, &file = link.file;
    require<Surface>(int(link.vertex.size()) == file.vertex_count() &&
                         link.fate.size() == link.vertex.size() &&
                         int(link.origin.size()) == mesh.vertex_count() &&
                         int(link.face.size()) == mesh.face_count() && link.turned.size() == link.face.size(),
                     "link to the file");
    for (const int v : file.faces.reshaped())
        require<Surface>(v >= 0 && v < file.vertex_count(), "link to the file");
    require<Surface>(are_in_range(link.origin, file.vertex_count()), "link to the file");
    for (const int v : link.vertex) require<Surface>(v >= -1 && v < mesh.vertex_count(), "link to the file");
    for (const int f : link.face) require<Surface>(f >= -1 && f < file.face_count(), "link to the file");
    require<Surface>(std::any_of(link.face.begin(), link.face.end(), [](int f) { return f >= 0; }),
                     "link to the file");
    for (const VertexFate fate : link.fate)
        require<Surface>(fate <= VertexFate::outside_part, "link to the file");
}

/// Preprocessing leaves no face thinner than 1e-6, of which bisection makes ones down to a quarter. On
/// thinner ones neither Laplacian nor walks can be trusted.
void require_no_thin_faces(const TriangleMesh& mesh) {
    constexpr double thinnest = 1e-7;
    for (int f = 0; f < mesh.face_count(); ++f) require<Surface>(thinness(mesh, f) >= thinnest, "faces");
}

/// Masses are those of the mesh, up to rounding.
void require_masses(const Surface& surface) {
    require<Surface>(are_masses(surface.mass), "masses");
    const Eigen::ArrayXd error = (surface.mass - voronoi_masses(surface.mesh)).array().abs();
    require<Surface>((error <= 1e-6 * surface.mass.array() + 1e-12).all(), "masses");
}

}  // namespace

void require_complete(const Surface& surface) {
    require_mesh(surface.mesh, "mesh");
    require_mesh(surface.input, "input mesh");
    // Every vertex of the mesh has a face, so that every one has a mass.
    require<Surface>(count_used_vertices(surface.mesh) == surface.mesh.vertex_count(), "vertices");
    require_sizes(surface);
    require_way_back(surface);
    require_link(surface);
    require<Surface>(std::abs(surface_area(surface.mesh) - 1) < 1e-3, "area");
    require_no_thin_faces(surface.mesh);
    require_masses(surface);
}

}  // namespace varimap
