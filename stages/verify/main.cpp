#include <fmt/format.h>

#include "stages/verify/verify.h"
#include "varimap/core/counted.h"
#include "varimap/stage/stage_main.h"

int main(int argc, char** argv) {
    using namespace varimap;
    Stage stage("verify", "Judges a map on its own: reversed triangles, branch points, degree");
    RepairOptions options;
    IndexBase base = IndexBase::automatic;
    stage.parameters([&](ParameterList& list) {
        options.describe(list);
        list.add("map_base", base, "number of the first vertex in a map of vertices to vertices");
    });
    const auto& source = stage.input("source-mesh", "mesh the map starts from");
    const auto& target = stage.input("target-mesh", "mesh the map leads to");
    const auto& map = stage.input(
        "map", "table of varimap, or a vertex of the target for each of the source: text, CSV, .npy, .npz");
    const auto& mirror =
        stage.flag("mirror", "the map reverses orientation on purpose (varimap map --mirror)");
    const auto& json = stage.flag("json", "print a JSON object, with the faces and vertices found (0-based)");
    return stage.main(argc, argv, [&] {
        const Verification found = verify_files(source, target, map, mirror, options, base);
        if (found.left_out_count > 0)
            warn("{} left out: a corner has no image",
                 counted(found.left_out_count, "triangle", "triangles"));
        if (!found.degree)
            log("no degree: it needs closed surfaces, an image for every vertex, and room between the image "
                "and "
                "some points inside the target");
        fmt::print("{}", json ? as_json(found) : as_text(found));
    });
}
