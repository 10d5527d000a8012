#include "varimap/map_surfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "fixtures/shapes.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// What map_surfaces is called with: valid, until a test changes it.
struct Call {
    TriangleMesh A = shapes::ellipsoid(2, {1, .8, .6}), B = A;
    MapOptions options;

    Call() {
        for (const int v : {0, 3, 40, A.vertex_count() - 1})
            options.landmarks.emplace_back(InputVertex{v}, InputVertex{v});
    }
    void set_initial_map(const SurfacePoint& everywhere) {
        options.initial_map.assign(std::size_t(A.vertex_count()), everywhere);
    }
};

/// The changed call is refused by that kind of error, in one line that holds these words.
template <class Refusal>
void expect_refused(const std::function<void(Call&)>& change, const std::string& words) {
    SCOPED_TRACE(words);
    Call call;
    change(call);
    try {
        map_surfaces(call.A, call.B, call.options);
        ADD_FAILURE() << "was accepted";
    } catch (const Refusal& refusal) {
        EXPECT_THAT(refusal.what(), AllOf(HasSubstr(words), Not(HasSubstr("\n"))));
    }
}

TEST(MapSurfaces, TakesValuesAtTheEndsOfTheirRanges) {
    Call call;
    call.set_initial_map({-1, Vec3::Zero()});
    for (const int f : {0, call.B.face_count() - 1})
        call.options.initial_map[std::size_t(call.A.faces(f, 0))] = {f, Vec3::UnitX()};
    call.options.landmark_weight = 1e-3;
    call.options.area_bound = 1;
    const MappedSurfaces mapped = map_surfaces(call.A, call.B, call.options);
    EXPECT_EQ(int(mapped.A_to_B.size()), call.A.vertex_count());
    EXPECT_GT(mapped.A_to_B_quality.coverage, .5);
}

TEST(MapSurfaces, RefusesOptionsOutOfRange) {
    for (const double weight : {0., -1., 2., nan, infinity})
        expect_refused<UsageError>([&](Call& call) { call.options.landmark_weight = weight; },
                                   "is not a number from 0.001 to 1");
    expect_refused<UsageError>([](Call& call) { call.options.landmark_weight = 2; }, "landmark_weight: '2'");
    for (const double bound : {.5, 0., -2., 1e7, nan, infinity})
        expect_refused<UsageError>([&](Call& call) { call.options.area_bound = bound; },
                                   "is not a number from 1 to 1000000");
    expect_refused<UsageError>([](Call& call) { call.options.area_bound = nan; }, "area_bound: 'nan'");
    for (const int candidate : {0, -1, 101})
        expect_refused<UsageError>([&](Call& call) { call.options.candidate = candidate; },
                                   "is not a whole number from 1 to 100");
    expect_refused<UsageError>([](Call& call) { call.options.candidate = 0; }, "candidate: '0'");
}

TEST(MapSurfaces, RefusesToLookForMapsBesideAnInitialOne) {
    const SurfacePoint corner{0, Vec3::UnitX()};
    expect_refused<UsageError>([&](Call& call) { call.set_initial_map(corner), call.options.explore = true; },
                               "initial_map");
    expect_refused<UsageError>([&](Call& call) { call.set_initial_map(corner), call.options.candidate = 2; },
                               "initial_map");
}

TEST(MapSurfaces, RefusesMeshesWithoutFaces) {
    expect_refused<InputError>([](Call& call) { call.A = {}; }, "mesh A: the mesh has no faces");
    expect_refused<InputError>([](Call& call) { call.B.faces.resize(0, 3); },
                               "mesh B: the mesh has no faces");
}

TEST(MapSurfaces, RefusesFacesOfUnknownVertices) {
    for (const int vertex : {-5, -1, 162, 99999999})
        expect_refused<InputError>(
            [&](Call& call) { call.A.faces(7, 2) = vertex; },
            "mesh A: 1 corners of faces name no vertex, the first is one of face 7: vertex " +
                std::to_string(vertex) + " of 162");
    expect_refused<InputError>([](Call& call) { call.B.faces(0, 0) = 162; }, "mesh B: ");
    expect_refused<InputError>([](Call& call) { call.B.vertices.resize(0, 3); }, "mesh B: ");
}

