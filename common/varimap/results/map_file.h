#pragma once

#include <string>

#include "varimap/mesh/triangle_mesh.h"
#include "varimap/mesh_files/index_base.h"

namespace varimap {

/// A map that this or another program wrote, from vertices of `source` to points of `target`, both as their
/// files have them. By its content the file is
/// - the table of varimap-remesh (`vertex,face,b0,b1,b2`);
/// - a vertex-to-vertex map: for every vertex of the source, in its order, a line with a vertex of the
///   target (before it there may be the vertex's own number, and a first line of names); -1 or nan: none;
/// - an .npy of such numbers;
/// - an .npz with `face` and `barycentric`, or else with one such list of numbers, or several, one of which
///   is called `p2p` or `nearest_vertex`.
/// Numbers of vertices start at `base`. automatic: the vertices' own numbers tell, or a 0, or a number as
/// large as there are vertices; else of both readings the smoother one is taken, and the log says so. Faces
/// start at 0. Without `source`, smoothness cannot tell (0, with a warning), and the number of rows is not
/// checked. Throws InputError naming file and line; IoError.
PointMap read_map_file(const std::string& path, IndexBase base, const TriangleMesh& target,
                       const TriangleMesh* source);

}  // namespace varimap
