#include "varimap/pair_stage/unlike_surfaces.h"

#include <gtest/gtest.h>

#include "stages/preprocess/preprocess.h"
#include "tests/fixtures/shapes.h"
#include "varimap/core/warnings.h"

namespace varimap {
namespace {

Surface ball(bool inside_out, bool mirrored) {
    TriangleMesh mesh = shapes::ellipsoid(2);
    if (inside_out) mesh.faces.col(1).swap(mesh.faces.col(2));
    PreprocessParams params;
    params.mirror = mirrored;
    return preprocess(mesh, params);
}

std::size_t warnings_of(const Surface& A, const Surface& B) {
    const std::size_t before = logged_warnings().size();
    warn_of_inside_out(A, B);
    return logged_warnings().size() - before;
}

TEST(UnlikeSurfaces, OneInsideOutIsSaid) {
    const Surface out = ball(false, false), in = ball(true, false);
    EXPECT_EQ(warnings_of(out, out), 0u);
    EXPECT_EQ(warnings_of(in, in), 0u);
    ASSERT_EQ(warnings_of(in, out), 1u);
    EXPECT_NE(logged_warnings().back().find("the source is inside out"), std::string::npos);
    ASSERT_EQ(warnings_of(out, in), 1u);
    EXPECT_NE(logged_warnings().back().find("the target is inside out"), std::string::npos);
    // --mirror is the user's word on it.
    EXPECT_EQ(warnings_of(ball(true, true), out), 0u);
    EXPECT_EQ(warnings_of(ball(false, true), out), 0u);
}

}  // namespace
}  // namespace varimap
