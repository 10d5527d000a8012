#include "varimap/multilevel/ironing.h"

#include <gtest/gtest.h>

#include "fixtures/known_pair.h"
#include "varimap/multilevel/descent.h"

namespace varimap {
namespace {

using shapes::KnownPair;

/// For every vertex of the rest surface the one that a map starts from in its place: the left foreleg and the
/// tail are mirrored, each across its own axis.
std::vector<int> with_mirrored_limbs(const Surface& rest) {
    std::vector<int> vertex;
    for (int v = 0; v < rest.mesh.vertex_count(); ++v) {
        Vec3 p = rest.mesh.vertex(v) / rest.scale + rest.centre;
        const bool on_leg = p[0] > 0 && p[1] > 0 && p[2] < -.45, on_tail = p[0] < -1.3;
        const double axis = on_leg ? .25 - .0857 * (p[2] + .2) : -.111 * (p[0] + 1.2);
        if (on_leg || on_tail) p[1] = 2 * axis - p[1];
        vertex.push_back(shapes::nearest_vertex(rest.mesh, (p - rest.centre) * rest.scale));
    }
    return vertex;
}

/// Centres of the true map after a move of the source's vertices that is its own inverse.
Centres centres_after(const std::vector<int>& move, const LevelPair& pair, const KnownPair& figures) {
    const TriangleMesh &A = figures.A.surface.mesh, &B = figures.B.surface.mesh;
    std::vector<int> row, column;
    for (int s : pair.A.level.samples)
        row.push_back(shapes::nearest_vertex(B, figures.A_on_B.row(move[std::size_t(s)]).transpose()));
    for (int s : pair.B.level.samples)
        column.push_back(move[std::size_t(shapes::nearest_vertex(A, figures.B_on_A.row(s).transpose()))]);
    return {pair.A.side.averaging.P * RowMatrix(pair.B.vertex_points(row, Eigen::all)),
            pair.B.side.averaging.P * RowMatrix(pair.A.vertex_points(column, Eigen::all))};
}

/// Share of the mass on which a level's map is reversed, solved from the map with mirrored limbs.
double reversed_mass(const PairContext& context, const KnownPair& figures, bool iron, double* energy) {
    constexpr int index = 7;  // about 400 samples
    AlternationOptions alternation;
    alternation.area_bound = 1;
    TracedDescent descent(context, alternation, {});
    descent.enter(context.diffusion_level(index));
    const LevelPair& pair = descent.level();
    const Start start{centres_after(with_mirrored_limbs(figures.A.surface), pair, figures), {}};
    const Solution solution = descent.solve(start, {.index = index, .ironed = iron});
    *energy = solution.step.energy;
    return descent.ironing().measure(pair, solution).reversed_mass();
}

/// A level of about 400 samples, and where a map with mirrored limbs starts there.
struct MirroredLimbs {
    KnownPair figures = shapes::figure_pair(.6, false);
    PairContext context = figures.context();
    Descent descent{context, {}, {}};
    const LevelPair& pair;
    Start start;

    MirroredLimbs()
        : pair(entered()), start{centres_after(with_mirrored_limbs(figures.A.surface), pair, figures), {}} {}
    const LevelPair& entered() {
        descent.enter(context.diffusion_level(7));
        return descent.level();
    }
};

TEST(Ironing, ReturnsTheOrientationOfWhatItEndsWith) {
    MirroredLimbs limbs;
    AlternatingMinimization minimization = limbs.descent.settled(limbs.start);
    const auto orientation = limbs.descent.ironing().iron(limbs.pair, minimization, unobserved);
    ASSERT_TRUE(orientation.has_value());
    const PairOrientation measured = limbs.descent.ironing().measure(limbs.pair, minimization.solution());
    EXPECT_EQ(orientation->A_to_B.determinant, measured.A_to_B.determinant);
    EXPECT_EQ(orientation->B_to_A.determinant, measured.B_to_A.determinant);
}

TEST(Ironing, TakesWhatReversesLessForTheEnergyThatItMayCost) {
    MirroredLimbs limbs;
    const auto reversed_after = [&](double energy_for_mass) {
        IroningOptions options;
        options.maximum_rounds = 0;  // parts are only placed anew
        options.energy_for_mass = energy_for_mass;
        const Ironing& ironing = limbs.descent.ironing();
        AlternatingMinimization minimization = limbs.descent.settled(limbs.start);
        ironing.iron(limbs.pair, minimization, unobserved, options);
        return ironing.measure(limbs.pair, minimization.solution()).reversed_mass();
    };
    EXPECT_LT(reversed_after(IroningOptions().energy_for_mass), .02);
    EXPECT_GT(reversed_after(-1000), .05);  // the energy would have to vanish
}

TEST(Ironing, TurnsMirroredLimbsBack) {
    const KnownPair figures = shapes::figure_pair(.6, false);
    const PairContext context = figures.context();
    double energy_without, energy_with;
    EXPECT_GT(reversed_mass(context, figures, false, &energy_without), .05);
    EXPECT_LT(reversed_mass(context, figures, true, &energy_with), .015);
    EXPECT_LT(energy_with, energy_without);
}

/// Share of the mass on which a map is reversed that began with front and back exchanged, and may only be
/// reflected.
double reversed_after_reflection(bool inside_out) {
    const TriangleMesh shield = shapes::ellipsoid(4, {1, .25, 1.4});
    KnownPair shields = shapes::known_pair(shield, shield, {}, 100, {});
    const Surface& A = shields.A.surface;
    std::vector<int> opposite;
    for (int v = 0; v < A.mesh.vertex_count(); ++v)
        opposite.push_back(shapes::nearest_vertex(A.mesh, A.mesh.vertex(v).cwiseProduct(Vec3(1, -1, 1))));
    if (inside_out)
        for (SurfaceData* side : {&shields.A, &shields.B})
            side->surface.mesh.faces.col(1).swap(side->surface.mesh.faces.col(2));
    const PairContext context = shields.context();
    Descent descent(context, {}, {});
    descent.enter(context.diffusion_level(7));
    const LevelPair& pair = descent.level();
    AlternatingMinimization minimization = descent.settled({centres_after(opposite, pair, shields), {}});
    IroningOptions options;
    options.maximum_rounds = 0;
    options.reanchored_mass = 1;
    const Ironing& ironing = descent.ironing();
    EXPECT_GT(ironing.measure(pair, minimization.solution()).reversed_mass(), options.reflected_mass);
    ironing.iron(pair, minimization, unobserved, options);
    return ironing.measure(pair, minimization.solution()).reversed_mass();
}

TEST(Ironing, ReflectsMirroredMapsOfSurfacesInsideOutToo) {
    const double reversed = reversed_after_reflection(false);
    EXPECT_LT(reversed, .1);
    EXPECT_EQ(reversed_after_reflection(true), reversed);
}

}  // namespace
}  // namespace varimap
