#include "stages/generate/generate.h"

#include <gmock/gmock.h>

#include <set>

#include "stages/generate/families.h"
#include "stages/generate/partner.h"
#include "varimap/core/error.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_files/mesh_file.h"

namespace varimap {
namespace {

using shapes::Body;
using ::testing::HasSubstr;

GenerateParams small_meshes() {
    GenerateParams params;
    params.vertices = 1000;
    return params;
}

GenerateParams all_variety() {
    GenerateParams params = small_meshes();
    params.variation = 1.2;
    params.asymmetry = 1;
    params.missing = 0.5;
    params.relief = 0.01;
    return params;
}

std::vector<std::pair<int, int>> pairs_of(const GeneratedPair& pair) {
    std::vector<std::pair<int, int>> rows;
    for (const auto& row : pair.truth) rows.emplace_back(row.source, row.target);
    return rows;
}

void expect_sphere(const TriangleMesh& mesh) {
    EXPECT_NO_THROW(require_manifold(mesh, "generated"));
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_EQ(summarise_topology(mesh).genus, 0);
    EXPECT_EQ(summarise_topology(mesh).used_vertices, mesh.vertex_count());
    EXPECT_THAT(connected_components(mesh).of_vertex, ::testing::Each(0));
    EXPECT_GT(signed_volume(mesh), 0);
    EXPECT_EQ(mesh.vertex_count(), 1000);
}

void expect_truth(const GeneratedPair& pair) {
    EXPECT_GE(pair.truth.size(), 30u);
    const double area = surface_area(pair.target);
    for (const auto& row : pair.truth) {
        EXPECT_LT(row.source, pair.source.vertex_count());
        EXPECT_LT(row.target, pair.target.vertex_count());
        EXPECT_LT(row.squared_distance, 1e-3 * area);
    }
}

/// A member of that family and the vertices of its surface at rest.
struct Member {
    Member(int family, unsigned seed, const GenerateParams& params)
        : Member(family, shapes::Random(seed), params) {}
    Body body;
    TriangleMesh rest;

