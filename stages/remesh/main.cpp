#include <array>

#include "stages/remesh/export.h"
#include "stages/remesh/quality_json.h"
#include "stages/remesh/warnings.h"
#include "varimap/core/error.h"
#include "varimap/results/diffusion.h"
#include "varimap/results/map_file.h"
#include "varimap/results/quality_numbers.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

namespace {

/// Between the files, as varimap-diffuse reads it; empty where there is none.
PointMap read_initial_map(Stage& stage, const std::string& path, IndexBase base, const Surface& A,
                          const Surface& B) {
    if (path.empty()) return {};
    const TriangleMesh source = in_numbers_of_file(A.input, A.link);
    PointMap map = read_map_file(path, base, file_of(B), &source);
    stage.record_file("initial-map", path);
    return map;
}

/// Of a plan of either kind.
SolvedPair read_pair(Stage& stage, const Header& plan, const std::string& file) {
    if (plan.kind == ArtifactType<Diffusion>::kind) return stage.read<Diffusion>("plan", file).value;
    return stage.read<Plan>("plan", file).value;
}

}  // namespace

int main(int argc, char** argv) {
    Stage stage("remesh", "Tables of the map, cross-remeshed surfaces and quality numbers");
    bool ascii = false;
    IndexBase map_base = IndexBase::automatic;
    stage.parameters([&](ParameterList& list) {
        list.add("ascii_ply", ascii, "surfaces as PLY that is text, for programs that read no other");
        list.add("map_base", map_base, "number of the first vertex in --initial-map: 0, 1, or auto");
    });
    const std::string& surface_A =
        stage.input("A.surface", "artifact of varimap-coarsen or varimap-preprocess: the source");
    const std::string& surface_B =
        stage.input("B.surface", "artifact of varimap-coarsen or varimap-preprocess: the target");
    const std::string& plan_file = stage.input("plan", "artifact of varimap-refine or varimap-diffuse");
    const std::string& map_file = stage.input("map", "artifact of varimap-relax");
    const std::string& out =
        stage.output("quality", ArtifactType<QualityNumbers>::schema, "artifact to write");
    const std::string& folder =
        stage.option("export",
                     "folder for source_to_target and target_to_source (.csv, .npz), source_on_target.ply, "
                     "target_on_source.ply, source_masses.csv, target_masses.csv, source_vertices.csv and "
                     "target_vertices.csv");
    const auto& meshes = stage.input_list_option(
        "meshes", "the files of source and target, whose polygons the exported surfaces keep", 2, 2);
    const std::string& initial_map_file = stage.input_option(
        "initial-map", "the map that varimap-diffuse began from, to measure how far this one is from it");
    const std::string& json_file = stage.output_option("numbers", "JSON file for the quality numbers");
    return stage.main(argc, argv, [&] {
        if (map_base != IndexBase::automatic && initial_map_file.empty())
            throw UsageError("--map_base says how --initial-map counts vertices: give that, too");
        const auto A = stage.read<Surface>("A.surface", surface_A);
        const auto B = stage.read<Surface>("B.surface", surface_B);
        const Header plan = read_header(plan_file);
        const SolvedPair pair = read_pair(stage, plan, plan_file);
        const auto map = stage.read<SurfaceMap>("map", map_file);
        Stage::require_lineage(map.header, map_file, "A.surface", A.header, surface_A);
        Stage::require_lineage(map.header, map_file, "B.surface", B.header, surface_B);
        Stage::require_lineage(map.header, map_file, "plan", plan, plan_file);
        require_surfaces(pair, A.value, B.value);
        require_surfaces(map.value, A.value, B.value);
        std::array<PolygonSoup, 2> polygons;
        if (!meshes.empty()) {
            polygons = {read_polygons_of(A.value, surface_A, meshes[0]),
                        read_polygons_of(B.value, surface_B, meshes[1])};
            stage.record_file("meshes.A", meshes[0]);
            stage.record_file("meshes.B", meshes[1]);
        }
        const PointMap initial_map = read_initial_map(stage, initial_map_file, map_base, A.value, B.value);
        const MapQuality quality = measure_quality(map.value, A.value, B.value, pair, initial_map);
        warn_of(quality, pair.record);
        const QualityNumbers numbers{quality_json(quality, map.value, A.value, B.value, pair)};
        if (!folder.empty())
            export_map(stage, folder, map.value, pair.plan, A.value, B.value, polygons,
                       ascii ? PlyFormat::ascii : PlyFormat::binary);
        if (!json_file.empty()) stage.write_file(json_file, numbers.json + "\n");
        stage.write(out, numbers);  // last, so that it tells that the rest is there
    });
}
