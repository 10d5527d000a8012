#pragma once

#include <optional>

#include "varimap/results/correspondence.h"

namespace varimap {

/// Positions of the vertices of `map.to` moved as `shape` moves those of `map.from`: displacements, linear on
/// faces, turned and scaled as the map turns and scales the surroundings of each vertex. These frames are the
/// best similarities from a vertex's neighbours' images to the neighbours, smoothed over the surface.
/// Vertices that lie in the same place, or nearly, and have one image, as along a seam of the file, are one
/// here. Vertices without an image follow those near them, as in carried_vertices.
Points carry_shape(const Correspondence& map, const Points& shape);

/// Another shape of a mesh, brought to where the mesh lies.
struct LaidShape {
    Points vertices;
    bool is_mirror_image = false;  ///< it is rather that of the mesh, as where two axes were exchanged
};

/// A mesh in another shape that has other axes, units or place, which would be carried as a displacement of
/// every vertex: laid onto the mesh by the similarity that fits half of the vertices best. Nothing where some
/// lie where they were, or most of what moves the vertices is no similarity.
std::optional<LaidShape> laid_onto(const TriangleMesh& mesh, const Points& shape);

/// The vertices of `map.from` at their images on `map.to`. Those without an image follow the vertices nearest
/// to them that have one: by the best similarity from these to their images, one for all vertices that hang
/// together, so that a small part that was left out of the map keeps its form.
Points carried_vertices(const Correspondence& map);

/// Whether the images of most of the faces of `map.from`, by area, show their back where the faces of
/// `map.to` show their front.
bool reverses_orientation(const Correspondence& map);

}  // namespace varimap
