#pragma once

#include "varimap/results/diffusion.h"
#include "varimap/results/map_pair.h"
#include "varimap/results/plan.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// The images of the vertices of the surfaces' meshes: closest points from the centres (Sec. 5,
/// cross-remeshing). On a plan with every vertex as a sample only faces that touch the row's support (entries
/// of at least 5% of the row's maximum) are candidates, so that a point never jumps to another limb;
/// otherwise the closest face whose normal agrees. Pinned landmarks are mapped exactly, unless they are
/// points between vertices. Throws ArtifactError if the plan is not one of these surfaces.
MapPair read_out(const Plan& plan, const Surface& A, const Surface& B);
/// The image vertices, and pinned landmarks. Throws as above.
MapPair read_out(const Diffusion& diffusion, const Surface& A, const Surface& B);

/// Maps pinned landmarks exactly, unless they are points between vertices.
void pin_landmarks(MapPair& maps, const PairRecord& record, const Surface& A, const Surface& B);

/// Vertices of a mesh as points of it.
PointMap images_at(const std::vector<int>& vertices, const TriangleMesh& target);

}  // namespace varimap
