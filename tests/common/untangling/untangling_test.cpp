#include "varimap/untangling/untangling.h"

#include <gtest/gtest.h>

#include "fixtures/bad_maps.h"
#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/quality/quality.h"
#include "varimap/sliding/fold_energy.h"
#include "varimap/verification/verification.h"

namespace varimap {
namespace {

using shapes::longest_edge;
using shapes::mean_error;
using shapes::mirror_patch;
using shapes::noisy_identity;

TEST(FoldEnergy, IsLeastAtAnIsometry) {
    const FoldEnergy energy{0.7, 1e-4};
    const double least = energy.value(2, 1);
    EXPECT_NEAR(least, 1 + 0.7, 1e-6);
    for (const double s1 : {0.3, 0.8, 1.0, 1.2, 2.0})
        for (const double s2 : {0.4, 0.9, 1.0, 1.1, 3.0})
            EXPECT_GE(energy.value(s1 * s1 + s2 * s2, s1 * s2), least - 1e-6);
    EXPECT_GT(energy.value(2, -1), 1e6) << "reversed";
}

TEST(FoldEnergy, HasTheDerivativesOfItsValue) {
    const FoldEnergy energy{0.7, 0.3};
    const double h = 1e-5;
    for (const double q : {0.5, 2.0, 4.0})
        for (const double D : {-0.8, -0.01, 0.4, 1.5}) {
            const auto d = energy.derivatives(q, D);
            const auto up = energy.derivatives(q, D + h), down = energy.derivatives(q, D - h);
            EXPECT_NEAR(d.f, energy.value(q, D), 1e-9 * d.f);
            EXPECT_NEAR(d.f_q, (energy.value(q + h, D) - energy.value(q - h, D)) / (2 * h), 1e-6 * d.f_q);
            EXPECT_NEAR(d.f_D, (up.f - down.f) / (2 * h), 1e-6 * d.f);
            EXPECT_NEAR(d.f_qD, (up.f_q - down.f_q) / (2 * h), 1e-5 * d.f);
            EXPECT_NEAR(d.f_DD, (up.f_D - down.f_D) / (2 * h), 1e-4 * d.f);
        }
}

TEST(FoldEnergy, HasMoreOfItsAreaTermWithAnAreaWeight) {
    const FoldEnergy energy{0.7, 0.3};
    const double h = 1e-5, more = 2.5;
    for (const double D : {-0.8, 0.4, 1.5}) {
        EXPECT_NEAR(energy.with(more).value(3, D), energy.value(3, D) + more * energy.area_value(D), 1e-9);
        const auto d = energy.area_derivatives(D);
        EXPECT_NEAR(d.f_D, (energy.area_value(D + h) - energy.area_value(D - h)) / (2 * h), 1e-6 * d.f);
        EXPECT_EQ(d.f_q, 0);
    }
}

/// Both directions of a map between meshes of the same connectivity, damaged alike: none helps the other.
MapPair both_ways(const PointMap& map) {
    return {map, map};
}

PinnedPair none_pinned(const PointMap& map) {
    return {VertexData<bool>(int(map.size())), VertexData<bool>(int(map.size()))};
}

UntanglingReports untangle_both(MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                                const UntanglingOptions& options = {}) {
    return untangle(maps, A, B, none_pinned(maps.A_to_B), options);
}

void expect_clean(const UntanglingReport& report, const PointMap& map, const TriangleMesh& source,
                  const TriangleMesh& target) {
    EXPECT_GT(report.flipped_before, 50);
    EXPECT_EQ(report.flipped_after, 0);
    EXPECT_EQ(report.mirrored_parts, 0);
    const Distortion after = measure_distortion(map, source, target);
    EXPECT_EQ(after.flipped_count, 0);
    EXPECT_EQ(after.collapsed_count, 0);
}

void expect_untangled(PointMap map, const TriangleMesh& A, const TriangleMesh& B) {
    PinnedPair pinned = none_pinned(map);
    const PointMap truth = shapes::at_vertices(B);
    const int last = int(map.size()) - 1;
    for (const int v : {0, last / 2, last}) {
        pinned.A[v] = pinned.B[v] = true;
        map[v] = truth[v];
    }
    MapPair maps = both_ways(map);
    const UntanglingReports reports = untangle(maps, A, B, pinned, {});
    expect_clean(reports.A_to_B, maps.A_to_B, A, B);
    expect_clean(reports.B_to_A, maps.B_to_A, B, A);
    EXPECT_LT(mean_error(maps.A_to_B, B), mean_error(map, B) / 2);
    EXPECT_LT(mean_error(maps.B_to_A, A), mean_error(map, A) / 2);
    for (const PointMap& image : {maps.A_to_B, maps.B_to_A})
        for (const int v : {0, last / 2, last}) {
            EXPECT_EQ(image[v].face, truth[v].face);
            EXPECT_EQ(image[v].barycentric, truth[v].barycentric);
        }
}

TEST(Untangling, RemovesNoiseAndFoldedPatchesBetweenPoses) {
    const TriangleMesh rest = shapes::figure(0.15), posed = shapes::figure_pose(0.5)(rest);
    PointMap map = noisy_identity(posed, 0.7);
    for (const int centre : {100, 900, 2000}) mirror_patch(map, posed, centre, 0.25);
    expect_untangled(map, rest, posed);
}

TEST(Untangling, WorksOnGenusOne) {
    const TriangleMesh torus = shapes::torus(1, 0.4, 40, 16);
    PointMap map = noisy_identity(torus, 0.8);
    mirror_patch(map, torus, 100, 0.25);
    expect_untangled(map, torus, torus);
}

TEST(Untangling, WorksWithBoundaries) {
    const TriangleMesh square = shapes::square(20);
    PointMap map = noisy_identity(square, 0.8);
    mirror_patch(map, square, 210, 0.12);
    expect_untangled(map, square, square);
}

/// The identity, but for a mirrored part.
PointMap with_a_mirrored_part(const TriangleMesh& mesh) {
    PointMap mirrored = shapes::at_vertices(mesh);
    mirror_patch(mirrored, mesh, 7, 0.9);
    return mirrored;
}

TEST(Untangling, LeavesAMirroredPartAndReportsItWhenPartsAreNotReplaced) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    const PointMap mirrored = with_a_mirrored_part(sphere);
    MapPair maps = both_ways(mirrored);
    UntanglingOptions options;
    options.replace_parts = false;
    const UntanglingReport report = untangle_both(maps, sphere, sphere, options).A_to_B;
    EXPECT_EQ(report.mirrored_parts, 1);
    EXPECT_GT(report.gated_area_percent, 5);
    EXPECT_GT(report.flipped_after, 50);
    EXPECT_EQ(maps.A_to_B[7].face, mirrored[7].face);
    EXPECT_EQ(report.parts_tried, 0);
}

TEST(Untangling, TakesAMirroredPartFromTheOtherDirectionWhereThatIsUpright) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    MapPair maps{with_a_mirrored_part(sphere), shapes::at_vertices(sphere)};
    UntanglingOptions options;
    options.replace_parts = false;
    const UntanglingReport report = untangle_both(maps, sphere, sphere, options).A_to_B;
    EXPECT_GT(report.flipped_before, 50);
    EXPECT_EQ(report.mirrored_parts, 0);
    EXPECT_EQ(report.flipped_after, 0);
    EXPECT_LT(mean_error(maps.A_to_B, sphere), 0.25 * longest_edge(sphere));  // it may turn a little
}

