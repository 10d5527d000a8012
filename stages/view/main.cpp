#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "stages/view/page.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/map_stage/map_inputs.h"
#include "varimap/results/candidates.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

/// The names that the points of a file have, where it has as many; else numbers.
std::vector<std::string> names_of(const std::string& file, std::size_t count) {
    std::vector<std::string> names;
    if (is_picked_points(file))
        for (const PickedPoint& point : read_picked_points(file))
            if (point.defined) names.push_back(point.name);
    if (names.size() == count) return names;
    names.clear();
    for (std::size_t i = 0; i < count; ++i) names.push_back(fmt::format("L{}", i + 1));
    return names;
}

NamedLandmarks read_named_landmarks(const std::vector<std::string>& files, const Correspondence& map,
                                    const LandmarkReading& reading) {
    const PointPairs points = as_points(read_landmarks(files, map.from, map.to, reading), map.from, map.to);
    return {points, names_of(files[0], points.size())};
}

/// Landmarks that went into the map, with their names; none where their files have changed beyond use.
NamedLandmarks landmarks_of(const std::vector<std::string>& files, const Correspondence& map,
                            const LandmarkReading& reading) {
    if (files.empty()) return {};
    try {
        return read_named_landmarks(files, map, reading);
    } catch (const InputError& error) {
        warn("{}; the page shows no landmarks", error.what());
        return {};
    }
}

std::string read_report(const std::string& path) {
    if (path.empty()) return "";
    const std::string text = read_file(path);
    if (!nlohmann::json::accept(text))
        throw InputError(path + ": is not JSON; make it with pipelines/report.jq");
    return text;
}

/// The texture of an OBJ that is asked for; of the mesh itself, where it is one that can be shown.
std::optional<PageTexture> texture_of(const std::string& asked, const Correspondence& map) {
    if (!asked.empty()) {
        auto texture = read_texture(asked, map);
        if (!texture) throw InputError(asked + ": has no texture coordinates, or no material with an image");
        return texture;
    }
    const std::string& mesh = map.from_file;
    if (!has_ending(mesh, ".obj")) return {};
    try {
        return read_texture(mesh, map);
    } catch (const Error& error) {
        warn("{}; the page shows no texture", error.what());
        return {};
    }
}

std::vector<PageCandidate> candidates_of(const Candidates& candidates, const Correspondence& map) {
    require_previews(candidates, map.from, map.to);
    std::vector<PageCandidate> shown;
    for (std::size_t k = 0; k < candidates.previews.size(); ++k)
        shown.push_back({relation(candidates.list[k]), candidates.previews[k]});
    return shown;
}

}  // namespace

int main(int argc, char** argv) {
    LandmarkReading landmark_reading;
    Stage stage("view", "A page that shows a map, for any browser, without network");
    stage.parameters([&](ParameterList& list) { landmark_reading.describe(list); });
    MapInputs inputs(stage);
    const auto& frame = stage.input("frame", "page without data, made by pipelines/view/build");
    const auto& page = stage.output("page", 0, "HTML to write");
    const auto& report = stage.input_option("report", "what pipelines/report.jq makes of quality.json");
    const auto& landmarks = stage.input_list_option(
        "landmarks", "what the map was made with: a file of pairs, or two lists", 1, 2);
    const auto& texture = stage.input_option(
        "texture", "OBJ of the source with a texture (default: the source's mesh, where it has one)");
    const auto& candidates_in = stage.input_option(
        "candidates", "of varimap-explore: where its choice was not sure, the page shows the first three");
    const auto& mirror = stage.flag("mirror", "the map reverses orientation on purpose");
    inputs.declare_hashes(stage);
    return stage.main(argc, argv, [&] {
        inputs.require_unchanged();
        const Correspondence map = read_correspondence(inputs.files(), false);
        PageContent content{map, landmarks_of(landmarks, map, landmark_reading), read_report(report), mirror};
        content.texture = texture_of(texture, map);
        if (content.texture && is_thinned(map))
            warn(
                "the page shows {} vertices of these surfaces, and no texture: varimap transfer carries it "
                "to the whole",
                most_shown);
        if (!candidates_in.empty())
            content.candidates =
                candidates_of(stage.read<Candidates>("candidates", candidates_in).value, map);
        stage.write_file(page, viewer_page(content, read_file(frame)));
        fmt::print("{}\n", page);
    });
}
