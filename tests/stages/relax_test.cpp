#include "stages/relax/relax.h"

#include <gtest/gtest.h>

#include "fixtures/bad_maps.h"
#include "fixtures/mesh_vertex.h"
#include "fixtures/shapes.h"
#include "fixtures/sphere_pair.h"
#include "stages/coarsen/coarsen.h"
#include "stages/preprocess/preprocess.h"
#include "stages/relax/placed_part.h"
#include "stages/relax/prolongation.h"
#include "varimap/core/error.h"
#include "varimap/core/logged.h"
#include "varimap/mesh/topology.h"
#include "varimap/quality/quality.h"
#include "varimap/verification/verification.h"

namespace varimap {
namespace {

using shapes::SpherePair;

int flipped(const PointMap& map, const Surface& source, const Surface& target) {
    return measure_distortion(map, source.input, target.input).flipped_count;
}

TEST(Relax, MapsInputVerticesToInputFaces) {
    const SpherePair pair;
    const SurfaceMap map = pair.as_planned();
    ASSERT_EQ(int(map.A_to_B.size()), pair.A.input.vertex_count());
    EXPECT_EQ(map.A_to_B[0].face, -1);
    for (int v = 1; v < pair.A.input.vertex_count(); ++v) {
        ASSERT_GE(map.A_to_B[std::size_t(v)].face, 0);
        EXPECT_LT((position(pair.B.input, map.A_to_B[std::size_t(v)]) - pair.B.input.vertex(v)).norm(),
                  1e-12);
        EXPECT_LT((position(pair.A.input, map.B_to_A[std::size_t(v)]) - pair.A.input.vertex(v)).norm(),
                  1e-12);
    }
}

TEST(Relax, PinsLandmarksUnlessTheyAreSoft) {
    SpherePair pair;
    pair.plan.record.landmarks = {{{5}, {9}}};  // a wrong one; behind the spare vertex
    const auto distance = [&] {
        return (position(pair.B.input, pair.as_planned().A_to_B[6]) - pair.B.input.vertex(10)).norm();
    };
    EXPECT_LT(distance(), 1e-12);
    pair.plan.record.landmark_weight = .5;
    EXPECT_GT(distance(), .01);
}

TEST(Relax, DrawsLandmarksThatArePointsOntoEachOther) {
    SpherePair pair;
    const SurfacePoint from{3, Vec3(.5, .3, .2)}, to{3, Vec3(.3, .2, .5)};
    pair.plan.record.landmarks = {{{pair.A.mesh.faces(3, 0)}, {pair.B.mesh.faces(3, 0)}}};
    pair.plan.record.landmark_points = {{from, to}};
    const auto residual = [&](const SurfaceMap& map) {
        return landmark_residuals(map.A_to_B, pair.plan.record.landmark_points, pair.A.input,
                                  pair.B.input)[0];
    };
    const double before = residual(pair.as_planned());
    EXPECT_GT(before, .02);
    EXPECT_LT(residual(pair.relaxed()), .3 * before) << "the rest: the triangle lies below the sphere";
}

TEST(Relax, Untangles) {
    SpherePair pair;
    for (int v = 40; v < 60; ++v) pair.plan.centre_A.row(v).swap(pair.plan.centre_A.row(v + 60));
    pair.make_incomplete();
    const SurfaceMap tangled = pair.as_planned(), map = pair.relaxed();
    const int before = flipped(tangled.A_to_B, pair.A, pair.B);
    EXPECT_GT(before, 50);
    EXPECT_EQ(tangled.untangling.A_to_B.flipped_after, before);
    EXPECT_EQ(map.untangling.A_to_B.flipped_before, before);
    EXPECT_EQ(map.untangling.A_to_B.flipped_after, 0);
    EXPECT_EQ(flipped(map.A_to_B, pair.A, pair.B), 0);
    EXPECT_LT((position(pair.B.input, map.A_to_B[6]) - pair.B.input.vertex(6)).norm(), 1e-12) << "landmark";
}

/// The plan mirrors half of the sphere; the region says where each vertex belongs.
TEST(RelaxPart, BeginsWhereThePartWasPlacedIfThePlanLeadsAstray) {
    SpherePair pair;
    pair.make_incomplete();
    pair.plan.record.landmarks.clear();
    PartRegion region;
    region.part_is_source = true;
    region.strain = .05;
    region.placed = pair.as_planned().A_to_B;
    Plan astray = pair.plan;
    for (Points* centres : {&astray.centre_A, &astray.centre_B})
        for (Eigen::Index v = 0; v < centres->rows(); ++v)
            if ((*centres)(v, 0) > 0) (*centres)(v, 1) *= -1;
    const auto error = [&](const SurfaceMap& map) {
        double sum = 0;
        for (int v = 1; v < pair.A.input.vertex_count(); ++v)
            sum += (position(pair.B.input, map.A_to_B[std::size_t(v)]) - pair.B.input.vertex(v)).norm();
        return sum / pair.A.input.vertex_count() * pair.B.scale;
    };
    const auto mapped = [&](const Plan& plan) {
        return relax_part(pair.A, pair.B, plan.record, read_out(plan, pair.A, pair.B), region,
                          plan.plan.area_bound);
    };
    const SurfaceMap alone =
        relax(pair.A, pair.B, astray.record, read_out(astray, pair.A, pair.B), astray.plan.area_bound);
    EXPECT_GT(error(alone), .05);
    const std::size_t before = logged_warnings().size();
    const SurfaceMap begun = mapped(astray);
    EXPECT_LT(error(begun), .005);
    warn_of_mirrored_parts(begun);
    EXPECT_EQ(logged_warnings().size(), before) << "of the map that was not kept";
    warn_of_mirrored_parts(alone);
    EXPECT_EQ(logged_warnings().size(), before + 2);
    region.placed = alone.A_to_B;
    EXPECT_LT(error(mapped(pair.plan)), .005) << "the plan's is no worse";
    region.placed = pair.as_planned().A_to_B;
    region.strain = .2;
    EXPECT_GT(error(mapped(astray)), .05) << "a doubtful place";
    region.placed.pop_back();
    EXPECT_THROW(mapped(pair.plan), ArtifactError);
}

/// Images of a coarse mesh's vertices at themselves.
TEST(Relax, CarriesAMapOfCoarseMeshesOverToTheInputs) {
    CoarsenParams coarse;
    coarse.vertices = 900;
    const Surface surface = coarsened(preprocess(shapes::figure(.12), {}), coarse);
    ASSERT_GT(surface.input.vertex_count(), 4000);
    PairRecord record;
    record.landmarks = {{shapes::mesh_vertex_at(surface, {77}), shapes::mesh_vertex_at(surface, {77})}};
    record.landmark_points = {{point_at_vertex(surface.input, 77), point_at_vertex(surface.input, 77)}};
    const PointMap identity = points_at_vertices(surface.mesh);
    const SurfaceMap map = relax(surface, surface, record, {identity, identity}, 2);
    double sum = 0;
    for (int v = 0; v < surface.input.vertex_count(); ++v)
        sum += (position(surface.input, map.A_to_B[std::size_t(v)]) - surface.input.vertex(v)).norm();
    EXPECT_LT(sum / surface.input.vertex_count(), .01) << "in a figure about 4 long with edges of .12";
    EXPECT_EQ(flipped(map.A_to_B, surface, surface), 0);
    EXPECT_EQ(flipped(map.B_to_A, surface, surface), 0);
    EXPECT_EQ(vertex_of(surface.input, map.A_to_B[77]), 77) << "a landmark at a vertex of the input";
}

/// A part may be exported with the vertices of all that it was cut from.
TEST(Relax, DoesNotCountVerticesThatNoFaceUses) {
    CoarsenParams coarse;
    coarse.vertices = 900;
    const TriangleMesh plain = shapes::figure(.12);
    TriangleMesh exported = plain;
    exported.vertices.conservativeResize(6 * plain.vertex_count(), 3);
    exported.vertices.bottomRows(5 * plain.vertex_count()).setConstant(1);
    const auto mapped = [&](const TriangleMesh& file) {
        const Surface surface = coarsened(preprocess(file, {}), coarse);
        const PointMap noisy = shapes::noisy_identity(surface.mesh, 1);
        return relax(surface, surface, {}, {noisy, noisy}, 2).A_to_B;
    };
    const PointMap map = mapped(plain), of_exported = mapped(exported);
    for (std::size_t v = 0; v < map.size(); ++v) {
        ASSERT_EQ(of_exported[v].face, map[v].face);
        ASSERT_EQ(of_exported[v].barycentric, map[v].barycentric);
    }
}

/// Images of a coarse mesh's vertices up to an edge away from themselves.
TEST(Prolongation, MapsFoldsAnewBeforeTheyAreManyFaces) {
    CoarsenParams coarse;
    coarse.vertices = 1200;
    const Surface surface = coarsened(preprocess(shapes::figure(.06), {}), coarse);
    ASSERT_GT(surface.input.vertex_count(), 10 * surface.mesh.vertex_count()) << "a level lies between";
    const auto relaxed = [&](const UntanglingOptions& options) {
        Prolongation map(shapes::noisy_identity(surface.mesh, 1), surface, surface);
        map.relax_between(VertexData<bool>(surface.mesh.vertex_count()), {}, options);
        return verify_map(map.on_input(), surface.input, surface.input);
    };
    UntanglingOptions by_sliding;
    by_sliding.align_normals = false;
    const Verification found = relaxed({});
    EXPECT_LT(found.reversed_faces.size(), 20u);
    EXPECT_GT(relaxed(by_sliding).reversed_faces.size(), 20u) << "36 by sweeps and the removal of folds";
    EXPECT_TRUE(found.branch_vertices.empty());
}

TEST(Relax, GivesPointsOnTheFacesOfTheFilesOfMirroredSurfaces) {
    SpherePair pair;
    const TriangleMesh file = pair.mirror_A();
    const SurfaceMap map = pair.as_planned();
    for (int v = 1; v < file.vertex_count(); ++v)
        EXPECT_LT((position(file, map.B_to_A[std::size_t(v)]) - file.vertex(v)).norm(), 1e-6);
}

}  // namespace
}  // namespace varimap
