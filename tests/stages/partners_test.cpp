#include "stages/partners/partners.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fixtures/shapes.h"
#include "fixtures/surface_data.h"
#include "stages/diffuse/diffuse.h"
#include "stages/domain/make_domain.h"
#include "stages/gromov/gromov.h"
#include "stages/partners/picture.h"
#include "stages/refine/refine.h"
#include "stages/tear/tear.h"
#include "varimap/core/error.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

using testing::HasSubstr;

constexpr int point_count = 120;

/// A curve once round a circle whose ends cross, or as straight as it is long.
DomainFile curve(bool straight) {
    DomainFile file{DomainKind::polyline, point_count, Points::Zero(point_count, 3), {}, true};
    for (int i = 0; i < point_count; ++i) {
        const double t = 7.0 * i / (point_count - 1);
        file.positions.row(i) << (straight ? t : std::cos(t)), (straight ? 0 : std::sin(t)), .001 * i;
        if (i > 0)
            file.edges.push_back({i - 1, i, (file.positions.row(i) - file.positions.row(i - 1)).norm(), 0});
    }
    return file;
}

SurfaceData data_of(const Domain& domain, int neighbours) {
    SurfaceData data;
    static_cast<Domain&>(data.surface) = domain;
    data.surface.input = domain.mesh;
    data.basis = compute_eigenbasis(domain, {});
    HierarchyOptions options;
    options.last_neighbours = neighbours;
    data.hierarchy = build_hierarchy(domain, data.basis, options);
    return data;
}

/// Share of the points of a straight curve that go to themselves on the round one, up to one sample.
double kept(Distances distances) {
    DomainParams params;
    params.distances = distances;
    const Domain line = make_domain(curve(true), params, "line"),
                 round = make_domain(curve(false), params, "round");
    const PairContext context(data_of(line, 25), data_of(round, 25), {});
    DiffuseParams diffuse_params;
    diffuse_params.start = FirstCentres::wasserstein;
    diffuse_params.alternation.area_bound = 1;
    RefineParams refine_params;
    refine_params.start = RefineStart::wasserstein;
    refine_params.levels = 1;
    refine_params.metric_weight = refine_params.last_metric_weight = 0;
    refine_params.alternation = diffuse_params.alternation;
    refine_params.alternation.tolerance = 1e-4;
    refine_params.alternation.maximum_alternations = 500;
    const Plan plan = refine(context, diffuse(context, diffuse_params), refine_params);
    const auto partners = best_partners(plan.plan.entries, GeodesicGraph(round), .02);
    int same = 0, reversed = 0;
    for (int i = 0; i < point_count; ++i) {
        same += std::abs(partners[std::size_t(i)].point - i) <= 1;
        reversed += std::abs(partners[std::size_t(i)].point - (point_count - 1 - i)) <= 1;
    }
    return double(std::max(same, reversed)) / point_count;
}

TEST(Curves, IntrinsicPlansUnfoldALoopAndAmbientOnesDoNot) {
    EXPECT_EQ(kept(Distances::intrinsic), 1);
    EXPECT_LT(kept(Distances::ambient), .9);
}

TEST(Partners, AreWhereMostMassLandsWithItsShareAround) {
    const Domain line = make_domain(curve(true), {}, "line");
    SparseMatrix plan(2, point_count);
    plan.insert(0, 10) = .35;
    plan.insert(0, 11) = .35;
    plan.insert(0, 80) = .3;
    plan.makeCompressed();
    const double step = line.edges[0].length;
    const auto partners = best_partners(plan, GeodesicGraph(line), 1.5 * step);
    EXPECT_TRUE(partners[0].point == 10 || partners[0].point == 11);
    EXPECT_NEAR(partners[0].certainty, .7, 1e-12);
    EXPECT_EQ(partners[1].point, -1);
    EXPECT_EQ(partners[1].certainty, 0);
}

TEST(Partners, EdgesWhoseEndsLandFarFromEachOtherAreCounted) {
    const Domain line = make_domain(curve(true), {}, "line");
    std::vector<Partner> partners;
    for (int i = 0; i < point_count; ++i) partners.push_back({i, 1});
    const GeodesicGraph graph(line);
    EXPECT_EQ(share_apart(line, partners, graph, 3), 0);
    partners[50].point = 90;
    EXPECT_NEAR(share_apart(line, partners, graph, 3), 2.0 / (point_count - 1), 1e-12);
}

TEST(Partners, PicturesHaveEveryPointAndNoOddNumber) {
    const Domain line = make_domain(curve(true), {}, "line");
    std::vector<Partner> partners(point_count, Partner{3, .5});
    partners[7] = {};
    for (const Layout layout : {Layout::beside, Layout::together}) {
        const std::string svg = picture_of({line, partners}, {line, partners}, line.mesh.vertices, layout);
        std::size_t circles = 0;
        for (std::size_t at = 0; (at = svg.find("<circle", at)) != svg.npos; ++at) ++circles;
        EXPECT_EQ(circles, 2u * point_count);
        EXPECT_EQ(svg.find("nan"), svg.npos);
    }
}

TEST(Gromov, OfACurveOntoItselfIsTheIdentityOrItsReverse) {
    const Domain line = make_domain(curve(true), {}, "line"), round = make_domain(curve(false), {}, "round");
    GromovParams params;
    params.regularisation = 1e-4;
    const Plan plan = gromov_wasserstein(line, round, params);
    EXPECT_LT((plan.plan.transported_A - line.mass).cwiseAbs().maxCoeff(), 1e-4);
    const auto partners = best_partners(plan.plan.entries, GeodesicGraph(round), .02);
    int ends = 0;
    for (const int i : {0, point_count - 1})
        ends +=
            std::min(partners[std::size_t(i)].point, point_count - 1 - partners[std::size_t(i)].point) <= 6;
    EXPECT_EQ(ends, 2);
}

TEST(Tear, IsFoundWhereAMapTearsAndNowhereElse) {
    const TriangleMesh sphere = shapes::ellipsoid(3);
    const PointMap identity = points_at_vertices(sphere);
    const TearReport whole = find_tear(sphere, sphere, identity, identity, {});
    EXPECT_EQ(whole.torn_edges, 0);
    EXPECT_EQ(whole.reversed_elsewhere, 0);
    EXPECT_EQ(whole.returned_percent, 100);
    EXPECT_NEAR(whole.largest_stretch, 1, 1e-9);
    // One vertex goes to the other side.
    PointMap torn = identity;
    int opposite;
    (sphere.vertices.rowwise() + sphere.vertices.row(5)).rowwise().squaredNorm().minCoeff(&opposite);
    torn[5] = identity[std::size_t(opposite)];
    const TearReport report = find_tear(sphere, sphere, torn, identity, {});
    EXPECT_GE(report.torn_edges, 5);
    EXPECT_EQ(report.reversed_elsewhere, 0);
    EXPECT_EQ(report.returned_percent, 100);
    EXPECT_LT(report.near_area_percent, 10);
    double star = 0;
    for (int f = 0; f < sphere.face_count(); ++f)
        if ((sphere.faces.row(f).array() == 5).any()) star += face_normal(sphere, f).norm() / 2;
    EXPECT_NEAR(report.torn_area_percent, 100 * star / surface_area(sphere), 1e-9);
}

}  // namespace
}  // namespace varimap
