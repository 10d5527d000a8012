#include <fmt/format.h>

#include <filesystem>

#include "stages/transfer/transfer.h"
#include "varimap/artifact/file_status.h"
#include "varimap/core/error.h"
#include "varimap/map_stage/map_inputs.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;
namespace fs = std::filesystem;

struct TransferParams {
    int bake = 0;
    int padding = -1;
    int influences = 0;
    LandmarkReading reading;

    void describe(ParameterList& list) {
        list.add("bake", bake,
                 "texture: width and height, in pixels, of an image for the target's own texture "
                 "coordinates; 0: the source's coordinates, cut at seams",
                 0, 16384);
        list.add("padding", padding, "baking: pixels coloured beyond the rim of every patch; -1: 8", -1, 256);
        list.add("influences", influences, "weights: how many to keep in each row, the largest; 0: all", 0,
                 1 << 20);
        list.add("landmark_space", reading.space, "points: their axes, as their file states them or others");
        list.add("landmark_base", reading.base, "points that are vertices: number of the first; auto: 0");
    }
};

/// All files that are read.
std::vector<std::string> inputs_of(const TransferRequest& request, const MapFiles& map) {
    std::vector<std::string> inputs{map.source, map.target, map.source_to_target, map.target_to_source};
    for (const auto* list : {&request.points, &request.values, &request.labels, &request.weights,
                             &request.regions, &request.shapes})
        inputs.insert(inputs.end(), list->begin(), list->end());
    for (const auto* file : {&request.texture, &request.onto, &request.mesh})
        if (!file->empty()) inputs.push_back(*file);
    return inputs;
}

void write_results(Stage& stage, const std::string& folder, const NamedFiles& files,
                   const std::vector<std::string>& inputs) {
    std::error_code ignored;
    for (const auto& [name, bytes] : files)
        for (const std::string& input : inputs)
            if (fs::equivalent(input, fs::path(folder) / name, ignored))
                throw UsageError(input + ": would be written over; give another folder");
    make_folder(folder);
    for (const auto& [name, bytes] : files) {
        const std::string path = (fs::path(folder) / name).string();
        stage.write_file(path, bytes);
        fmt::print("{}\n", path);
    }
}

}  // namespace

int main(int argc, char** argv) {
    TransferParams params;
    Stage stage("transfer", "Carries points, values, textures and shapes through a map");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    MapInputs inputs(stage);
    const auto& out = stage.option("out", "folder for the results, which keep the names of what is carried");
    const auto& reverse = stage.flag("reverse", "carry from the target to the source");
    const auto& points = stage.input_list_option(
        "points",
        "points, landmarks or curves: .mrk.json, .fcsv, .pp, .pts, or lines of x y z or vertex numbers");
    const auto& values = stage.input_list_option(
        "values", "numbers of vertices or faces, to interpolate: .csv, .txt, .npy, .ply");
    const auto& labels = stage.input_list_option("labels", "the same, never mixed; words, too");
    const auto& weights = stage.input_list_option("weights", "skin weights: rows stay sums of one");
    const auto& regions = stage.input_list_option("regions", "lists of faces, counted from 0");
    const auto& shapes = stage.input_list_option(
        "shape", "the source's mesh in other shapes, carried as displacements of the target");
    const auto& texture =
        stage.input_option("texture", "OBJ of the source with texture coordinates and materials");
    const auto& onto =
        stage.input_option("onto", "baking: OBJ of the target with texture coordinates (default: its mesh)");
    const auto& mesh =
        stage.input_option("mesh", "OBJ of the source whose polygons are to stand in the target's shape");
    inputs.declare_hashes(stage);
    return stage.main(argc, argv, [&] {
        if (out.empty()) throw UsageError("say where the results go: --out FOLDER");
        const TransferRequest request{.points = points,
                                      .values = values,
                                      .labels = labels,
                                      .weights = weights,
                                      .regions = regions,
                                      .shapes = shapes,
                                      .texture = texture,
                                      .onto = onto,
                                      .mesh = mesh,
                                      .reading = params.reading,
                                      .bake = {params.bake, params.padding},
                                      .influences = params.influences,
                                      .folder = out};
        if (request.empty())
            throw UsageError(
                "nothing to carry: give --points, --values, --labels, --weights, --regions, --shape, "
                "--texture or --mesh");
        inputs.require_unchanged();
        const MapFiles files = inputs.files();
        const Correspondence map = read_correspondence(files, reverse);
        write_results(stage, out, transfer(request, map, reverse), inputs_of(request, files));
    });
}