void expect_undone(const UntanglingReport& report, const PointMap& map, const TriangleMesh& source,
                   const TriangleMesh& target, std::size_t most_reversed) {
    EXPECT_GT(report.parts_replaced, 0);
    EXPECT_EQ(report.mirrored_parts, 0);
    EXPECT_EQ(report.flipped_after, 0);
    const Verification found = verify_map(map, source, target);
    EXPECT_LE(found.reversed_faces.size(), most_reversed);
    EXPECT_TRUE(found.branch_vertices.empty());
    EXPECT_LT(mean_error(map, target), 0.1 * longest_edge(target));
}

/// Without a pinned vertex; judged by the true map and by code that shares nothing with untangling.
void expect_undone(const PointMap& map, const TriangleMesh& A, const TriangleMesh& B,
                   std::size_t most_reversed) {
    MapPair maps = both_ways(map);
    const UntanglingReports reports = untangle_both(maps, A, B);
    expect_undone(reports.A_to_B, maps.A_to_B, A, B, most_reversed);
    expect_undone(reports.B_to_A, maps.B_to_A, B, A, most_reversed);
}

TEST(Untangling, UndoesAMirroredCap) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    PointMap map = shapes::at_vertices(sphere);
    mirror_patch(map, sphere, 7, 0.8);
    expect_undone(map, sphere, sphere, 0);
}

