#pragma once

#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// A mesh without thin faces, and where its parts come from.
struct ThinFaceRemoval {
    TriangleMesh mesh;
    std::vector<int> vertex;  ///< per vertex before: its vertex now
    std::vector<int> origin;  ///< per face: the face before in whose place it is
    int collapsed = 0;        ///< needles, removed with their short side
    int turned = 0;           ///< caps, removed by turning their long side
};

/// Height of a face over its longest side, relative to that side; 0 where it has no area.
double thinness(const Vec3& a, const Vec3& b, const Vec3& c);
double thinness(const TriangleMesh& mesh, int f);

/// Removes the faces of thinness below `thinnest`, on which neither the Laplacian nor areas can be trusted:
/// of a needle the short side is collapsed into its lower vertex; of a cap the long side is turned, so that
/// it joins the two corners that face it. Nothing moves farther than ten times thinnest times a face's
/// longest side, and no other face turns over. Vertices and faces keep their order. The mesh must be
/// manifold, and stays so. A mesh without such faces comes back as it is; one where some cannot be removed
/// keeps these.
ThinFaceRemoval remove_thin_faces(const TriangleMesh& mesh, double thinnest);

}  // namespace varimap
