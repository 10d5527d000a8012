#include "stages/locate/rigid_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fixtures/shapes.h"
#include "fixtures/surface_data.h"
#include "stages/locate/agreement.h"
#include "stages/locate/anchors.h"

namespace varimap {
namespace {

/// A figure, and its front turned in space.
struct TurnedPair {
    TriangleMesh rest = shapes::figure(.2);
    std::vector<int> vertex_of;  ///< per vertex of the front that of the figure
    TriangleMesh front;
    double share;
    PairContext context;
    Sketches sketches{context, PartSide::source};
    Sides sides{context.A().surface, context.B().surface, {}, PartSide::source};

    TurnedPair()
        : front(turned_front()),
          share(surface_area(front) / surface_area(rest)),
          context(data(front), data(rest), {}) {}
    static SurfaceData data(const TriangleMesh& mesh) {
        return shapes::surface_data(shapes::unit_surface(mesh), 60);
    }
    TriangleMesh turned_front() {
        std::vector<int> new_vertex(std::size_t(rest.vertex_count()), -1), faces;
        for (int f = 0; f < rest.face_count(); ++f)
            if (rest.vertices(rest.faces.row(f), 0).minCoeff() > -.2) faces.push_back(f);
        TriangleMesh mesh{{}, rest.faces(faces, Eigen::all)};
        for (int& v : mesh.faces.reshaped()) {
            int& number = new_vertex[std::size_t(v)];
            if (number < 0) number = int(vertex_of.size()), vertex_of.push_back(v);
            v = number;
        }
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Vec3(1, -2, 1).normalized()).toRotationMatrix();
        mesh.vertices = rest.vertices(vertex_of, Eigen::all) * turn.transpose();
        return mesh;
    }
    PointMap truth() const {
        PointMap images;
        for (const int v : vertex_of) images.push_back(point_at_vertex(sides.whole.mesh, v));
        return images;
    }
    /// Units of sqrt(area) of the whole.
    double mean_error(const PointMap& images) const {
        double sum = 0;
        for (std::size_t v = 0; v < images.size(); ++v)
            sum += (position(sides.whole.mesh, images[v]) - sides.whole.mesh.vertex(vertex_of[v])).norm();
        return sum / double(images.size());
    }
};

TEST(RigidSearch, FindsWhereThePartFitsAmongOtherPlaces) {
    const TurnedPair pair;
    const std::vector<PointMap> guesses = rigid_guesses(pair.sketches, pair.sides, pair.share);
    ASSERT_GT(guesses.size(), 3u);
    EXPECT_LT(pair.mean_error(guesses.front()), .01);
    EXPECT_GT(pair.mean_error(guesses[1]), .05);
}

TEST(PlacementAgreement, TellsTheRightPlaceFromOthers) {
    const TurnedPair pair;
    const PlacementAgreement agreement(pair.sketches, pair.sides, pair.share);
    const double right = agreement({pair.truth(), 0, 1});
    EXPECT_NEAR(right, 2.5, .05);  // normals at the rim differ
    const std::vector<PointMap> guesses = rigid_guesses(pair.sketches, pair.sides, pair.share);
    for (std::size_t k = 1; k < guesses.size(); ++k) EXPECT_LT(agreement({guesses[k], 0, 1}), right - .1);
    EXPECT_EQ(agreement({PointMap(guesses[0].size()), std::numeric_limits<double>::infinity(), 0}),
              -std::numeric_limits<double>::infinity());
}

/// A third of the part lies somewhere else.
TEST(Anchors, PutWhatIsElsewhereBesideTheSounderHalf) {
    const TurnedPair pair;
    PointMap torn = pair.truth();
    for (int v = 0; v < int(torn.size()); ++v)
        if (pair.rest.vertex(pair.vertex_of[std::size_t(v)]).x() > 1.6) torn[std::size_t(v)] = torn[0];
    const double before = pair.mean_error(torn),
                 after = pair.mean_error(images_by_anchors(torn, pair.sketches, pair.share));
    EXPECT_GT(before, .05);
    EXPECT_LT(after, .02);
}

}  // namespace
}  // namespace varimap
