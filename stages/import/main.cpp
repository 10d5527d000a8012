#include <fmt/format.h>

#include <filesystem>

#include "stages/import/isolated.h"
#include "stages/import/scene_files.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/log.h"
#include "varimap/core/printable.h"
#include "varimap/mesh_files/text_scanner.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;
namespace fs = std::filesystem;

/// Files of that size take a tenth of it.
Limits limits_for(const std::string& path) {
    const double megabytes = double(fs::file_size(path)) / 1e6;
    return {60 + 2 * megabytes, 2 + .1 * megabytes};
}

// What the process that reads a scene hands on: names and sizes in a line each, before the bytes.

std::vector<std::string> left_out_of(const ImportedScene& scene) {
    std::vector<std::string> left_out;
    for (const std::string& image : scene.missing_images)
        left_out.push_back(fmt::format("the image {} of a material is not there", printable(image)));
    left_out.insert(left_out.end(), scene.left_out.begin(), scene.left_out.end());
    return left_out;
}

std::string packed(const ImportedScene& scene, const std::string& name) {
    const std::vector<std::string> left_out = left_out_of(scene);
    std::string text = fmt::format("{}\n", left_out.size());
    for (const std::string& what : left_out) text += what + "\n";
    for (const auto& [file, bytes] : to_files(scene, name))
        text += fmt::format("{}\n{}\n", file, bytes.size()) + bytes;
    return text;
}

struct Unpacked {
    std::vector<std::string> left_out;
    SceneFiles files;
};

Unpacked unpacked(std::string_view text) {
    const auto line = [&] { return std::string(split_off_line(text)); };
    Unpacked result;
    for (int left = std::stoi(line()); left > 0; --left) result.left_out.push_back(line());
    while (!text.empty()) {
        std::string name = line();
        const std::size_t size = std::stoull(line());
        result.files.emplace_back(std::move(name), text.substr(0, size));
        text.remove_prefix(size);
    }
    return result;
}

bool holds(const std::string& path, const std::string& bytes) {
    std::error_code failure;
    return fs::is_regular_file(path, failure) && read_file(path) == bytes;
}

}  // namespace

int main(int argc, char** argv) {
    Stage stage("import", "A mesh in glTF, FBX, COLLADA, 3MF and other formats as an OBJ file");
    const std::string& in = stage.input("scene", "a file in any format that assimp reads");
    const std::string& out =
        stage.output("obj", 0, "OBJ file to write; left as it is where it holds the same");
    return stage.main(argc, argv, [&] {
        if (!is_importable(in))
            throw InputError(in + ": the name's ending is that of no format that can be read");
        const fs::path path(out);
        const std::string text = run_isolated(
            [&] { return packed(read_scene(in), printable(path.stem().string())); }, limits_for(in), in);
        auto [left_out, files] = unpacked(text);
        for (const std::string& what : left_out) note("{}: {}", in, what);
        stage.record_file("scene", in);
        stage.record_finding(content_hash(in + "\n" + text));
        files[0].first = path.filename().string();
        for (const auto& [name, bytes] : files) {
            const std::string file = (path.parent_path() / name).string();
            if (!holds(file, bytes)) stage.write_file(file, bytes);
        }
    });
}
