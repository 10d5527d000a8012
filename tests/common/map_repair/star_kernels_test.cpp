#include "varimap/map_repair/star_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/core/index_set.h"
#include "varimap/map_repair/chart_repair.h"
#include "varimap/verification/verification.h"

namespace varimap {
namespace {

class StarKernelsOfASphere : public testing::Test {
  protected:
    const TriangleMesh sphere_ = shapes::ellipsoid(3);

    /// The identity, but for one vertex, which lies on another.
    PointMap with_one_astray(int astray, int on) const {
        PointMap images = shapes::at_vertices(sphere_);
        images[std::size_t(astray)] = images[std::size_t(on)];
        return images;
    }
    /// The nearest of those 1.5 edges away or more.
    int beyond_the_star_of(int v) const {
        const double edge = std::sqrt(surface_area(sphere_) / sphere_.face_count() * 4 / std::sqrt(3));
        int nearest = -1;
        const auto distance = [&](int u) { return (sphere_.vertex(u) - sphere_.vertex(v)).norm(); };
        for (int u = 0; u < sphere_.vertex_count(); ++u)
            if (distance(u) > 1.5 * edge && (nearest < 0 || distance(u) < distance(nearest))) nearest = u;
        return nearest;
    }
    std::vector<int> reversed(const PointMap& map) const {
        return verify_map(map, sphere_, sphere_).reversed_faces;
    }
    static std::vector<int> moved(const PointMap& before, const PointMap& after) {
        std::vector<int> vertices;
        for (std::size_t v = 0; v < before.size(); ++v)
            if (before[v].face != after[v].face || before[v].barycentric != after[v].barycentric)
                vertices.push_back(int(v));
        return vertices;
    }
};

TEST_F(StarKernelsOfASphere, TakeAVertexBackIntoItsStar) {
    for (const int astray : {1, 100, 333}) {
        SlidingMap map(with_one_astray(astray, beyond_the_star_of(astray)), sphere_, sphere_);
        const PointMap before = map.points();
        ASSERT_FALSE(reversed(before).empty());
        AlongTarget along_target(map);
        StarKernels(map, along_target).centre(reversed(before), {astray});
        EXPECT_TRUE(reversed(map.points()).empty());
        EXPECT_EQ(moved(before, map.points()), std::vector{astray});
        // On this even mesh the centre is near the place that the vertex had.
        EXPECT_LT((position(sphere_, map.point(astray)) - sphere_.vertex(astray)).norm(), 0.05);
    }
}

TEST_F(StarKernelsOfASphere, LeaveWhatMayNotMoveAndWhatIsUpright) {
    SlidingMap map(with_one_astray(100, beyond_the_star_of(100)), sphere_, sphere_);
    const PointMap before = map.points();
    AlongTarget along_target(map);
    StarKernels kernels(map, along_target);
    kernels.centre(reversed(before), {});
    EXPECT_TRUE(moved(before, map.points()).empty());
    kernels.centre({0, 1, 2}, {0, 1, 2, 3, 4, 5});
    EXPECT_TRUE(moved(before, map.points()).empty());
}

TEST_F(StarKernelsOfASphere, StayAsTheyAreWhereANeighbourHasNoImage) {
    const int astray = 100;
    PointMap images = with_one_astray(astray, beyond_the_star_of(astray));
    images[std::size_t(vertex_neighbours(sphere_)[astray][0])].face = -1;
    SlidingMap map(images, sphere_, sphere_);
    const PointMap before = map.points();
    AlongTarget along_target(map);
    StarKernels(map, along_target).centre(reversed(before), {astray});
    EXPECT_TRUE(moved(before, map.points()).empty());
}

TEST_F(StarKernelsOfASphere, MakeRoomWhereNoneIsLeft) {
    // The vertices of a star change places at random: for many there is no right place until others move.
    const Adjacency neighbours = vertex_neighbours(sphere_);
    std::mt19937 random(1);
    int mended = 0, tried = 0;
    for (int centre = 0; centre < sphere_.vertex_count(); centre += 20, ++tried) {
        std::vector<int> star(neighbours[centre].begin(), neighbours[centre].end());
        star.push_back(centre);
        std::vector<int> places = star, free = star;
        for (std::size_t i = places.size() - 1; i > 0; --i) std::swap(places[i], places[random() % (i + 1)]);
        PointMap images = shapes::at_vertices(sphere_);
        for (std::size_t i = 0; i < star.size(); ++i)
            images[std::size_t(star[i])] = point_at_vertex(sphere_, places[i]);
        for (const int v : star) free.insert(free.end(), neighbours[v].begin(), neighbours[v].end());
        make_set(free);
        SlidingMap map(images, sphere_, sphere_);
        AlongTarget along_target(map);
        StarKernels(map, along_target).centre(reversed(map.points()), free);
        mended += reversed(map.points()).empty();
    }
    EXPECT_GE(mended, tried - 2) << mended << " of " << tried;
}

TEST_F(StarKernelsOfASphere, AreCentredByTheRepairWhichSaysWhereItMovedSomething) {
    const int astray = 100, fixed = beyond_the_star_of(astray);
    SlidingMap map(with_one_astray(astray, fixed), sphere_, sphere_);
    const PointMap before = map.points();
    AlongTarget along_target(map);
    NormalAgreement agreement(map, along_target);
    ChartRepair repair(map, along_target, agreement, PointMap(before.size()));
    VertexData<bool> stays(sphere_.vertex_count());
    stays[fixed] = true;
    const std::vector<int> touched = repair.centre_stars(stays);
    EXPECT_TRUE(reversed(map.points()).empty());
    const std::vector<int> vertices = moved(before, map.points());
    EXPECT_EQ(std::count(vertices.begin(), vertices.end(), fixed), 0);
    for (const int v : vertices)
        for (const int f : map.faces_of_vertex()[v])
            EXPECT_TRUE(std::binary_search(touched.begin(), touched.end(), f));
    EXPECT_TRUE(repair.centre_stars(stays).empty());
}

}  // namespace
}  // namespace varimap
