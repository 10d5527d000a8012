#include "stages/coarsen/coarsen.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

int main(int argc, char** argv) {
    CoarsenParams params;
    Stage stage("coarsen", "A surface at the resolution at which the map is solved for");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const std::string& in = stage.input("fine", "surface of varimap-preprocess");
    const std::string& out =
        stage.output(ArtifactType<Surface>::kind, ArtifactType<Surface>::schema, "surface to write");
    return stage.main(argc, argv, [&] {
        const Surface surface = coarsened(stage.read<Surface>("fine", in).value, params);
        stage.record_number("vertices", surface.mesh.vertex_count());
        stage.write(out, surface);
    });
}
