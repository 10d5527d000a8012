#pragma once

#include <array>
#include <functional>
#include <vector>

#include "common/mesh/triangle_mesh.h"

/// Generated surfaces whose maps onto each other are known. All are closed manifolds with faces
/// counter-clockwise from outside, unless stated.
namespace varimap::shapes {

/// A mesh from lists.
TriangleMesh make_mesh(const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& faces);

/// Sphere of 10 * 4^level + 2 vertices from the icosahedron, its axes scaled by `radii`.
TriangleMesh ellipsoid(int level, const Vec3& radii = Vec3::Ones());

/// Torus around the z axis; `around` vertices along the long way, `across` along the short way. Genus 1.
TriangleMesh torus(double major_radius, double minor_radius, int around, int across);

/// n x n squares of side 1/n in the plane z = 0, each cut along a diagonal. One boundary loop.
TriangleMesh square(int n);

/// A smooth invertible deformation of space, in closed form both ways: what lies beyond `start` along `axis`
/// is bent towards `direction` along an arc of that length and angle (radians), rigidly beyond the arc; the
/// rest stays. `axis` and `direction` are orthogonal unit vectors through `origin`; points on the arc need (p
/// - origin) . direction < length / angle.
struct Bend {
    Vec3 origin, axis, direction;
    double start, length, angle;
    Vec3 octant = Vec3::Zero();  ///< signs: only points with these signs of their coordinates move; 0: any
    Vec3 forward(const Vec3& p) const;
    Vec3 inverse(const Vec3& p) const;

  private:
    bool applies(const Vec3& p) const;
};

/// Bends one after the other. forward maps rest positions to posed ones, so the true image of any point p of
/// a rest surface on the posed surface is forward(p), however either is tessellated.
struct Pose {
    std::vector<Bend> bends;
    Vec3 forward(Vec3 p) const;
    Vec3 inverse(Vec3 p) const;
    TriangleMesh operator()(TriangleMesh rest) const;
};

/// A straight tube along x from 0 to 4, radius about 0.4, tapered and with an elliptic section and a bump, so
/// that it has no symmetry. `along` rings of `around` vertices; `phase` turns the rings (in steps), for
/// another tessellation of the same surface. Open ends leave two boundary loops.
TriangleMesh tube(int along, int around, bool capped, double phase = 0);
/// Bends the tube by `angle` in its middle.
Pose tube_pose(double angle);

/// A smooth four-legged figure with head, ears and tail, about 4 long, all limbs of different lengths; x
/// forward, z up. `cell`: size of the grid that meshes it, at most 0.15 (2700 vertices; 0.12: 4200, 0.1:
/// 6300); `shift` (in cells) moves the grid, which gives another tessellation of the same surface. Vertices
/// lie on the surface up to 1e-6.
TriangleMesh figure(double cell, double shift = 0);
/// Arches the back, swings the legs and bends head and tail, all in proportion to `amount` (1: clearly
/// another pose).
Pose figure_pose(double amount);

/// The zero level of `f` (negative inside, positive on the box's border) by marching tetrahedra, vertices
/// projected onto the level set.
TriangleMesh level_set(const std::function<double(const Vec3&)>& f, const Vec3& low, const Vec3& high,
                       double cell);

/// The same surface with vertices and faces in another order. old_vertex[new] names the vertex it was.
TriangleMesh shuffled(const TriangleMesh& mesh, unsigned seed, std::vector<int>* old_vertex = nullptr);

/// x -> scale * R x + offset, R a turn by `angle` about a skew axis.
TriangleMesh moved(TriangleMesh mesh, double scale, double angle, const Vec3& offset);

}  // namespace varimap::shapes
