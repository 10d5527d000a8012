#include "varimap/mesh/pattern_axes.h"

#include <gtest/gtest.h>

#include "fixtures/shapes.h"

namespace varimap {
namespace {

TEST(PatternAxes, EndWithLeftAndRight) {
    // An animal, x forward and z up.
    TriangleMesh animal = shapes::figure(.15);
    EXPECT_EQ(likely_up(animal), 2);
    EXPECT_EQ(pattern_axes(animal), (std::array{0, 2, 1}));
    animal.vertices.col(0).swap(animal.vertices.col(1));
    animal.faces.col(1).swap(animal.faces.col(2));
    EXPECT_EQ(pattern_axes(animal), (std::array{1, 2, 0}));
    // In another pose it is not even any more.
    EXPECT_EQ(pattern_axes(shapes::figure_pose(1)(shapes::figure(.15))), (std::array{0, 2, 1}));
}

TEST(PatternAxes, AreEvenAcrossTheLastWhereThatCanBeTold) {
    // y up, wide along x as a person with arms out, with a nose along z.
    TriangleMesh person = shapes::ellipsoid(3, Vec3(.9, 1, .3));
    for (int v = 0; v < person.vertex_count(); ++v)
        if (person.vertices(v, 2) > .2) person.vertices(v, 2) += .5 * (person.vertices(v, 2) - .2);
    EXPECT_EQ(pattern_axes(person), (std::array{1, 2, 0}));
}

}  // namespace
}  // namespace varimap
