#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fixtures/temporary_folder.h"
#include "stages/view/packed_arrays.h"
#include "stages/view/page.h"
#include "stages/view/thinning.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/mesh/closest_point.h"

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

TEST(View, NamesBeginNoElementOfThePage) {
    PageContent content = content_of(shapes::ellipsoid(1));
    content.map.to_file = "<!--<script>.off";
    const std::string page = viewer_page(content, "<!--varimap-data-->");
    EXPECT_EQ(page.find("<!--"), page.npos);
    EXPECT_EQ(data_of(page)["target"]["file"], "<!--<script>.off");
}

TEST(View, TurnsTheTargetAsTheSourceStands) {
    for (const double far : {1., 1e6}) {
        const TriangleMesh mesh = shapes::moved(shapes::ellipsoid(2, {1, 2, 3}), 1, 0, {far, 0, far});
        PageContent content = content_of(mesh);
        content.map.to = shapes::moved(mesh, 2, .7, far * Vec3(5, 6, 7));
        const auto turn = data_of(viewer_page(content, "<!--varimap-data-->"))["turn"];
        Eigen::Matrix3d R;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) R(i, k) = turn[i][k].get<double>();
        const Vec3 edge = content.map.to.vertex(9) - content.map.to.vertex(4);
        EXPECT_LT((R * edge / 2 - (mesh.vertex(9) - mesh.vertex(4))).norm(), 1e-9 + 1e-12 * far) << far;
    }
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

TEST(View, PageHoldsWhatEveryLayerShows) {
    const TriangleMesh mesh = shapes::ellipsoid(2, {1, 2, 3});
    PageContent content = content_of(mesh);
    content.candidates = {{"the best", shapes::at_vertices(mesh)}, {"mirrored", shapes::at_vertices(mesh)}};
    const auto data = data_of(viewer_page(content, "<!--varimap-data-->"));
    EXPECT_EQ(data["source"]["way_back"]["count"], mesh.vertex_count());
    EXPECT_EQ(data["source"]["branches"]["count"], 0);
    ASSERT_EQ(data["candidates"].size(), 2u);
    EXPECT_EQ(data["candidates"][1]["relation"], "mirrored");
    EXPECT_EQ(data["candidates"][1]["map"]["face"]["count"], mesh.vertex_count());
    EXPECT_EQ(data["pattern"].size(), 3u);
    EXPECT_FALSE(data.contains("texture"));
}

class ViewTexture : public ::testing::Test {
  protected:
    const TemporaryFolder folder_;
    /// A strip of squares along x, u running along it from 0 to 1 twice: a seam in its middle.
    TriangleMesh strip_ = shapes::square(8);
    std::string write_obj(const std::string& texture) {
        std::string obj = "mtllib a.mtl\nusemtl skin\n", faces;
        for (int v = 0; v < strip_.vertex_count(); ++v)
            obj += fmt::format("v {} {} {}\n", strip_.vertices(v, 0), strip_.vertices(v, 1),
                               strip_.vertices(v, 2));
        int count = 0;
        for (int f = 0; f < strip_.face_count(); ++f) {
            const bool second = position(strip_, {f, Vec3::Constant(1 / 3.)})[0] > .5;
            faces += "f";
            for (int k = 0; k < 3; ++k) {
                const Vec3 p = strip_.vertex(strip_.faces(f, k));
                obj += fmt::format("vt {} {}\n", p[0] - (second ? .5 : 0), p[1]);
                faces += fmt::format(" {}/{}", strip_.faces(f, k) + 1, ++count);
            }
            faces += "\n";
        }
        write_file_atomically(folder_ / "a.obj", obj + faces);
        write_file_atomically(folder_ / "a.mtl", "newmtl skin\nmap_Kd a.png\n");
        write_file_atomically(folder_ / "a.png", texture);
        return folder_ / "a.obj";
    }
};

TEST_F(ViewTexture, GoesOnBeyondSeamsInsteadOfSmearing) {
    const std::string obj = write_obj("\x89PNG and so on");
    TriangleMesh shifted = strip_;  // the target's triangles lie across the seam
    PointMap there, back;
    const ClosestPoint closest(strip_);
    for (int v = 0; v < strip_.vertex_count(); ++v) {
        Vec3 p = strip_.vertex(v);
        p[0] = .1 + .85 * p[0];
        shifted.vertices.row(v) = p;
        back.push_back(closest(p).point);
    }
    const ClosestPoint closest_shifted(shifted);
    for (int v = 0; v < strip_.vertex_count(); ++v) there.push_back(closest_shifted(strip_.vertex(v)).point);
    const auto texture = read_texture(obj, {obj, "b.off", strip_, shifted, there, back});
    ASSERT_TRUE(texture);
    EXPECT_EQ(texture->type, "image/png");
    ASSERT_EQ(texture->target_uv.size(), 6u * std::size_t(shifted.face_count()));
    int across = 0;
    for (int f = 0; f < shifted.face_count(); ++f) {
        double low = 1e9, high = -1e9, left = 1e9, right = -1e9;
        for (int k = 0; k < 3; ++k) {
            const double u = texture->target_uv[6 * std::size_t(f) + 2 * std::size_t(k)];
            const double x = shifted.vertices(shifted.faces(f, k), 0);
            low = std::min(low, u), high = std::max(high, u), left = std::min(left, x),
            right = std::max(right, x);
        }
        across += left < .5 && right > .5;
        EXPECT_NEAR(high - low, right - left, 1e-5) << f;
    }
    EXPECT_GE(across, 8);
}

TEST_F(ViewTexture, IsRefusedWhereItCannotBeShown) {
    const std::string obj = write_obj("GIF89a");
    const PointMap map = shapes::at_vertices(strip_);
    EXPECT_THROW(read_texture(obj, {obj, "b.off", strip_, strip_, map, map}), InputError);
    write_obj("\x89PNG");
    const TriangleMesh other = shapes::square(4);
    EXPECT_THROW(read_texture(obj, {"c.obj", "b.off", other, strip_, map, map}), InputError);
}

}  // namespace
}  // namespace varimap
