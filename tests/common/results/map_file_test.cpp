#include "varimap/results/map_file.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <functional>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "varimap/artifact/artifact.h"
#include "varimap/artifact/npy.h"
#include "varimap/core/error.h"
#include "varimap/mesh/topology.h"
#include "varimap/results/map_arrays.h"
#include "varimap/results/map_table.h"

namespace varimap {
namespace {

using ::testing::HasSubstr;

class MapFile : public ::testing::Test {
  protected:
    const TriangleMesh mesh_ = shapes::ellipsoid(1, Vec3(1, .8, .5));  // 42 vertices
    std::string path_ =
        ::testing::TempDir() + "/map_file_" + ::testing::UnitTest::GetInstance()->current_test_info()->name();
    void TearDown() override { std::filesystem::remove(path_); }

    PointMap read(const std::string& bytes, IndexBase base = IndexBase::automatic) {
        write_file_atomically(path_, bytes);
        return read_map_file(path_, base, mesh_, &mesh_);
    }
    void expect_identity(const PointMap& map) const {
        ASSERT_EQ(int(map.size()), mesh_.vertex_count());
        for (int v = 0; v < mesh_.vertex_count(); ++v) EXPECT_EQ(vertex_of(mesh_, map[std::size_t(v)]), v);
    }
    void expect_refused(const std::string& bytes, const std::string& why,
                        IndexBase base = IndexBase::automatic) {
        try {
            read(bytes, base);
            ADD_FAILURE() << "accepted";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(path_));
            EXPECT_THAT(error.what(), HasSubstr(why));
        }
    }
    /// A line for every vertex.
    std::string lines(const std::function<std::string(int)>& line) const {
        std::string text;
        for (int v = 0; v < mesh_.vertex_count(); ++v) text += line(v) + "\n";
        return text;
    }
    std::vector<int> identity(int first) const {
        std::vector<int> list;
        for (int v = 0; v < mesh_.vertex_count(); ++v) list.push_back(v + first);
        return list;
    }
};

TEST_F(MapFile, ListsOfVerticesWithEitherBase) {
    for (const int first : {0, 1}) {
        const auto number = [&](int v) { return std::to_string(v + first); };
        expect_identity(read(lines(number)));
        expect_identity(read(lines(number), first == 0 ? IndexBase::zero : IndexBase::one));
        expect_identity(read("target\n" + lines([&](int v) { return number(v) + ".000e+00"; })));
        expect_identity(
            read("vertex,target\r\n" + lines([&](int v) { return number(v) + "," + number(v) + "\r"; })));
    }
}

TEST_F(MapFile, TheSmootherReadingCountsWhereNoNumberTells) {
    for (const int first : {0, 1}) {
        const int last = mesh_.vertex_count() - 1;
        const PointMap map = read(lines([&](int v) {
            return std::to_string((v == 0 ? 1 : v == last ? last - 1 : v) + first);
        }));
        EXPECT_EQ(vertex_of(mesh_, map[7]), 7);
        EXPECT_EQ(vertex_of(mesh_, map[30]), 30);
    }
}

TEST_F(MapFile, VerticesWithoutAnImage) {
    const PointMap map = read(lines([](int v) {
        return v == 5 ? "nan" : v == 6 ? "-1" : std::to_string(v);
    }));
    EXPECT_EQ(map[5].face, -1);
    EXPECT_EQ(map[6].face, -1);
    EXPECT_EQ(vertex_of(mesh_, map[7]), 7);
}

TEST_F(MapFile, Arrays) {
    const std::vector<long long> shape{mesh_.vertex_count()};
    expect_identity(read(to_npy("<i4", shape, identity(1))));
    expect_identity(read(to_zip({{"whatever.npy", to_npy("<i4", shape, identity(0))}})));
    expect_identity(read(to_zip({{"other.npy", ""}, {"p2p.npy", to_npy("<i4", shape, identity(0))}})));
    const PointMap map = shapes::at_vertices(mesh_);
    expect_identity(read(to_npz(map, mesh_)));
    expect_identity(read(to_csv(map)));
}

TEST_F(MapFile, IsRefusedWithAReason) {
    const auto number = [](int v) { return std::to_string(v); };
    expect_refused("1\n2\n", "2 rows, but the source mesh has 42 vertices");
    expect_refused(lines(number), ":1: vertex 0 is out of range", IndexBase::one);
    expect_refused(lines([&](int v) { return number(v == 3 ? 42 : v); }), ":4: vertex 42 is out of range");
    expect_refused(lines([&](int v) { return v == 3 ? ".5" : number(v); }), ":4: 0.5 is not a vertex number");
    expect_refused(lines([&](int v) { return v == 3 ? "x" : number(v); }),
                   ":4: expected a vertex of the target");
    expect_refused(lines([&](int v) { return number(v) + " " + number(v) + " 1"; }), ":1: expected a vertex");
    expect_refused(lines([&](int v) { return number(v == 3 ? 4 : v) + " " + number(v); }),
                   ":4: vertex 4 where vertex 3");
    expect_refused("", "0 rows");
    expect_refused(to_zip({{"a.npy", ""}, {"b.npy", ""}}), "nor p2p");
    PointMap far = shapes::at_vertices(mesh_);
    far[2].face = 80;
    expect_refused(to_csv(far), ":4: face 80, but the target mesh has 80 faces");
    far[2] = {3, Vec3(1, 1, 0)};
    expect_refused(to_npz(far, mesh_), "row 2 (from 0): barycentric coordinates");
}

}  // namespace
}  // namespace varimap
