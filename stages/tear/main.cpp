#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "stages/tear/tear.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/results/map_table.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

namespace {

TriangleMesh read_plain(const std::string& path) {
    TriangleMesh mesh = read_mesh(path);
    require_manifold(mesh, path);
    return mesh;
}

void require_whole(const PointMap& map, const TriangleMesh& from, const TriangleMesh& to,
                   const std::string& path) {
    if (!is_map_between(map, from, to))
        throw InputError(path + ": is no map between these meshes; give the tables of their own varimap map");
    for (const SurfacePoint& image : map)
        if (image.face < 0)
            throw InputError(path + ": a vertex has no image; varimap-tear judges whole maps");
}

}  // namespace

int main(int argc, char** argv) {
    TearOptions options;
    Stage stage("tear", "Where a map tears, and what it is like elsewhere (Fig. 17)");
    stage.parameters([&](ParameterList& list) {
        list.add("stretch", options.stretch, "an edge is torn where it becomes so many times as long", 1.0,
                 1e6);
        list.add("distance", options.distance, "elsewhere is farther from there; units of sqrt(area)", 0.0,
                 10.0);
    });
    const auto& source_path = stage.input("source-mesh", "mesh the map starts from");
    const auto& target_path = stage.input("target-mesh", "mesh the map leads to");
    const auto& there_path = stage.input("source-to-target", "CSV of varimap-remesh");
    const auto& back_path = stage.input("target-to-source", "CSV of varimap-remesh");
    return stage.main(argc, argv, [&] {
        const TriangleMesh source = read_plain(source_path), target = read_plain(target_path);
        const PointMap there = read_csv_map(there_path), back = read_csv_map(back_path);
        require_whole(there, source, target, there_path);
        require_whole(back, target, source, back_path);
        const TearReport report = find_tear(source, target, there, back, options);
        const nlohmann::ordered_json json{{"torn_edges", report.torn_edges},
                                          {"torn_area_percent", report.torn_area_percent},
                                          {"near_area_percent", report.near_area_percent},
                                          {"reversed_elsewhere", report.reversed_elsewhere},
                                          {"largest_stretch_elsewhere", report.largest_stretch},
                                          {"returned_percent", report.returned_percent}};
        fmt::print("{}\n", json.dump(1));
    });
}
