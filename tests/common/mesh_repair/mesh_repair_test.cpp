#include "varimap/mesh_repair/mesh_repair.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fixtures/together.h"
#include "varimap/core/error.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_repair/bridges.h"
#include "varimap/mesh_repair/sheets.h"

namespace varimap {
namespace {

using shapes::together;
using ::testing::Each;
using ::testing::HasSubstr;

RepairedMesh repaired(const TriangleMesh& mesh, const RepairOptions& options = {}) {
    RepairedMesh result = repaired(mesh, options, "m.off");
    require_sheets(result.mesh, "repaired");
    return result;
}

void add_face(TriangleMesh& mesh, int a, int b, int c) {
    mesh.faces.conservativeResize(mesh.face_count() + 1, 3);
    mesh.faces.bottomRows(1) << a, b, c;
}

/// Every triangle with three vertices of its own.
TriangleMesh soup(const TriangleMesh& mesh) {
    TriangleMesh result;
    result.vertices.resize(3 * mesh.face_count(), 3);
    result.faces.resize(mesh.face_count(), 3);
    for (int s = 0; s < 3 * mesh.face_count(); ++s) {
        result.vertices.row(s) = mesh.vertices.row(mesh.faces(s / 3, s % 3));
        result.faces(s / 3, s % 3) = s;
    }
    return result;
}

/// The corners of the repaired faces are where those of the file's faces are, in the same order or turned.
void expect_faces_of_file(const RepairedMesh& repaired) {
    const FileLink& link = repaired.link;
    for (int f = 0; f < repaired.mesh.face_count(); ++f) {
        const int face = link.face[std::size_t(f)];
        if (face < 0) continue;
        const bool turned = link.turned[std::size_t(f)];
        for (int c = 0; c < 3; ++c) {
            const int own = link.file.faces(face, turned && c > 0 ? 3 - c : c);
            EXPECT_EQ(repaired.mesh.vertex(repaired.mesh.faces(f, c)), link.file.vertex(own));
        }
    }
}

TEST(MeshRepair, LeavesGoodMeshesAsTheyAre) {
    TriangleMesh unused = shapes::ellipsoid(1);
    unused.vertices.conservativeResize(unused.vertex_count() + 1, 3);
    unused.vertices.bottomRows(1).setZero();
    for (const TriangleMesh& mesh : {unused, shapes::square(3), shapes::tube(5, 6, false)}) {
        const RepairedMesh same = repaired(mesh);
        EXPECT_FALSE(same.counts.any());
        EXPECT_TRUE(same.link.is_identity());
        EXPECT_EQ(same.mesh.vertices, mesh.vertices);
        EXPECT_EQ(same.mesh.faces, mesh.faces);
        EXPECT_EQ(in_words(same.counts), "");
    }
}

TEST(MeshRepair, WeldsSeparateTriangles) {
    const TriangleMesh sphere = shapes::ellipsoid(2), file = soup(sphere);
    const RepairedMesh whole = repaired(file);
    EXPECT_TRUE(is_closed(whole.mesh));
    EXPECT_EQ(whole.mesh.vertex_count(), sphere.vertex_count());
    EXPECT_EQ(whole.counts.welded, file.vertex_count() - sphere.vertex_count());
    for (int v = 0; v < file.vertex_count(); ++v)
        EXPECT_EQ(whole.mesh.vertex(whole.link.vertex[std::size_t(v)]), file.vertex(v));
    expect_faces_of_file(whole);
}

TEST(MeshRepair, WeldsATriangleThatIsThereTwice) {
    TriangleMesh file = soup(shapes::ellipsoid(1));
    add_face(file, 0, 1, 2);
    add_face(file, 4, 3, 5);
    const RepairedMesh whole = repaired(file);
    EXPECT_TRUE(is_closed(whole.mesh));
    EXPECT_EQ(whole.counts.duplicates, 2);
    EXPECT_EQ(whole.counts.dropped_components, 0);
}

/// Each vertex moved by up to `most`.
TriangleMesh shaken(TriangleMesh mesh, double most) {
    for (int v = 0; v < mesh.vertex_count(); ++v) mesh.vertices(v, v % 3) += most * (v % 7) / 6;
    return mesh;
}

TEST(MeshRepair, WeldsWhatIsNearInTheSizeOfTheEdgesThere) {
    const TriangleMesh separate = soup(shapes::ellipsoid(1));
    for (const double scale : {1e-6, 1., 1e9}) {
        TriangleMesh file = shaken(separate, 1e-4);
        file.vertices *= scale;
        EXPECT_TRUE(is_closed(repaired(file).mesh)) << scale;
    }
    // Small edges are not mistaken for gaps beside large ones.
    TriangleMesh fine = shapes::square(40), coarse = shapes::square(2);
    fine.vertices *= 1e-4;
    fine.vertices.rowwise() += Vec3(5, 0, 0).transpose();
    const RepairedMesh both = repaired(together(coarse, fine), {.least_component = 0});
    EXPECT_EQ(both.counts.welded, 0);
}

TEST(MeshRepair, WeldsWithinATolerance) {
    const TriangleMesh file = shaken(soup(shapes::ellipsoid(1)), 0.03);
    EXPECT_FALSE(is_closed(repaired(file).mesh));
    RepairOptions options;
    options.weld_tolerance = 0.03;
    EXPECT_TRUE(is_closed(repaired(file, options).mesh));
}

/// What was given both sides, or is there twice, with vertices of its own.
TEST(MeshRepair, WeldsCopiesOfAComponent) {
    const TriangleMesh ball = shapes::ellipsoid(2), sheet = shapes::square(3);
    for (const TriangleMesh& mesh : {ball, sheet, soup(ball)})
        for (const bool back : {false, true}) {
            TriangleMesh copy = mesh;
            if (back) copy.faces.col(1).swap(copy.faces.col(2));
            const RepairedMesh once = repaired(together(mesh, copy));
            EXPECT_EQ(once.mesh.faces, repaired(mesh).mesh.faces);
            EXPECT_EQ(once.counts.duplicates, mesh.face_count());
            for (int v = 0; v < mesh.vertex_count(); ++v)
                EXPECT_EQ(once.link.vertex[std::size_t(v)],
                          once.link.vertex[std::size_t(v + mesh.vertex_count())]);
            expect_faces_of_file(once);
        }
    // Two balls that share a part of their faces' places are two.
    TriangleMesh other = ball;
    other.vertices.row(0) *= 1.1;
    EXPECT_EQ(repaired(together(ball, other)).counts.welded, 0);
}

TEST(MeshRepair, DropsFacesWithCornersThatAreNotNumbers) {
    TriangleMesh file = shapes::ellipsoid(1);
    const auto around = vertex_faces(file)[3].size();
    file.vertices(3, 1) = std::numeric_limits<double>::quiet_NaN();
    const RepairedMesh holed = repaired(file);
    EXPECT_EQ(holed.counts.not_finite, int(around));
    EXPECT_EQ(holed.link.vertex[3], -1);
    EXPECT_EQ(holed.link.fate[3], VertexFate::not_finite);
    EXPECT_TRUE(holed.mesh.vertices.allFinite());
    EXPECT_EQ(summarise_topology(holed.mesh).boundary_loops, 1);
    expect_faces_of_file(holed);
}

TEST(MeshRepair, LeavesOutUnusedVerticesThatAreNotNumbers) {
    TriangleMesh file = shapes::ellipsoid(1);
    file.vertices.conservativeResize(file.vertex_count() + 1, 3);
    file.vertices.bottomRows(1).setConstant(std::numeric_limits<double>::quiet_NaN());
    const RepairedMesh mesh = repaired(file);
    EXPECT_EQ(mesh.mesh.vertices, shapes::ellipsoid(1).vertices);
    EXPECT_EQ(mesh.link.fate.back(), VertexFate::not_finite);
}

TEST(MeshRepair, DropsDegenerateAndDuplicateFaces) {
    TriangleMesh file = shapes::ellipsoid(1);
    const int faces = file.face_count();
    add_face(file, 4, 4, 7);
    add_face(file, file.faces(5, 1), file.faces(5, 2), file.faces(5, 0));  // the same way round
    add_face(file, file.faces(6, 1), file.faces(6, 0), file.faces(6, 2));  // and of three, two agree
    add_face(file, file.faces(6, 0), file.faces(6, 1), file.faces(6, 2));
    const RepairedMesh clean = repaired(file);
    EXPECT_EQ(clean.counts.degenerate, 1);
    EXPECT_EQ(clean.counts.duplicates, 3);
    EXPECT_EQ(clean.mesh.face_count(), faces);
    EXPECT_TRUE(is_closed(clean.mesh));
}

TEST(MeshRepair, RemovesFinsAndKeepsOneSideOfTwo) {
    TriangleMesh fin = shapes::ellipsoid(3);
    fin.vertices.conservativeResize(fin.vertex_count() + 1, 3);
    fin.vertices.bottomRows(1) = 1.01 * fin.vertices.row(0);
    const int tip = fin.vertex_count() - 1, a = fin.faces(0, 0), b = fin.faces(0, 1);
    fin.vertices.row(tip) = .505 * (fin.vertices.row(a) + fin.vertices.row(b));
    add_face(fin, a, b, tip);
    add_face(fin, b, a, tip);
    const RepairedMesh shaved = repaired(fin);
    EXPECT_TRUE(is_closed(shaved.mesh));
    EXPECT_EQ(shaved.counts.duplicates, 2);
    EXPECT_EQ(shaved.link.fate[std::size_t(tip)], VertexFate::faces_dropped);

    // A face of the surface that is there once more, the other way round, is no fin.
    TriangleMesh doubled = shapes::ellipsoid(3);
    for (int f = 0; f < shapes::ellipsoid(3).face_count(); f += 7)
        add_face(doubled, doubled.faces(f, 1), doubled.faces(f, 0), doubled.faces(f, 2));
    EXPECT_TRUE(is_closed(repaired(doubled).mesh));

    TriangleMesh twice = shapes::square(3);
    const TriangleMesh once = twice;
    for (int f = 0; f < once.face_count(); ++f)
        add_face(twice, once.faces(f, 1), once.faces(f, 0), once.faces(f, 2));
    EXPECT_EQ(repaired(twice).mesh.faces, once.faces);
}

TEST(MeshRepair, OrientsClosedSurfacesOutwards) {
    TriangleMesh file = shapes::ellipsoid(2);
    for (int f = 0; f < file.face_count(); f += 2) std::swap(file.faces(f, 1), file.faces(f, 2));
    for (const TriangleMesh& mixed : {file, soup(file)}) {
        const RepairedMesh oriented = repaired(mixed);
        EXPECT_TRUE(is_closed(oriented.mesh));
        EXPECT_GT(signed_volume(oriented.mesh), 0);
        EXPECT_EQ(oriented.counts.turned, file.face_count() / 2);
        expect_faces_of_file(oriented);
    }
    // What is oriented alike stays, inside out too; open surfaces go with most of their area.
    TriangleMesh inward = shapes::ellipsoid(2);
    inward.faces.col(1).swap(inward.faces.col(2));
    EXPECT_FALSE(repaired(inward).counts.any());
    TriangleMesh sheet = shapes::square(3);
    std::swap(sheet.faces(0, 1), sheet.faces(0, 2));
    EXPECT_EQ(repaired(sheet).mesh.faces, shapes::square(3).faces);
}

TEST(MeshRepair, CutsOneSidedSurfacesOpen) {
    TriangleMesh band;  // a Moebius band
    constexpr int around = 24;
    band.vertices.resize(2 * around, 3);
    for (int i = 0; i < around; ++i)
        for (int k = 0; k < 2; ++k) {
            const double t = 2 * M_PI * i / around, r = 3 + (k - .5) * std::cos(t / 2);
            band.vertices.row(2 * i + k) << r * std::cos(t), r * std::sin(t), (k - .5) * std::sin(t / 2);
        }
    for (int i = 0; i < around; ++i) {
        const bool last = i + 1 == around;
        const int a = 2 * i, b = 2 * i + 1, c = last ? 1 : a + 2, d = last ? 0 : b + 2;
        add_face(band, a, b, d);
        add_face(band, a, d, c);
    }
    const RepairedMesh cut = repaired(band);
    EXPECT_EQ(cut.counts.opened_edges, 1);
    EXPECT_EQ(cut.counts.cut_edges, 0);
    EXPECT_NE(in_words(cut.counts).find("one side only"), std::string::npos);
    EXPECT_EQ(summarise_topology(cut.mesh).boundary_loops, 1);
    EXPECT_EQ(cut.mesh.face_count(), band.face_count());
    EXPECT_EQ(cut.mesh.vertex_count(), band.vertex_count() + 2);
}

TEST(MeshRepair, SeparatesSheetsAtEdgesOfThreeFaces) {
    TriangleMesh file = shapes::square(2);  // with a wall on one inner edge
    const Edges edges = find_edges(file);
    int inner = 0;
    while (edges.half_edges[inner].size() < 2) ++inner;
    file.vertices.conservativeResize(file.vertex_count() + 1, 3);
    file.vertices.bottomRows(1) << .5, .5, 1;
    const auto [a, b] = edges.vertices[std::size_t(inner)];
    add_face(file, a, b, file.vertex_count() - 1);
    const RepairedMesh cut = repaired(file);
    EXPECT_EQ(cut.counts.cut_edges, 1);
    EXPECT_EQ(connected_components(cut.mesh).count, 2);
    EXPECT_EQ(cut.mesh.vertex_count(), file.vertex_count() + 2);
    EXPECT_EQ(cut.link.fate[std::size_t(a)], VertexFate::split);
}

/// Cubes (0,0,0), (1,1,0) share an edge, (0,0,0), (1,1,1) a vertex.
TriangleMesh cubes(const std::vector<Vec3>& corners) {
    TriangleMesh mesh;
    for (const Vec3& corner : corners) {
        TriangleMesh cube = shapes::make_mesh(
            {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
            {{0, 2, 1},
             {0, 3, 2},
             {4, 5, 6},
             {4, 6, 7},
             {0, 1, 5},
             {0, 5, 4},
             {1, 2, 6},
             {1, 6, 5},
             {2, 3, 7},
             {2, 7, 6},
             {3, 0, 4},
             {3, 4, 7}});
        cube.vertices.rowwise() += corner.transpose();
        mesh = mesh.face_count() == 0 ? cube : together(mesh, cube);
    }
    // As one indexed mesh: equal corners share a number.
    for (int& v : mesh.faces.reshaped())
        for (int w = 0; w < v; ++w)
            if (mesh.vertices.row(w) == mesh.vertices.row(v)) v = w;
    return mesh;
}

/// So many pages around one edge, in equal angles; every other one turned, or none.
TriangleMesh book(int pages, bool turn) {
    TriangleMesh mesh{Points(2 + pages, 3), Faces(pages, 3)};
    mesh.vertices.row(0) << 0, 0, 0;
    mesh.vertices.row(1) << 0, 0, 1;
    for (int p = 0; p < pages; ++p) {
        const double angle = 2 * std::numbers::pi * (p + .5) / pages;
        mesh.vertices.row(2 + p) << std::cos(angle), std::sin(angle), .5;
        mesh.faces.row(p) << (turn && p % 2 ? 1 : 0), (turn && p % 2 ? 0 : 1), 2 + p;
    }
    return mesh;
}

TEST(MeshRepair, PagesOfABookHangTogetherInPairs) {
    for (const int pages : {8, 64, 66, 2000}) {
        const Sheets flat = find_sheets(book(pages, false)), wedges = find_sheets(book(pages, true));
        EXPECT_EQ(flat.cut_edges, 1);
        EXPECT_EQ(flat.origin.size(), 2u * unsigned(pages));  // four for each two
        EXPECT_EQ(wedges.origin.size(), 2u * unsigned(pages));
        for (int p = 0; p < pages / 2; ++p) EXPECT_EQ(flat.faces(p, 0), flat.faces(p + pages / 2, 0));
        for (int p = 1; p < pages; p += 2)
            EXPECT_EQ(wedges.faces(p, 1), wedges.faces((p + 1) % pages, 0)) << p;
    }
}

TEST(MeshRepair, SeparatesSolidsThatTouch) {
    for (const Vec3& other : {Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
        const TriangleMesh file = cubes({{0, 0, 0}, other});
        EXPECT_THROW(require_sheets(file, "cubes"), InputError);
        const RepairedMesh apart = repaired(file);
        EXPECT_TRUE(is_closed(apart.mesh));
        EXPECT_EQ(apart.mesh.vertex_count(), 16);
        EXPECT_EQ(apart.counts.split_vertices, other[2] == 0 ? 2 : 1);
        EXPECT_NEAR(signed_volume(apart.mesh), 2, 1e-12);
        expect_faces_of_file(apart);
    }
}

TEST(MeshRepair, ChoosesComponentsByTheirArea) {
    TriangleMesh file = together(together(shapes::ellipsoid(1, {.05, .05, .05}), shapes::ellipsoid(2)),
                                 shapes::moved(shapes::ellipsoid(1), .5, 0, {3, 0, 0}));
    const RepairedMesh both = repaired(file);
    EXPECT_EQ(both.counts.dropped_components, 1);
    EXPECT_NEAR(both.counts.dropped_area, .002, .0005);
    EXPECT_EQ(both.link.fate[0], VertexFate::component_dropped);
    RepairOptions options;
    options.components = Components::largest;
    const RepairedMesh one = repaired(file, options);
    EXPECT_EQ(one.mesh.vertices, shapes::ellipsoid(2).vertices);
    options.repair = "weld,faces,sheets";
    EXPECT_THROW(repaired(file, options), InputError);
}

TEST(MeshRepair, BridgesMakeOneSurface) {
    const RepairedMesh apart =
        repaired(together(shapes::ellipsoid(2), shapes::moved(shapes::torus(2, 1, 12, 9), 1, 0, {6, 0, 0})));
    const RepairedMesh joined = bridged(apart);
    EXPECT_EQ(joined.counts.bridges, 1);
    require_manifold(joined.mesh, "joined");
    EXPECT_TRUE(is_closed(joined.mesh));
    EXPECT_EQ(summarise_topology(joined.mesh).genus, 1);
    EXPECT_EQ(joined.mesh.face_count(), apart.mesh.face_count() + 4);
    EXPECT_EQ(std::count(joined.link.face.begin(), joined.link.face.end(), -1), 6);
    expect_faces_of_file(joined);
    const RepairedMesh one = bridged(repaired(shapes::ellipsoid(1)));
    EXPECT_TRUE(one.link.is_identity());
}

/// A ball within another is joined to it anywhere as well: opposite to the spike, wherever the ball lies.
TEST(MeshRepair, BridgesOfRoundPartsLieOppositeToATip) {
    TriangleMesh outer = shapes::ellipsoid(3);
    Eigen::Index spike = 0;
    outer.vertices.col(0).maxCoeff(&spike);
    outer.vertices.row(spike) *= 3;
    for (const Vec3& shift : {Vec3(0, .03, 0), Vec3(0, -.02, .02)}) {
        TriangleMesh inner = shapes::ellipsoid(3, Vec3::Constant(.9));
        inner.vertices.rowwise() += shift.transpose();
        const RepairedMesh joined = bridged(repaired(together(outer, inner)));
        ASSERT_EQ(joined.counts.bridges, 1);
        for (int f = 0; f < joined.mesh.face_count(); ++f) {
            if (joined.link.face[std::size_t(f)] >= 0) continue;
            for (const int v : joined.mesh.faces.row(f)) EXPECT_LT(joined.mesh.vertices(v, 0), -.8);
        }
    }
}

TEST(MeshRepair, RefusesWhatItIsNotAskedToRepair) {
    TriangleMesh mixed = shapes::ellipsoid(1);
    std::swap(mixed.faces(0, 1), mixed.faces(0, 2));
    RepairOptions none;
    none.repair = "none";
    EXPECT_THROW(repaired(mixed, none), InputError);
    none.repair = "weld,faces";
    EXPECT_THROW(repaired(mixed, none), InputError);
    none.repair = "sheets";
    EXPECT_EQ(repaired(mixed, none).counts.turned, 1);
    none.repair = "everything";
    EXPECT_THROW(repaired(mixed, none), UsageError);
    TriangleMesh nothing = shapes::ellipsoid(0);
    nothing.vertices.setConstant(std::numeric_limits<double>::infinity());
    EXPECT_THROW(repaired(nothing), InputError);
}

/// A map between files and the same between repaired meshes lead to the same places.
TEST(FileLink, LeadsThereAndBack) {
    TriangleMesh file = soup(shapes::ellipsoid(1));
    for (int f = 0; f < file.face_count(); f += 3) std::swap(file.faces(f, 1), file.faces(f, 2));
    file.vertices(7, 0) = std::numeric_limits<double>::quiet_NaN();
    const RepairedMesh mesh = repaired(file);
    PointMap identity = points_at_vertices(mesh.mesh);
    for (SurfacePoint& point : identity) point.barycentric = .2 * Vec3::Ones() + .4 * point.barycentric;
    const PointMap in_file = to_file(identity, mesh.link, mesh.link, mesh.mesh);
    ASSERT_EQ(int(in_file.size()), file.vertex_count());
    for (int v = 0; v < file.vertex_count(); ++v) {
        const int own = mesh.link.vertex[std::size_t(v)];
        ASSERT_EQ(in_file[std::size_t(v)].face < 0, own < 0);
        if (own < 0) continue;
        const Vec3 there = position(mesh.mesh, identity[std::size_t(own)]);
        EXPECT_LT((position(file, in_file[std::size_t(v)]) - there).norm(), 1e-14);
    }
    const PointMap back = from_file(in_file, mesh.link, mesh.link);
    for (std::size_t v = 0; v < back.size(); ++v) {
        EXPECT_EQ(back[v].face, identity[v].face);
        EXPECT_EQ(back[v].barycentric, identity[v].barycentric);
    }
}

TEST(FileLink, PointsOnBridgesGoToFacesOfTheFile) {
    const RepairedMesh joined = bridged(
        repaired(together(shapes::ellipsoid(2), shapes::moved(shapes::ellipsoid(1), 1, 0, {4, 0, 0}))));
    PointMap everywhere;
    for (int f = 0; f < joined.mesh.face_count(); ++f) everywhere.push_back({f, Vec3::Constant(1. / 3)});
    const PointMap in_file = to_file(everywhere, {}, joined.link, joined.mesh);
    for (std::size_t f = 0; f < in_file.size(); ++f) {
        ASSERT_GE(in_file[f].face, 0);
        if (joined.link.face[f] >= 0) {
            EXPECT_EQ(in_file[f].face, joined.link.face[f]);
        }
    }
}

}  // namespace
}  // namespace varimap
