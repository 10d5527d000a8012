#include "varimap/surface/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "stages/preprocess/preprocess.h"
#include "varimap/core/error.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

TEST(Masses, AreTheVoronoiAreasOfARegularMesh) {
    const Eigen::VectorXd mass = voronoi_masses(shapes::square(4));
    EXPECT_NEAR(mass[6], 1. / 16, 1e-15);  // inner vertex: one square
    EXPECT_NEAR(mass[2], 1. / 32, 1e-15);  // side: half
    EXPECT_NEAR(mass[0], 1. / 64, 1e-15);  // corner: a quarter
    EXPECT_NEAR(mass.sum(), 1, 1e-15);
}

TEST(Masses, OfAnAcuteTriangleAreCutAtItsCircumcentre) {
    const Vec3 a(0, 0, 0), b(4, 0, 0), c(1, 3, 0);
    const Eigen::VectorXd mass = voronoi_masses(shapes::make_mesh({a, b, c}, {{0, 1, 2}}));
    const Vec3 centre(2, 1, 0);                            // equally far from all three
    const auto area = [&](const Vec3& p, const Vec3& q) {  // kite of corner p towards q, half of it
        return ((p + q) / 2 - p).cross(centre - p).norm() / 2;
    };
    EXPECT_NEAR(mass[0], (area(a, b) + area(a, c)) / 6, 1e-15);
    EXPECT_NEAR(mass[1], (area(b, a) + area(b, c)) / 6, 1e-15);
    EXPECT_NEAR(mass[2], (area(c, a) + area(c, b)) / 6, 1e-15);
}

TEST(Masses, OfAnObtuseTriangleAreHalfAndQuarters) {
    const Eigen::VectorXd mass =
        voronoi_masses(shapes::make_mesh({{0, 0, 0}, {4, 0, 0}, {2, .1, 0}}, {{0, 1, 2}}));
    EXPECT_NEAR(mass[0], .25, 1e-15);
    EXPECT_NEAR(mass[1], .25, 1e-15);
    EXPECT_NEAR(mass[2], .5, 1e-15);
}

TEST(Masses, ArePositiveExactlyWhereFacesAre) {
    // Vertex 3 has no face, vertex 4 only a face without area.
    const Eigen::VectorXd mass = voronoi_masses(
        shapes::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {.5, 0, 0}}, {{0, 1, 2}, {1, 0, 4}}));
    EXPECT_EQ(mass[3], 0);
    EXPECT_GT(mass[4], 0);
    EXPECT_LT(mass[4], 1e-9);
    for (const TriangleMesh& mesh : {shapes::figure(.15), shapes::tube(9, 30, false)}) {
        EXPECT_GT(voronoi_masses(mesh).minCoeff(), 0);
        EXPECT_NEAR(voronoi_masses(mesh).sum(), 1, 1e-13);
    }
}

TEST(Centroid, IsThatOfAHalfSphere) {
    TriangleMesh cap = shapes::ellipsoid(5);
    int faces = 0;
    for (int f = 0; f < cap.face_count(); ++f) {
        const double z = position(cap, {f, Vec3::Constant(1. / 3)})[2];
        if (z > 1e-9) cap.faces.row(faces++) = cap.faces.row(f).eval();
    }
    cap.faces.conservativeResize(faces, 3);
    EXPECT_NEAR(area_centroid(cap)[2], .5, 5e-3);
    EXPECT_NEAR(area_centroid(cap)[0], 0, 2e-3);
}

TEST(VertexNormals, OfASpherePointOutwards) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    const Points normals = vertex_normals(sphere);
    for (int v = 0; v < sphere.vertex_count(); ++v)
        EXPECT_GT(normals.row(v).dot(sphere.vertices.row(v)), .9999);
}

