#include "stages/explore/explore.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "fixtures/explored.h"
#include "fixtures/known_pair.h"
#include "fixtures/surface_data.h"
#include "stages/diffuse/diffuse.h"
#include "stages/explore/appraisal.h"
#include "stages/explore/finishing.h"
#include "stages/explore/landmark_spread.h"
#include "stages/explore/pool.h"
#include "stages/explore/surface_comparison.h"
#include "stages/explore/turns.h"
#include "stages/generate/level_set.h"
#include "varimap/core/logged.h"
#include "varimap/core/rotation.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/results/choice.h"

namespace varimap {
namespace {

using shapes::explored;
using shapes::figures;
using shapes::finish_from;
using shapes::KnownPair;
using shapes::person;
using shapes::reflected;

TEST(Explore, FindsTheMapOfAFigureOntoItsPose) {
    const PairContext context = figures().context();
    const Candidates found = explored(context);
    EXPECT_LT(mean_error(diffuse(context, {}, found), figures()), .035);  // an edge of these meshes
    EXPECT_FALSE(is_mirrored(found.list[0]));
    EXPECT_EQ(found.list[0].moved_mass, 0);
    EXPECT_TRUE(found.previews.empty());  // sure
    EXPECT_TRUE(found.telling.images.empty());
}

TEST(Explore, RanksRivalsBehindTheMap) {
    const Candidates found = explored(figures().context());
    ASSERT_GE(found.list.size(), 2u);
    for (std::size_t k = 1; k < found.list.size(); ++k) {
        EXPECT_GT(found.list[k].moved_mass, .02);
        EXPECT_GE(found.list[k].score, found.list[k - 1].score);
    }
}

TEST(Explore, MapsOppositeHandednessOnlyWhenMirrored) {
    KnownPair pair = reflected(figures());
    pair.A.surface = with_reversed_orientation(std::move(pair.A.surface));
    const PairContext context = pair.context();
    EXPECT_LT(mean_error(diffuse(context, {}, explored(context)), pair), .035);
    const KnownPair plain = reflected(figures());
    const PairContext plain_context = plain.context();
    EXPECT_GT(mean_error(diffuse(plain_context, {}, explored(plain_context)), plain), .05);
}

TEST(Explore, IsTheSameToTheLastBitForAnyThreads) {
    const PairContext context = figures().context();
    const auto bytes = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return encode(explored(context));
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

TEST(Explore, HandsOnWhereGoodLandmarksLead) {
    const KnownPair pair = shapes::figure_pair(1, true, 1000);
    const PairContext context = pair.context();
    ExploreParams params;
    params.only_if_needed = true;
    const Candidates led = explore(context, params);
    ASSERT_EQ(led.list.size(), 1u);
    EXPECT_TRUE(landmarks_decide(led));
    const Diffusion continued = diffuse(context, {}, led);
    EXPECT_LT(mean_error(continued, pair), .035);
    EXPECT_TRUE(continued.record.candidates.empty());  // there was no choice
    const PairContext with_others_left_out(pair.A, pair.B, pair.landmarks, 1, params.few_landmarks);
    EXPECT_TRUE(explore(with_others_left_out, params).list.empty());
    params.few_landmarks = 0;
    EXPECT_TRUE(explore(context, params).list.empty());
}

TEST(Explore, LooksFurtherWhereLandmarksAreFewOrClose) {
    const KnownPair pair = shapes::figure_pair(1, true, 1000);
    const auto with = [&](const VertexPairs<MeshVertex>& landmarks) {
        return PairContext(pair.A, pair.B, landmarks);
    };
    EXPECT_GE(landmarks_apart(pair.context()), 3);
    EXPECT_EQ(landmarks_apart(with({pair.landmarks[0], pair.landmarks[1]})), 2);
    VertexPairs<MeshVertex> close{pair.landmarks[0]};
    for (const int v : pair.A.surface.mesh.faces.reshaped())
        if (close.size() < 4 && v != close[0].first.index &&
            (pair.A.surface.mesh.vertex(v) - pair.A.surface.mesh.vertex(close[0].first.index)).norm() < .1)
            close.push_back(
                {{v}, {shapes::nearest_vertex(pair.B.surface.mesh, pair.A_on_B.row(v).transpose())}});
    ASSERT_EQ(close.size(), 4u);
    EXPECT_LT(landmarks_apart(with(close)), 3);
    EXPECT_TRUE(landmarks_span(pair.context()));
    EXPECT_FALSE(landmarks_span(with(close)));
}

TEST(Explore, LooksFurtherWhereLandmarksLieInALine) {
    const KnownPair shaft =
        shapes::known_pair(shapes::ellipsoid(3, {1, .1, .1}), shapes::ellipsoid(3, {1, .1, .1}), {}, 20, {});
    const TriangleMesh& mesh = shaft.A.surface.mesh;
    const auto at = [&](const Vec3& place) {
        const MeshVertex v{shapes::nearest_vertex(mesh, place)};
        return std::pair(v, v);
    };
    const double length = mesh.vertices.col(0).maxCoeff(), width = mesh.vertices.col(1).maxCoeff();
    const PairContext context(shaft.A, shaft.B, {at({length, 0, 0}), at({-length, 0, 0}), at({0, width, 0})});
    EXPECT_EQ(landmarks_apart(context), 3);
    EXPECT_FALSE(landmarks_span(context));
}

/// A sheet 2 long and 1 wide, rolled up about x from there to the one end or to the other.
TriangleMesh rolled_up(bool at_the_end) {
    TriangleMesh mesh = shapes::square(30);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        constexpr double radius = 0.5;
        const Vec3 p = mesh.vertex(v);
        const double along = 2 * (at_the_end ? p.x() : 1 - p.x()), rolled = std::max(0.0, along - 1) / radius;
        const double x = std::min(along, 1.0) + radius * std::sin(rolled);
        mesh.vertices.row(v) =
            Vec3(at_the_end ? x : 2 - x, p.y() * (1 - 0.2 * p.x()), radius * (1 - std::cos(rolled)));
    }
    return mesh;
}

/// Whose relief disagrees: the landmarks' map is an isometry, and the others are not.
TEST(Explore, HandsOnAnIsometryOfSheetsThatTwoLandmarksGive) {
    const TriangleMesh A = rolled_up(true), B = rolled_up(false);
    ASSERT_TRUE(is_sheet(A));
    const auto data = [](const TriangleMesh& mesh) {
        return shapes::surface_data(shapes::unit_surface(mesh), 60);
    };
    const int tip = 15, base = 30 * 31 + 15;  // in the middle of both ends
    const PairContext context(data(A), data(B), {{{tip}, {tip}}, {{base}, {base}}});
    ExploreParams params;
    params.only_if_needed = true;
    const Candidates found = explore(context, params);
    ASSERT_EQ(found.list.size(), 1u);
    EXPECT_EQ(found.list[0].explored, 0);
    EXPECT_LT(found.list[0].dirichlet, 1.05);
    EXPECT_LT(plausibility(found.list[0]), .95);  // relief alone would have it looked for further
}

/// Warnings of exploring where landmarks may decide.
std::size_t warnings_with(const KnownPair& pair, const VertexPairs<MeshVertex>& landmarks) {
    ExploreParams params;
    params.only_if_needed = true;
    const std::size_t before = logged_warnings().size();
    explore(PairContext(pair.A, pair.B, landmarks), params);
    return logged_warnings().size() - before;
}

TEST(Explore, SaysWhichLandmarksAreExchanged) {
    const KnownPair pair = person();
    EXPECT_EQ(warnings_with(pair, pair.landmarks), 0u);
    VertexPairs<MeshVertex> exchanged;  // hand, foot; hand, foot
    for (std::size_t k = 0; k < 4; ++k)
        exchanged.emplace_back(pair.landmarks[k].first, pair.landmarks[(k + 2) % 4].second);
    ASSERT_EQ(warnings_with(pair, exchanged), 1u);
    EXPECT_THAT(logged_warnings().back(),
                testing::AllOf(testing::HasSubstr("landmarks 1 with 3 and 2 with 4 look exchanged"),
                               testing::HasSubstr("give --mirror")));
}

VertexImages true_images(const KnownPair& pair) {
    const TriangleMesh &A = pair.A.surface.mesh, &B = pair.B.surface.mesh;
    VertexImages images;
    for (int v = 0; v < A.vertex_count(); ++v)
        images.A_to_B.push_back(shapes::nearest_vertex(B, pair.A_on_B.row(v).transpose()));
    for (int v = 0; v < B.vertex_count(); ++v)
        images.B_to_A.push_back(shapes::nearest_vertex(A, pair.B_on_A.row(v).transpose()));
    return images;
}

TEST(Explore, CountsTheLandmarksThatAMapMeetsAlone) {
    const KnownPair pair = person();
    const PairContext context = pair.context();
    const FinishedMap map = finish_from(context, {true_images(pair)}, FinishingOptions()).front();
    const Appraisal appraisal(context);
    Candidate right, one_wrong, two_wrong;
    appraisal.measure(map, pair.landmarks, right);
    EXPECT_EQ(right.landmarks_missed, 0);
    VertexPairs<MeshVertex> landmarks = pair.landmarks;  // hand, foot; hand, foot
    landmarks[0].second = landmarks[1].second;
    appraisal.measure(map, landmarks, one_wrong);
    EXPECT_EQ(one_wrong.landmarks_missed, 1);
    EXPECT_EQ(one_wrong.score, right.score) << "it may be wrong";
    landmarks[1].second = pair.landmarks[0].second;
    appraisal.measure(map, landmarks, two_wrong);
    EXPECT_EQ(two_wrong.landmarks_missed, 2);
    EXPECT_NEAR(two_wrong.score, right.score + 10, 1e-12);
}

/// A shaft with a hexagonal head, of which one side is cut off further in.
KnownPair bolt() {
    // Rounded: at sharp edges the mesh's vertices would go to and fro between two planes.
    const auto larger = [](double a, double b) {
        constexpr double reach = .05;
        const double near = std::max(0., 1 - std::abs(a - b) / reach);
        return std::max(a, b) + reach * near * near / 4;
    };
    const auto f = [&](const Vec3& p) {
        double head = larger(p.x() - .75, std::abs(p.z()) - .4);
        for (int k = 0; k < 6; ++k) {
            const double angle = k * M_PI / 3;
            head = larger(head, std::cos(angle) * p.x() + std::sin(angle) * p.y() - 1);
        }
        const double shaft = larger(std::hypot(p.x(), p.y()) - .5, std::abs(p.z() - 1.5) - 1.5);
        return -larger(-head, -shaft);
    };
    const TriangleMesh mesh = shapes::level_set(f, {-1.217, -1.243, -.631}, {1.2, 1.2, 3.2}, .131),
                       other = shapes::level_set(f, {-1.253, -1.229, -.617}, {1.2, 1.2, 3.2}, .137);
    return shapes::known_pair(mesh, other, {}, 60, {}, 1000);
}

Appraised with_images(const KnownPair& pair, const Points& A_on_B, const Points& B_on_A) {
    Appraised result;
    const ClosestPoint on_A(pair.A.surface.mesh), on_B(pair.B.surface.mesh);
    for (Eigen::Index v = 0; v < A_on_B.rows(); ++v)
        result.map.maps.A_to_B.push_back(on_B(A_on_B.row(v).transpose()).point);
    for (Eigen::Index v = 0; v < B_on_A.rows(); ++v)
        result.map.maps.B_to_A.push_back(on_A(B_on_A.row(v).transpose()).point);
    return result;
}

double least_error(const std::vector<PooledMap>& pool, const KnownPair& pair) {
    double least = 1;
    for (const PooledMap& map : pool)
        least = std::min(least, shapes::mean_error({images_at(map.images.A_to_B, pair.B.surface.mesh),
                                                    images_at(map.images.B_to_A, pair.A.surface.mesh)},
                                                   pair));
    return least;
}

TEST(TurnsAboutAxes, LeadFromATurnedBoltToTheRightOne) {
    const KnownPair pair = bolt();
    const PairContext context = pair.context();
    const Eigen::Matrix3d turn(Eigen::AngleAxisd(2 * M_PI / 3, Vec3::UnitZ()));
    const Appraised turned = with_images(pair, pair.A_on_B * turn.transpose(), pair.B_on_A * turn);
    ASSERT_GT(shapes::mean_error(turned.map.maps, pair), .1);
    const std::vector<PooledMap> pool = turned_about_axes(turned, context, Appraisal(context));
    ASSERT_FALSE(pool.empty());
    EXPECT_TRUE(pool.front().origin.turned_about_axis);
    EXPECT_LT(least_error({pool.front()}, pair), .05);
    EXPECT_GT(least_error({pool.begin() + 1, pool.end()}, pair), least_error({pool.front()}, pair));
}

TEST(TurnsAboutAxes, AreNotTriedWhereNoneBringsASurfaceNearToItself) {
    const KnownPair pair = person();
    const PairContext context(pair.A, pair.B, {});
    const Appraised right = with_images(pair, pair.A_on_B, pair.B_on_A);
    EXPECT_TRUE(turned_about_axes(right, context, Appraisal(context)).empty());
}

double turn_between(const VertexImages& a, const VertexImages& b, const PairContext& context) {
    const auto at = [&](const VertexImages& images) {
        return Points(context.B().surface.mesh.vertices(images.A_to_B, Eigen::all));
    };
    return degrees(nearest_rotation(at(a), at(b), context.A().surface.mass));
}

/// Whatever they look like.
TEST(TurnsByHalves, AreThoseAboutPrincipalAxes) {
    const KnownPair pair = person();
    const PairContext context(pair.A, pair.B, {});
    const Appraised right = with_images(pair, pair.A_on_B, pair.B_on_A);
    const std::vector<PooledMap> pool = turned_by_halves(right, context, Appraisal(context));
    ASSERT_EQ(pool.size(), 2u);
    for (const PooledMap& map : pool) {
        EXPECT_TRUE(map.origin.turned_by_half);
        EXPECT_GT(turn_between(vertex_images(right.map.maps, context), map.images, context), 150);
    }
}

/// Besides the one that is asked for.
TEST(Explore, CoarseLevelsKeepMapsThatAreTurnedAbout) {
    for (const KnownPair& pair : {person(), figures()}) {
        const PairContext context(pair.A, pair.B, {});
        ExploreParams params;
        params.exploration.candidates = params.exploration.coarse = 1;
        const std::vector<PooledMap> pool = explored(context, params.exploration, params);
        EXPECT_TRUE(std::any_of(pool.begin(), pool.end(), [&](const PooledMap& map) {
            return turn_between(pool.front().images, map.images, context) > 150;
        }));
    }
}

/// Every image is another vertex.
VertexImages shifted(VertexImages images, int by, const TriangleMesh& A, const TriangleMesh& B) {
    for (int& image : images.A_to_B) image = (image + by) % B.vertex_count();
    for (int& image : images.B_to_A) image = (image + by) % A.vertex_count();
    return images;
}

TEST(Finishing, IsBestForTheRightMap) {
    const KnownPair& pair = figures();
    const PairContext context = pair.context();
    const Surface &A = context.A().surface, &B = context.B().surface;
    const VertexImages right = true_images(pair);
    const VertexImages wrong = shifted(right, 300, A.mesh, B.mesh);
    FinishingOptions options;
    options.gap = options.gap_at_first = 1000;
    const std::vector<FinishedMap> finished = finish_from(context, {wrong, right}, options);
    ASSERT_FALSE(finished.empty());
    EXPECT_EQ(finished.front().start, 1);
    EXPECT_LT(shapes::mean_error(finished.front().maps.A_to_B, B.mesh, pair.A_on_B), .03);
    const Appraisal appraisal(context);
    Candidate best, other;
    appraisal.measure(finished.front(), {}, best);
    EXPECT_LT(best.reversed_mass, .01);
    EXPECT_GT(best.relief, .8);
    EXPECT_GT(best.alignment, .8);
    EXPECT_LT(best.stretch, .1);
    if (finished.size() > 1) {
        appraisal.measure(finished.back(), {}, other);
        EXPECT_GT(other.score, best.score);
    }
}

TEST(Finishing, DropsWhatIsClearlyWorseButForOneMapThatIsElsewhere) {
    const KnownPair& pair = figures();
    const PairContext context = pair.context();
    const TriangleMesh &A = context.A().surface.mesh, &B = context.B().surface.mesh;
    const VertexImages right = true_images(pair);
    std::vector<VertexImages> starts;
    for (const int by : {300, 100, 0, 200, 400}) starts.push_back(shifted(right, by, A, B));
    FinishingOptions options;
    options.distinct = 0;
    options.gap = options.gap_at_first = 0;
    const std::vector<FinishedMap> finished = finish_from(context, starts, options);
    ASSERT_EQ(finished.size(), 2u);
    EXPECT_EQ(finished[0].start, 2);
    EXPECT_LT(shapes::mean_error(finished[0].maps.A_to_B, B, pair.A_on_B), .03);
    EXPECT_GT(shapes::mean_error(finished[1].maps.A_to_B, B, pair.A_on_B), .3);
    options.gap = options.gap_at_first = 1000;
    EXPECT_EQ(finish_from(context, starts, options).size(), std::size_t(options.most));
}

TEST(Finishing, MeasuresCuesOfAllStartsEvenOfOne) {
    const KnownPair& pair = figures();
    const PairContext context = pair.context();
    const VertexImages right = true_images(pair);
    const VertexImages wrong = shifted(right, 300, context.A().surface.mesh, context.B().surface.mesh);
    const auto start = [](const VertexImages& images) -> MapStart {
        return [&images](const LevelPair& level) { return matching_of(images, level); };
    };
    const Appraisal appraisal(context);
    const auto cues = [&](const std::vector<MapStart>& starts) {
        return cues_when_solved(context, appraisal, starts, FinishingOptions());
    };
    const std::vector<Cues> alone = cues({start(right)}), both = cues({start(right), start(wrong)});
    ASSERT_EQ(alone.size(), 1u);
    ASSERT_EQ(both.size(), 2u);
    EXPECT_GT(alone[0].alignment, .8);
    EXPECT_EQ(alone[0].alignment, both[0].alignment);
    EXPECT_LT(rough_score(both[0]), rough_score(both[1]));
}

/// The right map but for the limb that ends farthest from the centre, which it mirrors.
VertexImages with_a_mirrored_limb(VertexImages images, const TriangleMesh& A) {
    const Vec3 centre = A.vertices.colwise().mean().transpose();
    Eigen::Index tip;
    (A.vertices.rowwise() - centre.transpose()).rowwise().squaredNorm().maxCoeff(&tip);
    const Vec3 along = A.vertex(int(tip)) - centre, across = along.unitOrthogonal();
    const auto is_on_limb = [&](int v) {
        return (A.vertex(v) - A.vertex(int(tip))).norm() < .45 * along.norm();
    };
    const auto reflection = [&](int v) {
        const Vec3 p = A.vertex(v);
        return shapes::nearest_vertex(A, p - 2 * across.dot(p - centre) * across);
    };
    const VertexImages before = images;
    for (int v = 0; v < A.vertex_count(); ++v)
        if (is_on_limb(v)) images.A_to_B[std::size_t(v)] = before.A_to_B[std::size_t(reflection(v))];
    for (int& v : images.B_to_A)
        if (is_on_limb(v)) v = reflection(v);
    return images;
}

TEST(Finishing, PlacesAMirroredLimbAnew) {
    const KnownPair& pair = figures();
    const PairContext context = pair.context();
    const VertexImages start = with_a_mirrored_limb(true_images(pair), context.A().surface.mesh);
    const auto reversed = [&](const FinishingOptions& options) {
        Candidate candidate;
        Appraisal(context).measure(finish_from(context, {start}, options).front(), {}, candidate);
        return candidate.reversed_mass;
    };
    FinishingOptions options;
    EXPECT_LT(reversed(options), .005);
    options.ironing.enabled = false;
    EXPECT_GT(reversed(options), .02);
}

/// Symmetry leaves four maps of an ellipsoid, which keep or reverse coordinates.
KnownPair ellipsoids(int vertices) {
    const TriangleMesh mesh = shapes::ellipsoid(3, {1, .7, .5});
    TriangleMesh other = shapes::moved(shapes::ellipsoid(3), 1, 1, Vec3::Zero());  // tessellated otherwise
    other.vertices *= Vec3(1, .7, .5).asDiagonal();
    return shapes::known_pair(mesh, other, {}, 60, {}, vertices);
}

TEST(Explore, PreviewsMapsWhereItIsNotSure) {
    const KnownPair pair = ellipsoids(1000);
    const TriangleMesh &mesh = pair.A.surface.input, &other = pair.B.surface.input;
    const Candidates found = explored(pair.context());
    ASSERT_EQ(found.previews.size(), std::min(found.list.size(), size_t(3)));
    ASSERT_GT(found.previews.size(), 1u);
    const TellingVertex& told = found.telling;
    ASSERT_EQ(told.images.size(), found.previews.size());
    // The maps turn the ellipsoid about its axes: they take its ends to different ones.
    EXPECT_GT((other.vertex(told.images[0]) - other.vertex(told.images[1])).norm(), .5);
    for (const int image : told.images)
        EXPECT_LT((other.vertex(image).cwiseAbs() - mesh.vertex(told.source).cwiseAbs()).norm(), .3);
    for (const PointMap& map : found.previews) {
        ASSERT_EQ(int(map.size()), other.vertex_count());
        double sum = 0;
        for (int v = 0; v < other.vertex_count(); ++v)
            sum += (position(mesh, map[size_t(v)]).cwiseAbs() - other.vertex(v).cwiseAbs()).norm();
        EXPECT_LT(sum / other.vertex_count(), .2);  // a vertex's distance from the next is .1
    }
}

TEST(Explore, ComparesWhatIsTooCloseOnTheSurfacesThatWereSketched) {
    const KnownPair sketches = ellipsoids(300), surfaces = ellipsoids(1000);
    int asked = 0;
    OnDemand ask;
    ask.surfaces = [&] { return ++asked, surfaces.context(); };
    const Candidates found = explore(sketches.context(), ExploreParams(), ask);
    EXPECT_EQ(asked, 1);
    ASSERT_GE(found.list.size(), 2u);
    EXPECT_FALSE(confidence_of(found.list).confident);
    EXPECT_EQ(found.list[0].moved_mass, 0);
    for (std::size_t k = 0; k < found.list.size(); ++k) {
        EXPECT_EQ(int(found.maps[k].from_A.size()), sketches.A.surface.mesh.vertex_count());
        EXPECT_GE(found.list[k].explored, 1);
        if (k > 0) {
            EXPECT_GE(found.list[k].score, found.list[k - 1].score);
        }
    }
    EXPECT_EQ(found.previews.size(), std::min(found.list.size(), size_t(3)));
}

TEST(SurfaceComparison, PrefersWhatIsBetterThereUnlessItReversesMuch) {
    const PairContext context = figures().context();
    const Appraisal appraisal(context);
    FinishingOptions options;
    FinishedPool finished(context, options, appraisal);
    finished.add(explored(context, {}, {}));
    const Appraised found = finished.appraised().front();
    const int right = found.candidate.explored;
    std::vector<Appraised> list{found, found};
    MapPair& wrong = list[0].map.maps;  // end to end, as far as the vertices' order goes
    std::reverse(wrong.A_to_B.begin(), wrong.A_to_B.end());
    std::reverse(wrong.B_to_A.begin(), wrong.B_to_A.end());
    list[0].candidate.explored = right + 1;
    list[0].candidate.score -= .1;
    list[1].candidate.moved_mass = 1;
    const auto first = [&] {
        return compared_on_surfaces(list, context, options, [&] { return figures().context(); })
            .front()
            .candidate.explored;
    };
    EXPECT_EQ(first(), right);
    list[1].candidate.reversed_mass = .2;
    EXPECT_NE(first(), right);
}

TEST(Explore, LeavesTheSurfacesAloneWhereSketchesDecide) {
    OnDemand ask;
    ask.surfaces = []() -> PairContext { throw std::logic_error("asked for"); };
    EXPECT_FALSE(explore(figures().context(), ExploreParams(), ask).list.empty());
}

TEST(Confidence, NeverCallsAMapImpossibleOrCertain) {
    EXPECT_EQ(probability_in_words({.probability = .914}), "right with a probability of 0.91");
    EXPECT_EQ(probability_in_words({.probability = .0099}), "right with a probability below 0.01");
    EXPECT_EQ(probability_in_words({.probability = 0}), "right with a probability below 0.01");
    EXPECT_EQ(probability_in_words({.probability = .994}), "right with a probability of 0.99");
    EXPECT_EQ(probability_in_words({.probability = .899}), "right with a probability of 0.89");
    EXPECT_EQ(probability_in_words({.probability = .995}), "right with a probability above 0.99");
    EXPECT_EQ(probability_in_words({.probability = 1}), "right with a probability above 0.99");
}

TEST(Confidence, NeedsAMarginAndAMapThatIsGood) {
    const Candidate best{.dirichlet = 1, .relief = .9, .score = -30},
        rival{.dirichlet = 1.2, .relief = .7, .score = -24, .moved_mass = .8};
    const Confidence sure = confidence_of({best, rival});
    EXPECT_TRUE(sure.confident);
    EXPECT_NEAR(sure.margin, 6, 1e-12);
    EXPECT_GT(sure.probability, .95);
    EXPECT_EQ(doubt({best, rival}), "");
    Candidate close = rival;
    close.score = -29;
    EXPECT_LT(confidence_of({best, close}).probability, sure.probability);
    EXPECT_THAT(doubt({best, close}), testing::HasSubstr("another is 37% as probable"));
    Candidate turned = rival;
    turned.turned_about_axis = true;  // both look nearly the same
    EXPECT_LT(confidence_of({best, turned}).probability, sure.probability - .01);
    turned.score = -27;  // scores say half as much
    EXPECT_THAT(doubt({best, turned}), testing::HasSubstr("another is 22% as probable"));
    Candidate farther = rival;
    farther.score = -27.6;
    EXPECT_TRUE(confidence_of({best, farther}).confident);
    EXPECT_FALSE(confidence_of({best, farther, farther}).confident);
    EXPECT_THAT(doubt({best, farther, farther}), testing::HasSubstr("others together are 18% as probable"));
    close.moved_mass = .03;  // the same map, but for an ear
    EXPECT_EQ(confidence_of({best, close}).margin, 10);
    close.moved_mass = .8;
    close.reversed_mass = .9;  // a mirrored map is no rival
    EXPECT_EQ(confidence_of({best, close}).margin, 10);
    Candidate strained = best;
    strained.dirichlet = 3;
    strained.relief = .4;
    EXPECT_FALSE(confidence_of({strained, rival}).confident);
    EXPECT_THAT(doubt({strained, rival}), testing::HasSubstr("strained"));
    Candidate partly = best;
    partly.reversed_mass = .17;  // a limb
    EXPECT_FALSE(confidence_of({partly, rival}).confident);
    EXPECT_THAT(doubt({partly, rival}), testing::HasSubstr("17% of its sketch is mirrored"));
    partly.reversed_mass = .04;  // a foot, which the final map still puts right
    EXPECT_TRUE(confidence_of({partly, rival}).confident);
    Candidate left = best;
    left.mirror_gain = .3;  // by how much bodies' scores differ that are their own mirror images
    EXPECT_TRUE(confidence_of({left}).confident);
    left.mirror_gain = 1.4;
    EXPECT_LT(confidence_of({left}).probability, .1);
    EXPECT_THAT(doubt({left}), testing::HasSubstr("fit better as mirror images"));
    Candidate mirrored = best;
    mirrored.reversed_mass = 1;
    EXPECT_EQ(confidence_of({mirrored}).probability, 0);
}

TEST(Confidence, SaysWhichCueDecided) {
    const Candidate best{.relief = .7, .alignment = .9, .stretch = .1, .score = -24.5},
        rival{.relief = .8, .alignment = .7, .stretch = .1, .score = -21.5, .moved_mass = .9};
    EXPECT_EQ(decided_by({best, rival}), "alignment, against relief");
    Candidate nearer = best;  // the best rival counts, not the first in the list
    nearer.moved_mass = .5;
    nearer.stretch = .12;
    nearer.score = -22.1;
    EXPECT_EQ(decided_by({best, rival, nearer}), "stretch");
    nearer.moved_mass = .01;  // the same map
    EXPECT_EQ(decided_by({best, nearer}), "");
    Candidate alike = best;
    alike.moved_mass = .9;
    EXPECT_EQ(decided_by({best, alike}), "no cue by much");
}

/// A bar, flat above and below.
SurfaceData bar(const Eigen::Matrix3d& moved = Eigen::Matrix3d::Identity()) {
    TriangleMesh mesh = shapes::ellipsoid(3, {1, .5, .2});
    mesh.vertices *= moved.transpose();
    return shapes::surface_data(shapes::unit_surface(mesh), 40);
}

/// Vertices of the mesh nearest to its vertices, moved.
PointMap nearest_points(const TriangleMesh& mesh, const Eigen::Matrix3d& moved) {
    const PointMap at = points_at_vertices(mesh);
    PointMap map;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        map.push_back(at[std::size_t(shapes::nearest_vertex(mesh, moved * mesh.vertex(v)))]);
    return map;
}

TEST(ShapeAgreement, SeesWhichPlacesAreAlike) {
    const SurfaceData data = bar();
    const PairContext context(data, data, {});
    const Appraisal appraisal(context);
    const auto turned = [&](double degrees) -> MapPair {
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(degrees * M_PI / 180, Vec3::UnitX()).toRotationMatrix();
        return {nearest_points(data.surface.mesh, turn), nearest_points(data.surface.mesh, turn.transpose())};
    };
    EXPECT_NEAR(appraisal.cues(turned(0)).alignment, 1, 1e-9);
    EXPECT_NEAR(appraisal.cues(turned(0)).stretch, 0, 1e-9);
    EXPECT_GT(appraisal.cues(turned(180)).alignment, .95);  // like places on like ones
    EXPECT_LT(appraisal.cues(turned(180)).stretch, .02);
    EXPECT_LT(appraisal.cues(turned(90)).alignment, .9);  // flat places on bent ones
    EXPECT_GT(appraisal.cues(turned(90)).stretch, .05);
}

TEST(ShapeAgreement, KnowsSurfacesOfOppositeHandedness) {
    const PairContext context(bar(), bar(Eigen::DiagonalMatrix<double, 3>(-1, 1, 1)), {});
    const PointMap same = points_at_vertices(context.A().surface.mesh);
    const Appraisal appraisal(context);
    EXPECT_NEAR(appraisal.cues({same, same}).alignment, 1, 1e-9);
    EXPECT_NEAR(appraisal.cues({same, same}).relief, 1, 1e-9);
}

TEST(ShapeAgreement, LearnsNothingFromReliefWhereThereIsNone) {
    const SurfaceData flat = shapes::surface_data(shapes::unit_surface(shapes::square(20)), 20);
    const PairContext context(flat, flat, {});
    const PointMap same = points_at_vertices(flat.surface.mesh);
    PointMap other = same;
    std::reverse(other.begin(), other.end());
    const Appraisal appraisal(context);
    EXPECT_EQ(appraisal.cues({same, same}).relief, appraisal.cues({other, other}).relief);
    EXPECT_GT(plausibility({.relief = appraisal.cues({same, same}).relief}), .95);
}

TEST(Confidence, FallsWithTheStrainOfTheFinishedMap) {
    const std::vector<Candidate> candidates{{.dirichlet = 1, .relief = .9, .score = -30}};
    const double found = confidence_of(candidates).probability;
    double last = found;
    for (const double dirichlet : {1.05, 1.15, 1.25, 1.35, 2.}) {
        const double probability = confidence_of(candidates, FinishedQuality{dirichlet, 1}).probability;
        EXPECT_LT(probability, last);
        last = probability;
    }
    EXPECT_TRUE(confidence_of(candidates, FinishedQuality{1.15, 1}).confident);
    EXPECT_EQ(doubt(candidates, FinishedQuality{1.15, .94}), "");
    EXPECT_FALSE(confidence_of(candidates, FinishedQuality{1.35, 1}).confident);
    EXPECT_THAT(doubt(candidates, FinishedQuality{1.35, 1}),
                testing::HasSubstr("a Dirichlet energy of 1.35"));
    EXPECT_NEAR(confidence_of(candidates, FinishedQuality{.99, 1}).probability, found, 1e-3);
    const FinishedQuality of_a_skull{.dirichlet = 2.5, .many_handles = true};
    EXPECT_NEAR(confidence_of(candidates, of_a_skull).probability, found, 1e-3);
    EXPECT_EQ(doubt(candidates, of_a_skull), "");
}

TEST(Confidence, FallsWithATwistOfTheFinishedMap) {
    const std::vector<Candidate> candidates{{.dirichlet = 1, .relief = .9, .score = -30}};
    EXPECT_TRUE(confidence_of(candidates, FinishedQuality{.twist = 87}).confident);
    EXPECT_FALSE(confidence_of(candidates, FinishedQuality{.twist = 309}).confident);
    EXPECT_EQ(doubt(candidates, FinishedQuality{.twist = 309}), "finished, it twists a part by 309 degrees");
}

TEST(Confidence, FallsWithWhatTheFinishedMapLeavesOut) {
    const std::vector<Candidate> candidates{{.dirichlet = 1, .relief = .9, .score = -30}};
    const Confidence whole = confidence_of(candidates, FinishedQuality{1, 1});
    const FinishedQuality inside_out{.inside_out = true};
    EXPECT_NEAR(confidence_of(candidates, inside_out).probability, whole.probability / 2, 1e-9);
    EXPECT_THAT(doubt(candidates, inside_out), testing::HasSubstr("inside out"));
    EXPECT_NEAR(confidence_of(candidates, FinishedQuality{1, .96}).probability, whole.probability, .01);
    EXPECT_FALSE(confidence_of(candidates, FinishedQuality{1, .89}).confident);
    EXPECT_LT(confidence_of(candidates, FinishedQuality{1, .81}).probability, .1);
    EXPECT_THAT(doubt(candidates, FinishedQuality{1, .81}),
                testing::HasSubstr("leaves out 19% of a surface"));
}

}  // namespace
}  // namespace varimap
