#pragma once

#include "common/map_shapes.h"
#include "common/mapping/chord_mesh.h"
#include "common/mapping/pair_context.h"
#include "common/mesh/mass.h"

/// What the solving stages read, made from generated shapes without artifacts.
namespace varimap::shapes {

/// A mesh moved and scaled to unit area, not bisected, with its Voronoi masses.
inline Surface unit_surface(const TriangleMesh& mesh) {
    Surface surface = plain_surface(unit_area(mesh));
    surface.mass = voronoi_masses(surface.mesh);
    return surface;
}

inline SurfaceData surface_data(const Surface& surface, int eigenpairs) {
    EigenSolverOptions options;
    options.count = eigenpairs;
    const Basis basis = compute_eigenbasis(surface, options);
    return {surface, basis, build_hierarchy(surface, basis, {})};
}

}  // namespace varimap::shapes
