#include "stages/preprocess/preprocess.h"
#include "varimap/core/log.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_repair/bridges.h"
#include "varimap/stage/stage_main.h"
#include "varimap/surface/part_region.h"
#include "varimap/surface/surface.h"

namespace {

using namespace varimap;

/// Errors name the file.
Surface preprocess_file(const std::string& path, RepairedMesh input, const PreprocessParams& params) {
    try {
        return preprocess(std::move(input), params);
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
}

/// What is said in words (preprocess.h) once more as numbers, where it is not 0.
void record(Stage& stage, const RepairCounts& counts, const PreprocessParams& params) {
    const auto number = [&](const char* name, double value) {
        if (value > 0) stage.record_number(name, value);
    };
    number("welded_vertices", counts.welded);
    number("not_finite_faces", counts.not_finite);
    number("degenerate_faces", counts.degenerate);
    number("duplicate_faces", counts.duplicates);
    number("turned_faces", counts.turned);
    number("cut_edges", counts.cut_edges);
    number("opened_edges", counts.opened_edges);
    number("split_vertices", counts.split_vertices);
    number("closed_slits", counts.closed_slits);
    number("filled_holes", counts.filled_holes);
    number("filling_faces", counts.filling_faces);
    number("unfilled_holes", counts.unfilled_holes);
    number("cut_handles", counts.cut_handles);
    number("asked_cuts", asked_cuts(counts, params));
    number("bridges", counts.bridges);
    number("dropped_components", counts.dropped_components);
    number("dropped_area_percent", 100 * counts.dropped_area);
    number("cavities", counts.cavities);
    number("cavity_area_percent", 100 * counts.cavity_area);
}

/// Tubes of the whole say nothing of its cut, those of the cut nothing of the file.
RepairedMesh cut_to(const PartRegion& region, RepairedMesh whole) {
    RepairedMesh cut = cropped(std::move(whole), region);
    cut.counts.bridges = 0;
    cut = bridged(std::move(cut));
    if (cut.counts.bridges > 0)
        warn("the part covers {} pieces of this surface, which thin bridges join", cut.counts.bridges + 1);
    cut.counts.bridges = 0;
    return cut;
}

}  // namespace

int main(int argc, char** argv) {
    PreprocessParams params;
    Stage stage("preprocess", "A mesh made ready for mapping: checked, unit area, evenly fine, with masses");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const std::string& in = stage.input("mesh", "OBJ, PLY, OFF or STL file");
    const std::string& out = stage.output("surface", ArtifactType<Surface>::schema, "artifact to write");
    const std::string& region =
        stage.input_option("region", "artifact of varimap-locate: the faces outside of it are left out");
    return stage.main(argc, argv, [&] {
        const TriangleMesh file = read_mesh(in);
        RepairedMesh input = prepared(file, params, in);
        stage.record_file("mesh", in);
        if (!region.empty()) input = cut_to(stage.read<PartRegion>("region", region).value, std::move(input));
        record(stage, input.counts, params);
        const Surface surface = preprocess_file(in, std::move(input), params);
        stage.record_number("input_vertices", file.vertex_count());
        stage.record_number("input_faces", file.face_count());
        const TopologySummary topology = summarise_topology(surface.input);
        stage.record_number("genus", topology.genus);
        stage.record_number("boundary_loops", topology.boundary_loops);
        stage.record_number("scale", surface.scale);
        stage.record_number("vertices", surface.mesh.vertex_count());
        stage.write(out, surface);
    });
}
