#include "stages/preprocess/preprocess.h"
#include "varimap/mesh/io/mesh_file.h"
#include "varimap/mesh/surface.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

/// Errors name the file.
Surface preprocess_file(const std::string& path, const TriangleMesh& input, const PreprocessParams& params) {
    try {
        return preprocess(input, params);
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
}

}  // namespace

int main(int argc, char** argv) {
    PreprocessParams params;
    Stage stage("preprocess", "A mesh made ready for mapping: checked, unit area, evenly fine, with masses");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const std::string& in = stage.input("mesh", "OBJ, PLY, OFF or STL file");
    const std::string& out = stage.output("surface", ArtifactType<Surface>::schema, "artifact to write");
    return stage.main(argc, argv, [&] {
        const TriangleMesh input = read_mesh(in);
        require_manifold(input, in);
        stage.record_file("mesh", in);
        const Surface surface = preprocess_file(in, input, params);
        stage.record_number("input_vertices", input.vertex_count());
        stage.record_number("scale", surface.scale);
        stage.record_number("vertices", surface.mesh.vertex_count());
        stage.write(out, surface);
    });
}
