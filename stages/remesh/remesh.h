#pragma once

#include <string>
#include <vector>

#include "varimap/mesh_files/polygon_soup.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The surface's mesh file, its faces as the file has them; those of `file_of` (surface.h) may be mirrored.
TriangleMesh file_as_read(const Surface& surface);

/// The source's file (faces reversed if one of the two is mirrored, so that they show their outside) with its
/// vertices moved to their images, in the coordinates of the target's file. Vertices without an image keep
/// their place relative to the source's centroid, scaled like the target; those that are not finite go to the
/// target's centroid. Faces with corners that have no image are left out. `map`: between the files.
TriangleMesh cross_remesh(const PointMap& map, const Surface& source, const Surface& target);

/// The same with the polygons of the source's file, of which `moved` (cross_remesh) has the triangles. Of a
/// polygon with a corner that has no image the triangles are left that have three. Throws InputError where
/// `polygons` are not those of the surface's file.
PolygonSoup cross_remeshed_polygons(const TriangleMesh& moved, const PolygonSoup& polygons,
                                    const PointMap& map, const Surface& source, const Surface& target);

/// `vertex,ratio`: transported mass by mass at the vertices of the file, linear between the samples of the
/// plan; those that do not lie among samples are left out.
std::string masses_csv(const Surface& surface, const std::vector<int>& samples,
                       const Eigen::VectorXd& transported, const Eigen::VectorXd& mass);

/// `vertex,fate,twin`: a row for every vertex of the file that is not simply mapped, its VertexFate
/// (file_link.h), and, where it was welded, the vertex whose image it has.
std::string vertices_csv(const Surface& surface);

}  // namespace varimap
