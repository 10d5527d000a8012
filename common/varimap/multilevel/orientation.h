#pragma once

#include <vector>

#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/multilevel/level_transfer.h"

namespace varimap {

/// Walks on the mesh from `vertex` downhill in distance to `centre` in the embedding, to a local minimum.
int nearest_by_descent(int vertex, const Eigen::RowVectorXd& centre, const RowMatrix& vertex_points,
                       const GeodesicGraph& graph);

/// What orientation needs of a surface: positions and unit normals of its mesh's vertices.
struct OrientedSurface {
    const Points& positions;
    Points normals;
    explicit OrientedSurface(const TriangleMesh& mesh)
        : positions(mesh.vertices), normals(vertex_normals(mesh)) {}
};

/// Orientation of a map at the samples of one side (Sec. 4.4): the sign of the determinant of the linear map
/// fitted, in the tangent planes of both surfaces, from the offsets of a sample's neighbours to the offsets
/// of their images. Neighbours around a bend (normals that disagree, on either surface) are left out.
/// Measured in R^3 between the vertices nearest to the centres: the diffusion tangent planes of Sec. 3.2 call
/// two to three times as many samples of a correct map reversed.
struct Orientation {
    std::vector<double>
        determinant;  ///< per sample: in [-1, 1]; its sign is the orientation, 0 where it cannot be told
    std::vector<int> image_vertex;  ///< per sample: the other mesh's vertex nearest to its centre
    double reversed_mass = 0;       ///< mass of the samples with negative determinant
};

/// One side of a level, where orientation is measured.
struct OrientedSide {
    const LevelSide& level_side;
    const OrientedSurface& surface;
    const GeodesicGraph& graph;
};
/// `partner`: per sample of `from` the sample of `to` at which the search for the vertex nearest to its
/// centre begins.
Orientation measure_orientation(const OrientedSide& from, const OrientedSide& to, const RowMatrix& centres,
                                const std::vector<int>& partner);

/// Orientation of both directions at a level.
struct PairOrientation {
    Orientation A_to_B, B_to_A;
    double reversed_mass() const { return (A_to_B.reversed_mass + B_to_A.reversed_mass) / 2; }
};

}  // namespace varimap
