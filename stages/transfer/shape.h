#pragma once

#include "varimap/results/correspondence.h"

namespace varimap {

/// Positions of the vertices of `map.to` moved as `shape` moves those of `map.from`: displacements, linear on
/// faces, turned and scaled as the map turns and scales the surroundings of each vertex. These frames are the
/// best similarities from a vertex's neighbours' images to the neighbours, smoothed over the surface.
/// Vertices without an image stay.
Points carry_shape(const Correspondence& map, const Points& shape);

/// The vertices of `map.from` at their images on `map.to`; those without an image keep their place beside the
/// others, scaled alike.
Points carried_vertices(const Correspondence& map);

}  // namespace varimap
