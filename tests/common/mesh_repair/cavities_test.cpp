#include "varimap/mesh_repair/cavities.h"

#include <gtest/gtest.h>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fixtures/together.h"
#include "varimap/mesh_repair/mesh_repair.h"

namespace varimap {
namespace {

using shapes::together;

TriangleMesh ball(double radius, const Vec3& centre = Vec3::Zero()) {
    TriangleMesh mesh = shapes::ellipsoid(2, Vec3::Constant(radius));
    mesh.vertices.rowwise() += centre.transpose();
    return mesh;
}

/// Its faces look the other way.
TriangleMesh reversed(TriangleMesh mesh) {
    mesh.faces.col(1).swap(mesh.faces.col(2));
    return mesh;
}

/// Per component.
std::vector<char> cavities(const TriangleMesh& mesh) {
    const ConnectedComponents components = connected_components(mesh);
    return find_cavities(mesh, components, std::vector<char>(std::size_t(components.count), 1));
}

TEST(Cavities, AreInnerWalls) {
    using Marks = std::vector<char>;
    for (const double scale : {1e-6, 1., 1e6}) {
        const auto of = [&](TriangleMesh mesh) {
            mesh.vertices = (scale * mesh.vertices).rowwise() + Eigen::RowVector3d::Constant(3 * scale);
            return cavities(mesh);
        };
        const TriangleMesh shell = together(ball(1), reversed(ball(.98)));
        EXPECT_EQ(of(shell), Marks({0, 1}));
        EXPECT_EQ(of(reversed(shell)), Marks({0, 1})) << "all is inside out";
        EXPECT_EQ(of(together(reversed(ball(.98)), ball(1))), Marks({1, 0}));
        const TriangleMesh bubbles =
            together(reversed(ball(.3, {.5, 0, 0})), reversed(ball(.3, {-.5, 0, 0})));
        EXPECT_EQ(of(together(ball(1), bubbles)), Marks({0, 1, 1}));
        EXPECT_EQ(of(together(shell, ball(.5))), Marks({0, 1, 0})) << "a seed in its shell";
        EXPECT_EQ(of(together(shell, together(ball(.5), reversed(ball(.4))))), Marks({0, 1, 0, 1}));
    }
}

TEST(Cavities, AreNotWhatIsABodyOfItsOwn) {
    const std::vector<char> none{0, 0};
    EXPECT_EQ(cavities(together(ball(1), ball(.3, {.5, 0, 0}))), none) << "an eye";
    EXPECT_EQ(cavities(together(ball(1), reversed(ball(.3, {1, 0, 0})))), none) << "comes out";
    EXPECT_EQ(cavities(together(ball(1), reversed(ball(.3, {.95, .95, 0})))), none) << "beside it";
    EXPECT_EQ(cavities(together(ball(1), reversed(ball(1, {3, 0, 0})))), none);
    EXPECT_EQ(cavities(ball(1)), std::vector<char>{0});
    // In the hole of a ring, within its box.
    EXPECT_EQ(cavities(together(shapes::torus(2, .5, 24, 12), reversed(ball(.4)))), none);
    // In a bowl, and the inner side of one.
    TriangleMesh bowl = shapes::ellipsoid(3);
    std::vector<int> lower;
    for (int f = 0; f < bowl.face_count(); ++f)
        if (bowl.vertices(bowl.faces(f, 0), 2) < .3) lower.push_back(f);
    bowl.faces = bowl.faces(lower, Eigen::all).eval();
    TriangleMesh lining = reversed(bowl);
    lining.vertices *= .95;
    EXPECT_EQ(cavities(together(bowl, reversed(ball(.3, {0, 0, -.3})))), none);
    EXPECT_EQ(cavities(together(bowl, lining)), none);
}

TEST(Cavities, MayComeThroughHereAndThere) {
    TriangleMesh inner = reversed(ball(.95));
    for (int v = 0; v < inner.vertex_count(); v += 20) inner.vertices.row(v) *= 1.1;
    EXPECT_EQ(cavities(together(ball(1), inner)), std::vector<char>({0, 1}));
    for (int v = 1; v < inner.vertex_count(); v += 4) inner.vertices.row(v) *= 1.1;
    EXPECT_EQ(cavities(together(ball(1), inner)), std::vector<char>({0, 0}));
}

TEST(Cavities, AreFoundInSpiteOfPinholes) {
    TriangleMesh outer = shapes::ellipsoid(4), inner = reversed(outer);
    inner.vertices *= .98;
    outer.faces.conservativeResize(outer.face_count() - 1, 3);
    inner.faces.conservativeResize(inner.face_count() - 1, 3);
    EXPECT_EQ(cavities(together(outer, inner)), std::vector<char>({0, 1}));
}

TEST(Cavities, AreLeftOutUnlessAskedFor) {
    const TriangleMesh outer = ball(1), file = together(outer, reversed(ball(.9)));
    const RepairedMesh shell = repaired(file, {}, "shell.off");
    EXPECT_EQ(shell.mesh.vertices, outer.vertices);
    EXPECT_EQ(shell.counts.cavities, 1);
    EXPECT_NEAR(shell.counts.cavity_area, .81 / 1.81, .01);
    EXPECT_EQ(shell.counts.dropped_components, 0);
    EXPECT_EQ(shell.link.fate.back(), VertexFate::component_dropped);
    EXPECT_EQ(in_words(shell.counts), "1 inner wall left out (--components all keeps it)");
    const RepairedMesh both = repaired(file, {.components = Components::all}, "shell.off");
    EXPECT_EQ(both.mesh.vertices, file.vertices);
    EXPECT_EQ(in_words(both.counts), "");
    // A wall that is crumpled has more area than what is around it, and is still not what is mapped.
    TriangleMesh crumpled = reversed(ball(.9));
    for (int v = 0; v < crumpled.vertex_count(); v += 2) crumpled.vertices.row(v) *= .3;
    ASSERT_GT(surface_area(crumpled), surface_area(outer));
    for (const Components which : {Components::outer, Components::largest})
        EXPECT_EQ(repaired(together(crumpled, outer), {.components = which}, "m.off").mesh.vertices,
                  outer.vertices);
}

}  // namespace
}  // namespace varimap
