#include "varimap/mesh/manifold.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fixtures/shapes.h"
#include "fixtures/together.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

using shapes::together;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string complaint(const TriangleMesh& mesh) {
    try {
        require_manifold(mesh, "m.off");
        return "";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        EXPECT_THAT(error.what(), HasSubstr("m.off"));
        return error.what();
    }
}

TEST(Manifold, BoundariesGenusAndUnusedVerticesAreServed) {
    EXPECT_EQ(complaint(shapes::square(2)), "");
    EXPECT_EQ(complaint(shapes::torus(2, 1, 6, 5)), "");
    EXPECT_EQ(complaint(shapes::tube(5, 6, false)), "");
    TriangleMesh mesh = shapes::ellipsoid(1);
    mesh.vertices.conservativeResize(mesh.vertex_count() + 3, 3);
    mesh.vertices.bottomRows(3).setZero();
    EXPECT_EQ(complaint(mesh), "");
}

TEST(Manifold, FacesOfUnknownVertices) {
    for (const int vertex : {-1, 12}) {
        TriangleMesh mesh = shapes::ellipsoid(0);
        mesh.faces(3, 1) = mesh.faces(5, 0) = vertex;
        EXPECT_THAT(complaint(mesh), AllOf(HasSubstr("2 corners"),
                                           HasSubstr("face 3: vertex " + std::to_string(vertex) + " of 12")));
    }
}

TEST(Manifold, SeveralComponents) {
    EXPECT_THAT(complaint(together(shapes::ellipsoid(0), shapes::square(1))),
                AllOf(HasSubstr("2 components"), HasSubstr("vertex 12")));
}

TEST(Manifold, EdgesOfThreeFaces) {
    TriangleMesh mesh = shapes::square(1);
    mesh.vertices.conservativeResize(5, 3);
    mesh.vertices.row(4) << 0, 0, 1;
    mesh.faces.conservativeResize(3, 3);
    mesh.faces.row(2) << 0, 3, 4;
    EXPECT_THAT(complaint(mesh),
                AllOf(HasSubstr("1 edges"), HasSubstr("three or more"), HasSubstr("0 and 3")));
}

TEST(Manifold, VerticesWithSeveralFans) {
    // Two closed surfaces, and two with boundary, that share one vertex.
    for (const TriangleMesh& part : {shapes::ellipsoid(0), shapes::square(2)}) {
        TriangleMesh mesh = together(part, part);
        const int n = part.vertex_count();
        mesh.faces = mesh.faces.unaryExpr([&](int v) { return v == n ? 0 : v; });
        EXPECT_THAT(complaint(mesh), AllOf(HasSubstr("1 vertices"), HasSubstr("vertex 0")));
    }
}

TEST(Manifold, InconsistentFaces) {
    TriangleMesh mesh = shapes::square(1);
    std::swap(mesh.faces(1, 0), mesh.faces(1, 1));
    EXPECT_THAT(complaint(mesh), AllOf(HasSubstr("1 edges"), HasSubstr("orientation"), HasSubstr("0 and 3")));
}

TEST(Manifold, OneSidedStrip) {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> faces;
    const int n = 8;
    for (int i = 0; i < n; ++i) {
        const double u = 2 * 3.14159265 * i / n;
        for (const double w : {-.3, .3})
            points.push_back({(1 + w * std::cos(u / 2)) * std::cos(u),
                              (1 + w * std::cos(u / 2)) * std::sin(u), w * std::sin(u / 2)});
        const int a = 2 * i, b = 2 * i + 1, c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? b + 2 : 0;
        faces.push_back({a, c, d});
        faces.push_back({a, d, b});
    }
    EXPECT_THAT(complaint(shapes::make_mesh(points, faces)), HasSubstr("orientation"));
}

TEST(Manifold, DegenerateIndices) {
    TriangleMesh mesh = shapes::square(1);
    mesh.faces(1, 1) = mesh.faces(1, 0);
    EXPECT_THAT(complaint(mesh), AllOf(HasSubstr("1 faces"), HasSubstr("face 1")));
}

TEST(Manifold, NoAreaOrTooLarge) {
    TriangleMesh mesh = shapes::square(1);
    mesh.vertices.col(0).setZero();
    EXPECT_THAT(complaint(mesh), HasSubstr("no area"));
    mesh = shapes::square(1);
    mesh.vertices *= 1e200;
    EXPECT_THAT(complaint(mesh), HasSubstr("scale it"));
    EXPECT_THAT(complaint({}), HasSubstr("no faces"));
}

TEST(Manifold, SizesAtTheEndOfTheRangeOfNumbers) {
    for (const double scale : {1e-150, 1e150, 1e300}) {
        TriangleMesh mesh = shapes::ellipsoid(1);
        mesh.vertices *= scale;
        EXPECT_THAT(complaint(mesh), HasSubstr("scale it")) << scale;
    }
    for (const double scale : {1e-45, 1e45}) {
        TriangleMesh mesh = shapes::ellipsoid(1);
        mesh.vertices *= scale;
        EXPECT_EQ(complaint(mesh), "") << scale;
    }
}

}  // namespace
}  // namespace varimap
