#pragma once

#include "stages/remesh/params.h"
#include "varimap/mesh/surface.h"
#include "varimap/results/read_out.h"
#include "varimap/results/surface_map.h"

namespace varimap {

/// The map in both directions on the INPUT meshes (Sec. 5, cross-remeshing): `images` (read_out.h) are those
/// of the preprocessed surfaces' vertices, of which the input vertices are the first; they go to the input
/// faces that hold them, where they are untangled (untangling.h). Where bisection made most of the
/// vertices, the preprocessed surfaces are untangled first: the input alone would be too coarse to find the
/// way. Points lie on the faces of the mesh files, also where a surface is mirrored. `quality` holds the
/// deterministic part of quality.json.
SurfaceMap remesh(const Surface& A, const Surface& B, const SolvedPair& pair, VertexMaps images,
                  const RemeshParams& params = {});

/// The source's input mesh (faces reversed if one of the two is mirrored, so that they show their outside)
/// with its vertices moved to their images, in the target's input coordinates. Vertices no face uses have no
/// image: they keep their place relative to the source's centroid, scaled like the target.
TriangleMesh cross_remesh(const PointMap& map, const Surface& source, const Surface& target);

/// `vertex,ratio`: transported mass by mass at the INPUT vertices that are samples of the plan; with the plan
/// of varimap-refine these are all vertices that faces use.
std::string masses_csv(const Surface& surface, const std::vector<int>& samples,
                       const Eigen::VectorXd& transported, const Eigen::VectorXd& mass);

}  // namespace varimap
