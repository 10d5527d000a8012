#include "varimap/mesh/polygon_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fixtures/shapes.h"
#include "varimap/core/plane.h"
#include "varimap/mesh/disc.h"

namespace varimap {
namespace {

Points polygon_of(const std::vector<Eigen::Vector2d>& corners) {
    Points polygon = Points::Zero(Eigen::Index(corners.size()), 3);
    for (std::size_t i = 0; i < corners.size(); ++i)
        polygon.row(Eigen::Index(i)).leftCols<2>() = corners[i].transpose();
    return polygon;
}

double signed_area(const Points& points, const Faces& faces, int f) {
    const Vec3 a = points.row(faces(f, 0)), b = points.row(faces(f, 1)), c = points.row(faces(f, 2));
    return (b - a).cross(c - a).z() / 2;
}

TEST(CutIntoEars, CoversAPolygonOnce) {
    const Points comb = polygon_of(
        {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}});
    const Faces ears = cut_into_ears(comb);
    ASSERT_EQ(ears.rows(), 10);
    double area = 0;
    for (int f = 0; f < ears.rows(); ++f) {
        EXPECT_GT(signed_area(comb, ears, f), 0);
        area += signed_area(comb, ears, f);
    }
    EXPECT_NEAR(area, 11, 1e-12);
}

TEST(CutIntoEars, RefusesWhatIsNotSimple) {
    EXPECT_EQ(cut_into_ears(polygon_of({{0, 0}, {1, 1}, {1, 0}, {0, 1}})).rows(), 0) << "crosses itself";
    EXPECT_EQ(cut_into_ears(polygon_of({{0, 0}, {0, 1}, {1, 1}, {1, 0}})).rows(), 0) << "clockwise";
}

/// The unit square bent into a horseshoe around the origin, open below.
Vec3 bent(const Vec3& p) {
    const double angle = std::numbers::pi * (1.1 - 1.2 * p.x()), r = 0.4 + 0.6 * p.y();
    return {r * std::cos(angle), r * std::sin(angle), 0};
}

struct Horseshoe {
    TriangleMesh square;
    std::vector<int> boundary = disc_boundary(square);
    Points polygon{Eigen::Index(boundary.size()), 3};

    explicit Horseshoe(int cells) : square(shapes::square(cells)) {
        for (std::size_t i = 0; i < boundary.size(); ++i)
            polygon.row(Eigen::Index(i)) = bent(square.vertex(boundary[i])).transpose();
    }
    int vertex_near(const Vec3& p) const {
        int v = 0;
        (square.vertices.rowwise() - p.transpose()).rowwise().squaredNorm().minCoeff(&v);
        return v;
    }
    Points filled(const std::vector<Pin>& pins) const {
        return map_onto_polygon(circular_chart(square, boundary), boundary, polygon, pins);
    }
    /// Three vertices, each to where the next would be.
    std::vector<Pin> exchanged() const {
        const Vec3 a(0.4, 0.4, 0), b(0.6, 0.4, 0), c(0.5, 0.6, 0);
        return {{vertex_near(a), bent(b)}, {vertex_near(b), bent(c)}, {vertex_near(c), bent(a)}};
    }
    /// Area of the faces that are reversed, by the polygon's.
    double reversed_share(const Points& positions) const {
        double reversed = 0, all = 0;
        for (int f = 0; f < square.face_count(); ++f) {
            const double area = signed_area(positions, square.faces, f);
            all += area;
            if (area < 0) reversed -= area;
        }
        return reversed / all;
    }
};

TEST(MapOntoPolygon, FillsAHorseshoe) {
    const Horseshoe shoe(16), fine(48);
    const Points positions = shoe.filled({});
    ASSERT_EQ(positions.rows(), shoe.square.vertex_count());
    for (int v = 0; v < positions.rows(); ++v) {
        EXPECT_GT(positions.row(v).norm(), 0.39);
        EXPECT_LT(positions.row(v).norm(), 1 + 1e-9);
    }
    // What is reversed is so because faces are straight.
    EXPECT_LT(shoe.reversed_share(positions), 0.01);
    EXPECT_LT(fine.reversed_share(fine.filled({})), 0.01);
}

TEST(MapOntoPolygon, TakesPinsToTheirPlaces) {
    const Horseshoe shoe(16);
    const Points positions = shoe.filled(shoe.exchanged());
    ASSERT_EQ(positions.rows(), shoe.square.vertex_count());
    for (const auto& [v, place] : shoe.exchanged())
        EXPECT_LT((positions.row(v).transpose() - place).norm(), 1e-12);
    EXPECT_LT(shoe.reversed_share(positions), 0.12);
}

TEST(MapOntoPolygon, RefusesPinsOutside) {
    const Horseshoe shoe(8);
    const int v = shoe.vertex_near({0.5, 0.5, 0});
    EXPECT_EQ(shoe.filled({{v, {0, -0.9, 0}}}).rows(), 0);
}

}  // namespace
}  // namespace varimap