TEST(Adjacency, NamesFacesAndNeighboursInAscendingOrder) {
    const TriangleMesh mesh = shapes::square(1);  // faces 0 2 3 and 0 3 1
    const Adjacency faces = vertex_faces(mesh), neighbours = vertex_neighbours(mesh);
    const auto list = [](std::span<const int> s) { return std::vector<int>(s.begin(), s.end()); };
    EXPECT_EQ(list(faces[0]), (std::vector<int>{0, 1}));
    EXPECT_EQ(list(faces[2]), (std::vector<int>{0}));
    EXPECT_EQ(list(neighbours[0]), (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(list(neighbours[1]), (std::vector<int>{0, 3}));
    const Edges edges = find_edges(mesh);
    EXPECT_EQ(edges.size(), 5);
    for (int s = 0; s < 6; ++s) {
        const auto sides = edges.half_edges[edges.of_half_edge[s]];
        EXPECT_NE(std::find(sides.begin(), sides.end(), s), sides.end());
    }
}

class SurfaceTest : public ::testing::Test {
  protected:
    static Surface make() {
        PreprocessParams params;
        params.target_edge_length = .1;
        return preprocess(shapes::moved(shapes::figure(.15), 2, .5, {1, 2, 3}), params);
    }
};

TEST_F(SurfaceTest, PointsGoBackToTheInput) {
    const Surface surface = make();
    for (int f = 0; f < surface.mesh.face_count(); ++f)
        for (const Vec3& b : {Vec3(1, 0, 0), Vec3(0, .5, .5), Vec3(.2, .3, .5)}) {
            const SurfacePoint on_mesh{f, b}, on_input = to_input(surface, on_mesh);
            EXPECT_NEAR(on_input.barycentric.sum(), 1, 1e-15 * 4);
            const Vec3 expected = position(surface.mesh, on_mesh) / surface.scale + surface.centre;
            EXPECT_LT((position(surface.input, on_input) - expected).norm(), 1e-13 * 20);
        }
}

TEST_F(SurfaceTest, ReadsBackFromItsBytes) {
    const Surface surface = make();
    Surface copy;
    decode(encode(surface), copy);
    EXPECT_EQ(encode(copy), encode(surface));
    EXPECT_EQ(copy.mesh.vertices, surface.mesh.vertices);
    EXPECT_EQ(copy.input.faces, surface.input.faces);
    EXPECT_EQ(copy.scale, surface.scale);
}

TEST_F(SurfaceTest, ContradictionsAreRefused) {
    Surface surface = make(), copy;
    surface.input_face[3] = surface.input.face_count();
    EXPECT_THROW(decode(encode(surface), copy), ArtifactError);
    surface = make();
    surface.mesh.faces(0, 0) = -1;
    EXPECT_THROW(decode(encode(surface), copy), ArtifactError);
    surface = make();
    surface.mass.conservativeResize(5);
    EXPECT_THROW(decode(encode(surface), copy), ArtifactError);
}

/// Walks on such a surface once took relax longer than ten seconds.
TEST_F(SurfaceTest, FacesThinnerThanPreprocessingLeavesAreRefused) {
    Surface surface = make(), copy;
    surface.mesh.vertices.col(1) *= 1e-9;
    surface.mesh.vertices /= std::sqrt(surface_area(surface.mesh));
    surface.mesh.vertices.col(2) *= 1e-9;
    surface.mesh.vertices /= std::sqrt(surface_area(surface.mesh));
    surface = shapes::plain_surface(surface.mesh);
    surface.mass = voronoi_masses(surface.mesh);
    EXPECT_THROW(decode(encode(surface), copy), ArtifactError);
}

/// Every part of a surface can be wrong with a right hash.
TEST_F(SurfaceTest, ForgedPartsAreRefused) {
    const Surface good = make();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::pair<const char*, std::function<void(Surface&)>> forgeries[] = {
        {"no faces", [](Surface& s) { s.mesh.faces.resize(0, 3), s.input_face.clear(); }},
        {"no input faces", [](Surface& s) { s.input.faces.resize(0, 3); }},
        {"empty", [](Surface& s) { s = {}; }},
        {"nan", [&](Surface& s) { s.mesh.vertices(3, 1) = nan; }},
        {"nan of the input", [&](Surface& s) { s.input.vertices(3, 1) = nan; }},
        {"moved vertex", [](Surface& s) { s.mesh.vertices(3, 1) += 1; }},
        {"corner twice", [](Surface& s) { s.mesh.faces(2, 0) = s.mesh.faces(2, 1); }},
        {"reversed face", [](Surface& s) { std::swap(s.mesh.faces(2, 0), s.mesh.faces(2, 1)); }},
        {"unused vertex",
         [](Surface& s) {
             s.mesh.vertices.conservativeResize(s.mesh.vertex_count() + 1, 3);
             s.mesh.vertices.bottomRows(1) = s.mesh.vertices.row(s.mesh.vertex_count() - 2).eval();
             s.mass.conservativeResize(s.mesh.vertex_count()), s.mass.tail(1).setConstant(1e-9);
             s.on_input.push_back(s.on_input.back());
         }},
        {"mass of zero", [](Surface& s) { s.mass[5] = 0; }},
        {"negative mass", [](Surface& s) { s.mass[5] *= -1; }},
        {"masses of another sum", [](Surface& s) { s.mass *= 2; }},
        {"masses of another mesh",
         [](Surface& s) {
             const double moved = .1 * s.mass[5];
             s.mass[5] -= moved, s.mass[6] += moved;
         }},
        {"nan mass", [&](Surface& s) { s.mass[5] = nan; }},
        {"face of no mesh", [](Surface& s) { s.on_mesh[1].face = s.mesh.face_count(); }},
        {"used vertex lost", [](Surface& s) { s.on_mesh[1].face = -1; }},
        {"vertex beyond its face", [](Surface& s) { s.on_mesh[1].barycentric = Vec3(2, -1, 0); }},
        {"some input faces", [](Surface& s) { s.input_face.pop_back(); }},
        {"nowhere", [](Surface& s) { s.on_input[4].face = -1; }},
        {"beyond its face", [](Surface& s) { s.on_input[4].barycentric = Vec3(2, -1, 0); }},
        {"nan coordinates", [&](Surface& s) { s.on_input[4].barycentric[0] = nan; }},
        {"scale", [](Surface& s) { s.scale = 0; }},
        {"centre", [&](Surface& s) { s.centre[0] = nan; }},
        {"axes", [](Surface& s) { s.input.space = Space(7); }}};
    Surface copy;
    EXPECT_NO_THROW(decode(encode(good), copy));
    for (const auto& [what, forge] : forgeries) {
        Surface forged = good;
        forge(forged);
        EXPECT_THROW(decode(encode(forged), copy), ArtifactError) << what;
    }
}

}  // namespace
}  // namespace varimap