TEST(MapSurfaces, RefusesMeshesWithoutASurface) {
    for (const double value : {nan, infinity})
        expect_refused<InputError>([&](Call& call) { call.A.vertices.setConstant(value); },
                                   "mesh A: no surface is left");
    expect_refused<InputError>([](Call& call) { call.B.vertices.setZero(); }, "mesh B: ");
    expect_refused<InputError>([](Call& call) { call.B.vertices *= 1e60; }, "mesh B: ");
}

TEST(MapSurfaces, RefusesLandmarksThatNameNoVertex) {
    for (const int vertex : {-1, 162, 999999}) {
        const std::string words =
            "landmarks[4]: vertex " + std::to_string(vertex) + " is out of range: mesh ";
        expect_refused<InputError>(
            [&](Call& call) {
                call.options.landmarks.push_back({{vertex}, {5}});
            },
            words + "A has 162 vertices");
        expect_refused<InputError>(
            [&](Call& call) {
                call.options.landmarks.push_back({{5}, {vertex}});
            },
            words + "B has 162 vertices");
    }
}

TEST(MapSurfaces, RefusesLandmarksThatShareAVertex) {
    expect_refused<InputError>(
        [](Call& call) {
            call.options.landmarks.push_back({{3}, {5}});
        },
        "landmarks[4]: vertex 3 of mesh A is already that of landmarks[1]");
    expect_refused<InputError>(
        [](Call& call) {
            call.options.landmarks.push_back({{5}, {40}});
        },
        "landmarks[4]: vertex 40 of mesh B is already that of landmarks[2]");
}

TEST(MapSurfaces, RefusesLandmarksOfNoFace) {
    expect_refused<InputError>(
        [](Call& call) {
            call.A.vertices.conservativeResize(163, 3);
            call.A.vertices.row(162).setConstant(5);
            call.options.landmarks.push_back({{162}, {5}});
        },
        "landmarks[4]: vertex 162 of mesh A belongs to no face");
}

TEST(MapSurfaces, RefusesInitialMapsOfTheWrongLength) {
    for (const int length : {1, 161, 163})
        expect_refused<InputError>(
            [&](Call& call) {
                call.options.initial_map.assign(std::size_t(length), {0, Vec3::UnitX()});
            },
            "initial_map: " + std::to_string(length) + " points, but mesh A has 162 vertices");
}

TEST(MapSurfaces, RefusesInitialMapsThatLeaveTheTarget) {
    const auto expect_point_refused = [](const SurfacePoint& point, const std::string& words) {
        expect_refused<InputError>(
            [&](Call& call) {
                call.set_initial_map({0, Vec3::UnitX()});
                call.options.initial_map[9] = point;
            },
            "initial_map[9]: " + words);
    };
    expect_point_refused({320, Vec3::UnitX()}, "face 320, but the target mesh has 320 faces");
    expect_point_refused({99999999, Vec3::UnitX()}, "face 99999999, but the target mesh has 320 faces");
    expect_point_refused({-2, Vec3::UnitX()}, "barycentric coordinates 1 0 0 on face -2: ");
    expect_point_refused({0, {5, 0, -4}}, "barycentric coordinates 5 0 -4 on face 0: ");
    expect_point_refused({0, {.5, 0, 0}}, "barycentric coordinates 0.5 0 0 on face 0: ");
    expect_point_refused({0, {nan, 0, 1}}, "barycentric coordinates nan 0 1 on face 0: ");
}

TEST(MapSurfaces, RefusesAnInitialMapWithoutImages) {
    expect_refused<InputError>([](Call& call) { call.set_initial_map({}); }, "gives no image to any vertex");
}

}  // namespace
}  // namespace varimap
