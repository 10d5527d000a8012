#include "stages/verify/verify.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fixtures/temporary_folder.h"
#include "varimap/core/error.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/results/map_table.h"

namespace varimap {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class Verify : public ::testing::Test {
  protected:
    std::string write_mesh(const std::string& name, const TriangleMesh& mesh) {
        write_file_atomically(folder_ / name, to_ply(mesh));
        return folder_ / name;
    }
    std::string write_map(const PointMap& map) {
        write_file_atomically(folder_ / "map.csv", to_csv(map));
        return folder_ / "map.csv";
    }
    /// The message of the InputError it throws.
    std::string refusal(const std::string& source, const std::string& target, const std::string& map) {
        try {
            verify_files(source, target, map);
        } catch (const InputError& error) {
            return error.what();
        }
        return "none";
    }
    TemporaryFolder folder_;
    const TriangleMesh sphere_ = shapes::ellipsoid(2);
    const PointMap identity_ = shapes::at_vertices(sphere_);
};

TEST_F(Verify, JudgesFiles) {
    const std::string mesh = write_mesh("a.ply", sphere_);
    const Verification found = verify_files(mesh, mesh, write_map(identity_));
    EXPECT_TRUE(found.reversed_faces.empty());
    EXPECT_EQ(found.degree.value(), 1);
}

TEST_F(Verify, ExpectsReversedTrianglesOfAMirror) {
    TriangleMesh left = sphere_;  // z to -z, with the outside kept outside
    left.vertices.col(2) *= -1;
    left.faces.col(1).swap(left.faces.col(2));
    PointMap map = identity_;
    for (SurfacePoint& point : map) std::swap(point.barycentric[1], point.barycentric[2]);
    const std::string right = write_mesh("a.ply", sphere_), other = write_mesh("b.ply", left);
    const Verification mirrored = verify_files(right, other, write_map(map), true);
    EXPECT_TRUE(mirrored.reversed_faces.empty());
    EXPECT_EQ(mirrored.degree.value(), 1);
    EXPECT_EQ(int(verify_files(right, other, write_map(map)).reversed_faces.size()), sphere_.face_count());
}

TEST_F(Verify, RefusesAMapOfAnotherSource) {
    const std::string a = write_mesh("a.ply", sphere_), b = write_mesh("b.ply", shapes::ellipsoid(1));
    EXPECT_THAT(refusal(b, a, write_map(identity_)),
                HasSubstr("162 rows, but the source mesh has 42 vertices"));
}

TEST_F(Verify, RefusesFacesTheTargetLacks) {
    const std::string a = write_mesh("a.ply", sphere_);
    PointMap map = identity_;
    map[7].face = sphere_.face_count();
    EXPECT_THAT(refusal(a, a, write_map(map)),
                HasSubstr("map.csv:9: face 320, but the target mesh has 320 faces"));
}

TEST_F(Verify, RefusesWhatIsNoSurface) {
    TriangleMesh nothing = sphere_;
    nothing.vertices.setConstant(std::nan(""));
    const std::string a = write_mesh("a.ply", sphere_), b = write_mesh("b.ply", nothing);
    EXPECT_THAT(refusal(a, b, write_map(identity_)), HasSubstr("b.ply"));
}

TEST_F(Verify, NamesFacesAndVerticesOfTheFile) {
    TriangleMesh file = sphere_;  // its first face is degenerate, and all numbers of faces are one more
    file.faces.resize(sphere_.face_count() + 1, 3);
    file.faces << 0, 0, 1, sphere_.faces;
    const std::string target = write_mesh("a.ply", sphere_), source = write_mesh("b.ply", file);
    PointMap map = identity_;
    map[7] = {identity_[100].face, identity_[100].barycentric};  // far away
    const auto plain = verify_files(target, target, write_map(map)).reversed_faces;
    auto shifted = plain;
    for (int& face : shifted) ++face;
    ASSERT_FALSE(plain.empty());
    EXPECT_EQ(verify_files(source, target, write_map(map)).reversed_faces, shifted);
}

TEST_F(Verify, JsonHoldsEveryNumber) {
    Verification found;
    found.reversed_faces = {3, 8};
    found.reversed_area_percent = 0.25;
    found.cutting_count = 6;
    found.branch_vertices = {5};
    found.signed_area_ratio = 0.5;
    found.degree = 2;
    found.left_out_count = 4;
    EXPECT_EQ(Json::parse(as_json(found)), Json::parse(R"({"reversed_count": 2, "reversed_area_percent": 0.25,
        "cutting_count": 6, "branch_points": 1, "signed_area_ratio": 0.5, "degree": 2.0, "left_out_count": 4,
        "reversed_faces": [3, 8], "branch_vertices": [5]})"));
    found.degree.reset();
    EXPECT_FALSE(Json::parse(as_json(found)).contains("degree"));
}

TEST_F(Verify, TextHoldsOneNumberPerLine) {
    Verification found;
    found.reversed_faces = {3, 8};
    found.signed_area_ratio = 0.98765;
    EXPECT_EQ(as_text(found),
              "reversed triangles           2\n"
              "reversed area         0.0000 %\n"
              "cutting triangles            0\n"
              "branch points                0\n"
              "signed area ratio       0.9877\n"
              "degree                    none\n");
    found.left_out_count = 7;
    EXPECT_THAT(as_text(found), HasSubstr("left out                     7\n"));
}

}  // namespace
}  // namespace varimap
