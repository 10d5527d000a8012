#pragma once

#include <string>
#include <vector>

#include "varimap/artifact/artifact.h"
#include "varimap/core/linear_algebra.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Two points of a domain that are joined.
struct DomainEdge {
    int a = 0, b = 0;        ///< points, a < b
    double length = 0;       ///< units of the domain
    double conductance = 0;  ///< weight in the Laplacian
};

/// All that solving for a plan asks of what is mapped (Sec. 2: a distribution of mass on points). A surface
/// is one domain among others: of it, faces tell who is near whom. Of others (point sets, curves, graphs)
/// edges do, they have no orientation to iron and no local shape, and they are as large as a sphere of unit
/// area: their points' root mean square distance from the centroid is 1 / sqrt(4 pi).
struct Domain {
    TriangleMesh mesh;              ///< points in space, and the faces of a surface
    Eigen::VectorXd mass;           ///< per point: its share of the whole, sums to 1 (Sec. 2.1)
    bool mirrored = false;          ///< all faces have their last two corners exchanged
    std::vector<DomainEdge> edges;  ///< of what is no surface; connected
    /// points x D: intrinsic coordinates (geodesic_coordinates.h), in which variances are measured on the
    /// Euclidean levels; none: positions in space are.
    RowMatrix coordinates;

    bool is_surface() const { return mesh.face_count() > 0; }
};

/// Of what is no surface: the artifact of varimap-domain. Where a Domain is read, that of a Surface will do.
template <>
struct ArtifactType<Domain> {
    static constexpr const char* kind = "domain";
    static constexpr const char* stage = "varimap-domain";
    static constexpr int schema = 1;
};
std::string encode(const Domain& domain);
/// Throws ArtifactError unless sizes fit each other, indices are in range, numbers are finite and all is
/// connected.
void decode(const std::string& payload, Domain& domain);

template <>
Artifact<Domain> read_artifact<Domain>(const std::string& path);

/// Lengths and conductances of a domain are within this factor of its size, lest squares overflow or vanish.
inline constexpr double largest_ratio = 1e9;

/// Per point, from 0: which of the parts that edges join it belongs to, numbered by their first points.
std::vector<int> components(int points, const std::vector<DomainEdge>& edges);

}  // namespace varimap