TEST(Untangling, UndoesAMirroredLimb) {
    // Rounding decides on a face where the leg bends: of 28 maps between seven poses three had one reversed.
    const TriangleMesh rest = shapes::figure(0.15);
    expect_undone(shapes::mirrored_leg(rest), rest, shapes::figure_pose(0.5)(rest), 1);
}

TEST(Untangling, LeavesAnIsometryNearlyWhereItIs) {
    const TriangleMesh figure = shapes::figure(0.15);
    MapPair maps = both_ways(shapes::at_vertices(figure));
    const UntanglingReports reports = untangle_both(maps, figure, figure);
    EXPECT_EQ(reports.A_to_B.flipped_after, 0);
    EXPECT_EQ(reports.B_to_A.flipped_after, 0);
    EXPECT_LT(mean_error(maps.A_to_B, figure), 0.02 * longest_edge(figure));
    EXPECT_LT(mean_error(maps.B_to_A, figure), 0.02 * longest_edge(figure));
}

TEST(Untangling, GivesTheSameMapAgain) {
    const TriangleMesh torus = shapes::torus(1, 0.4, 40, 16);
    MapPair first = both_ways(noisy_identity(torus, 0.8)), second = first;
    untangle_both(first, torus, torus);
    untangle_both(second, torus, torus);
    for (int v = 0; v < torus.vertex_count(); ++v) {
        EXPECT_EQ(first.A_to_B[v].barycentric, second.A_to_B[v].barycentric);
        EXPECT_EQ(first.B_to_A[v].barycentric, second.B_to_A[v].barycentric);
    }
}

TEST(Untangling, DoesNothingWhenDisabled) {
    const TriangleMesh torus = shapes::torus(1, 0.4, 40, 16);
    const PointMap before = noisy_identity(torus, 0.8);
    MapPair maps = both_ways(before);
    UntanglingOptions options;
    options.enabled = false;
    const UntanglingReport report = untangle_both(maps, torus, torus, options).A_to_B;
    EXPECT_EQ(report.flipped_after, report.flipped_before);
    for (int v = 0; v < torus.vertex_count(); ++v) {
        EXPECT_EQ(maps.A_to_B[v].barycentric, before[v].barycentric);
        EXPECT_EQ(maps.B_to_A[v].barycentric, before[v].barycentric);
    }
}

TEST(Untangling, KeepsVerticesWithoutAnImage) {
    TriangleMesh torus = shapes::torus(1, 0.4, 40, 16);
    PointMap map = noisy_identity(torus, 0.8);
    torus.vertices.conservativeResize(torus.vertex_count() + 1, 3);
    torus.vertices.bottomRows(1) << 9, 9, 9;
    map.emplace_back();
    MapPair maps = both_ways(map);
    const UntanglingReports reports = untangle_both(maps, torus, torus);
    EXPECT_EQ(reports.A_to_B.flipped_after, 0);
    EXPECT_EQ(reports.B_to_A.flipped_after, 0);
    EXPECT_EQ(maps.A_to_B.back().face, -1);
    EXPECT_EQ(maps.B_to_A.back().face, -1);
}

}  // namespace
}  // namespace varimap
