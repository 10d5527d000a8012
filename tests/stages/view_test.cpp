#include <gmock/gmock.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "stages/view/packed_arrays.h"
#include "stages/view/page.h"
#include "stages/view/thinning.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

using ::testing::HasSubstr;

PageContent content_of(const TriangleMesh& mesh) {
    PageContent content;
    content.map = {"folder/a</script>.off",  "b.off", mesh, mesh, shapes::at_vertices(mesh),
                   shapes::at_vertices(mesh)};
    return content;
}

nlohmann::json data_of(const std::string& page) {
    const std::string begin = "id=\"data\">";
    const std::size_t at = page.find(begin) + begin.size();
    return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST(View, Base64IsThatOfTheStandard) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(View, ArraysStartWhereTheirDescriptionSays) {
    PackedArrays arrays;
    EXPECT_EQ(arrays.add(std::vector<std::uint8_t>{1, 2, 3}, "Uint8Array").at, 0u);
    const auto second = arrays.add(std::vector<std::int32_t>{7, 8}, "Int32Array");
    EXPECT_EQ(second.at, 4u);
    EXPECT_EQ(second.count, 2u);
}

TEST(View, PageHoldsBothMeshesAndEndsNoElementEarly) {
    const TriangleMesh mesh = shapes::ellipsoid(2, {1, 2, 3});
    PageContent content = content_of(mesh);
    content.landmarks = {{{{3, {1, 0, 0}}, {3, {1, 0, 0}}}}, {"tip"}};
    content.report = R"({"verdict": "good"})";
    const std::string page = viewer_page(content, "before<!--varimap-data-->after");
    EXPECT_TRUE(page.starts_with("before<script"));
    EXPECT_TRUE(page.ends_with("</script>after"));
    const auto data = data_of(page);
    EXPECT_EQ(data["source"]["file"], "folder/a</script>.off");
    EXPECT_EQ(data["target"]["vertices"], mesh.vertex_count());
    EXPECT_EQ(data["source"]["position"]["count"], 3 * mesh.vertex_count());
    EXPECT_EQ(data["source"]["distortion"]["area"]["count"], mesh.face_count());
    EXPECT_EQ(data["landmarks"][0]["name"], "tip");
    EXPECT_EQ(data["report"]["verdict"], "good");
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(data["turn"][i][k].get<double>(), i == k, 1e-9);
}

TEST(View, TurnsTheTargetAsTheSourceStands) {
    const TriangleMesh mesh = shapes::ellipsoid(2, {1, 2, 3});
    PageContent content = content_of(mesh);
    content.map.to = shapes::moved(mesh, 2, .7, {5, 6, 7});
    const auto turn = data_of(viewer_page(content, "<!--varimap-data-->"))["turn"];
    Eigen::Matrix3d R;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) R(i, k) = turn[i][k].get<double>();
    const Vec3 edge = content.map.to.vertex(9) - content.map.to.vertex(4);
    EXPECT_LT((R * edge / 2 - (mesh.vertex(9) - mesh.vertex(4))).norm(), 1e-9);
}

TEST(View, ThinsLargeSurfacesForTheEye) {
    const TriangleMesh fine = shapes::ellipsoid(4, {1, 2, 3});
    PageContent content = content_of(fine);
    const Correspondence shown = thinned(content.map, 500);
    EXPECT_EQ(shown.from.vertex_count(), 500);
    EXPECT_EQ(int(shown.there.size()), 500);
    for (int v = 0; v < 500; ++v)  // both are thinned alike, so the identity stays
        EXPECT_LT((position(shown.to, shown.there[std::size_t(v)]) - shown.from.vertex(v)).norm(), 1e-9);
    const Correspondence same = thinned(content.map, fine.vertex_count());
    EXPECT_EQ(same.from.faces, fine.faces);
}

TEST(View, LeavesOutVerticesThatNoFaceUsesWhenItThins) {
    TriangleMesh fine = shapes::ellipsoid(3);
    Points with_spare(fine.vertex_count() + 1, 3);
    with_spare << Eigen::RowVector3d(9, 9, 9), fine.vertices;
    fine.vertices = with_spare;
    fine.faces.array() += 1;
    PageContent content = content_of(fine);
    const Correspondence shown = thinned(content.map, 100);
    EXPECT_EQ(shown.to.vertex_count(), 100);
    EXPECT_LT(shown.to.vertices.rowwise().norm().maxCoeff(), 1.1);
}

TEST(View, RefusesAFrameWithoutAPlace) {
    EXPECT_THROW(viewer_page(content_of(shapes::ellipsoid(1)), "nothing"), InputError);
}

}  // namespace
}  // namespace varimap