  private:
    Member(int family, shapes::Random random, const GenerateParams& params)
        : body(shapes::family_member(family, params, random)), rest(body.mesh(1000, random.rotation())) {}
};

int family_count() {
    return int(shapes::family_names().size());
}

TEST(Generate, FamiliesAreClosedSurfacesOfGenusZeroHoweverTheyVary) {
    for (const std::string& family : shapes::family_names())
        for (const GenerateParams& params : {small_meshes(), all_variety()}) {
            SCOPED_TRACE(family);
            const GeneratedPair pair = generate(family, 3, params);
            expect_sphere(pair.source);
            expect_sphere(pair.target);
            expect_truth(pair);
        }
}

TEST(Generate, TheSeedDecidesAll) {
    for (const char* family : {"isometric", "tool", "assembly"}) {
        SCOPED_TRACE(family);
        const GeneratedPair pair = generate(family, 8, small_meshes()),
                            again = generate(family, 8, small_meshes());
        EXPECT_EQ(to_ply(pair.source), to_ply(again.source));
        EXPECT_EQ(to_ply(pair.target), to_ply(again.target));
        EXPECT_EQ(pairs_of(pair), pairs_of(again));
        EXPECT_NE(to_ply(generate(family, 9, small_meshes()).source), to_ply(pair.source));
    }
}

TEST(Generate, AnyDrawsAFamilyAndHowItVaries) {
    GenerateParams params;
    params.vertices = small_meshes().vertices;
    std::set<std::string> kinds;
    for (unsigned seed = 3; seed < 7; ++seed) {
        const GeneratedPair pair = generate("any", seed, params);
        kinds.insert(pair.kind);
        expect_sphere(pair.source);
        expect_sphere(pair.target);
    }
    EXPECT_GE(kinds.size(), 3u);
    EXPECT_EQ(kinds.count("any"), 0u);
}

/// Chairs without and with arms, a table, a car, a robot.
TEST(Generate, AssembliesAreOfPartsThatArePartners) {
    const int parts[] = {6, 10, 7, 8, 8};
    for (unsigned seed = 0; seed < 5; ++seed) {
        const GeneratedPair pair = generate("assembly", seed, small_meshes());
        SCOPED_TRACE(pair.kind);
        expect_truth(pair);
        const std::vector<int> source = connected_components(pair.source).of_vertex,
                               target = connected_components(pair.target).of_vertex;
        for (const TriangleMesh* mesh : {&pair.source, &pair.target}) {
            EXPECT_NO_THROW(require_sheets(*mesh, "generated"));
            EXPECT_TRUE(is_closed(*mesh));
            EXPECT_GT(signed_volume(*mesh), 0);
            EXPECT_NEAR(mesh->vertex_count(), 1000, 350);
        }
        EXPECT_EQ(std::set<int>(source.begin(), source.end()).size(), std::size_t(parts[seed]));
        std::set<std::pair<int, int>> partners;
        for (const auto& [v, w] : pairs_of(pair))
            partners.emplace(source[std::size_t(v)], target[std::size_t(w)]);
        EXPECT_EQ(partners.size(), std::size_t(parts[seed])) << "each part has one partner";
        std::set<int> reached;
        for (const auto& [part, partner] : partners) reached.insert(partner);
        EXPECT_EQ(reached.size(), partners.size()) << "and no two have the same";
    }
}

TEST(Generate, StoutQuadrupedsHaveMoreVolumeForTheirArea) {
    const auto compactness = [](const TriangleMesh& mesh) {
        return signed_volume(mesh) / std::pow(surface_area(mesh), 1.5);
    };
    GenerateParams slender = small_meshes(), stout = small_meshes();
    stout.build = 1.2;
    double least = 1, most = 0, usual = 0;
    for (const unsigned seed : {1u, 2u, 3u}) {
        const GeneratedPair pair = generate("quadruped", seed, stout);
        expect_sphere(pair.source);
        expect_truth(pair);
        most = std::max({most, compactness(pair.source), compactness(pair.target)});
        least = std::min({least, compactness(pair.source), compactness(pair.target)});
        usual = std::max(usual, compactness(generate("quadruped", seed, slender).source));
    }
    EXPECT_GT(most, 1.2 * usual);
    EXPECT_GT(most, 1.3 * least);
}

/// Without variation and relief two members are the same shape at rest, and unbent the same one.
TEST(Generate, MembersOfNoVariationAreCongruentUpToTheirPlace) {
    GenerateParams params = small_meshes();
    params.variation = params.bending = params.relief = 0;
    for (const std::string& family : shapes::family_names()) {
        SCOPED_TRACE(family);
        const GeneratedPair pair = generate(family, 1, params);
        const double scale = std::sqrt(surface_area(pair.target) / surface_area(pair.source));
        const auto& rows = pair.truth;
        for (std::size_t i = 1; i < rows.size(); ++i) {
            const double there =
                (pair.source.vertex(rows[i].source) - pair.source.vertex(rows[0].source)).norm();
            const double here =
                (pair.target.vertex(rows[i].target) - pair.target.vertex(rows[0].target)).norm();
            EXPECT_NEAR(here / scale, there, 0.1);
        }
    }
}

TEST(Partner, OfAMemberWithItselfIsThePointItself) {
    for (int family = 0; family < family_count(); ++family) {
        SCOPED_TRACE(family);
        const Member a(family, 5, small_meshes());
        const shapes::Partner partner(a.body, a.body);
        int found = 0;
        for (int v = 0; v < a.rest.vertex_count(); ++v)
            if (const auto image = partner(a.rest.vertex(v))) {
                ++found;
                EXPECT_LT((*image - a.rest.vertex(v)).norm(), 1e-6);
            }
        EXPECT_GT(found, a.rest.vertex_count() / 8);
    }
}

TEST(Partner, ThereAndBackReturns) {
    for (int family = 0; family < family_count(); ++family) {
        SCOPED_TRACE(family);
        const Member a(family, 5, small_meshes()), b(family, 6, small_meshes());
        const shapes::Partner there(a.body, b.body), back(b.body, a.body);
        int found = 0;
        for (int v = 0; v < a.rest.vertex_count(); ++v) {
            const auto image = there(a.rest.vertex(v));
            if (!image) continue;
            const auto returned = back(*image);
            ASSERT_TRUE(returned);
            EXPECT_LT((*returned - a.rest.vertex(v)).norm(), 1e-6);
            ++found;
        }
        EXPECT_GT(found, a.rest.vertex_count() / 10);
    }
}

TEST(Partner, IsNoneOnAMissingPart) {
    constexpr int quadruped = 1;
    const Member whole(quadruped, 5, small_meshes());
    Body docked = whole.body;
    shapes::Limb& tail = docked.parts.back().limbs.front();
    tail.missing = true;
    const shapes::Partner onto_docked(whole.body, docked), onto_whole(docked, whole.body);
    int on_tail = 0;
    for (int v = 0; v < whole.rest.vertex_count(); ++v) {
        const Vec3 p = whole.rest.vertex(v);
        if (whole.body.parts.back().limbs.front().distance(p) > 0.02) continue;
        ++on_tail;
        EXPECT_FALSE(onto_docked(p));
    }
    EXPECT_GT(on_tail, 10);
    const TriangleMesh rest = docked.mesh(1000, Eigen::Matrix3d::Identity());
    for (int v = 0; v < rest.vertex_count(); ++v) {
        const auto image = onto_whole(rest.vertex(v));
        EXPECT_TRUE(!image || whole.body.parts.back().limbs.front().distance(*image) > 0.05);
    }
}

std::string refusal(const std::string& family, const GenerateParams& params) {
    try {
        generate(family, 1, params);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "none";
}

TEST(Generate, HandlesAreThereAtEverySizeAndContactGrowsTogether) {
    GenerateParams params;
    params.vertices = 3000;
    for (const double size : {0.0, 0.1, 0.6, 1.0}) {
        params.variation = size;
        const GeneratedPair pair = generate("handle", 1, params);
        EXPECT_TRUE(is_closed(pair.source));
        EXPECT_TRUE(is_closed(pair.target));
        EXPECT_EQ(summarise_topology(pair.source).genus, 0);
        EXPECT_EQ(summarise_topology(pair.target).genus, 1) << size;
        EXPECT_GT(pair.truth.size(), 200u);
    }
    const GeneratedPair contact = generate("contact", 1, params);
    EXPECT_TRUE(is_closed(contact.target));
    const auto per_size = [](const TriangleMesh& mesh) {  // what has grown together has less surface
        return surface_area(mesh) / std::pow(std::abs(signed_volume(mesh)), 2.0 / 3);
    };
    EXPECT_LT(per_size(contact.target), .97 * per_size(contact.source));
}

/// Without variation all members are one body bent, so that neighbouring places are as far apart on all.
TEST(Generate, RowsOfACollectionAreTheSamePlaces) {
    GenerateParams params = small_meshes();
    params.members = 3;
    params.variation = params.bending = params.relief = 0;
    const GeneratedCollection collection = generate_collection("quadruped", 4, params);
    ASSERT_EQ(collection.meshes.size(), 3u);
    for (std::size_t m = 0; m < 3; ++m) expect_sphere(collection.meshes[m]);
    const auto distances = [&](std::size_t m) {
        const TriangleMesh& mesh = collection.meshes[m];
        std::vector<double> list;
        for (const int v : collection.vertices[m])
            list.push_back((mesh.vertex(v) - mesh.vertex(collection.vertices[m][0])).norm() /
                           std::sqrt(surface_area(mesh)));
        return list;
    };
    const auto first = distances(0);
    EXPECT_GE(first.size(), 50u);
    for (std::size_t m = 1; m < 3; ++m) {
        const auto other = distances(m);
        ASSERT_EQ(other.size(), first.size());
        for (std::size_t i = 0; i < first.size(); ++i) EXPECT_NEAR(other[i], first[i], .1) << "row " << i;
    }
}

TEST(Generate, SaysWhatFamiliesThereAre) {
    EXPECT_THAT(refusal("bird", {}), HasSubstr("'bird'; there are isometric, any, assembly, biped"));
    GenerateParams varied;
    varied.variation = 0.5;
    EXPECT_THAT(refusal("isometric", varied), HasSubstr("--variation"));
    EXPECT_THAT(refusal("any", varied), HasSubstr("--variation"));
    GenerateParams few;
    few.vertices = 20;
    EXPECT_THAT(refusal("hand", few), HasSubstr("--vertices 20"));
}

}  // namespace
}  // namespace varimap
