#include <filesystem>

#include "stages/import/isolated.h"
#include "stages/import/scene.h"
#include "varimap/artifact/artifact.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

/// Files of that size take a tenth of it.
Limits limits_for(const std::string& path) {
    const double megabytes = double(std::filesystem::file_size(path)) / 1e6;
    return {60 + 2 * megabytes, 2 + .1 * megabytes};
}

bool holds(const std::string& path, const std::string& bytes) {
    std::error_code failure;
    return std::filesystem::is_regular_file(path, failure) && read_file(path) == bytes;
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
        const std::string obj = run_isolated([&] { return to_obj(read_scene(in)); }, limits_for(in), in);
        stage.record_file("scene", in);
        if (!holds(out, obj)) stage.write_file(out, obj);
    });
}
