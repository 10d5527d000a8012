#include <fmt/format.h>

#include "stages/verify/verify.h"
#include "varimap/stage/stage_main.h"

int main(int argc, char** argv) {
    using namespace varimap;
    Stage stage("verify", "Judges a map on its own: reversed triangles, branch points, degree");
    RepairOptions options;
    stage.parameters([&](ParameterList& list) { options.describe(list); });
    const auto& source = stage.input("source-mesh", "mesh the map starts from");
    const auto& target = stage.input("target-mesh", "mesh the map leads to");
    const auto& map = stage.input("map", "CSV of varimap-remesh, one row per source vertex");
    const auto& mirror =
        stage.flag("mirror", "the map reverses orientation on purpose (varimap map --mirror)");
    const auto& json = stage.flag("json", "print a JSON object, with the faces and vertices found (0-based)");
    return stage.main(argc, argv, [&] {
        const Verification found = verify_files(source, target, map, mirror, options);
        if (found.left_out_count > 0)
            warn("{} triangles left out: a corner has no image", found.left_out_count);
        if (!found.degree)
            log("no degree: it needs closed surfaces, an image for every vertex, and room between the image "
                "and "
                "some points inside the target");
        fmt::print("{}", json ? as_json(found) : as_text(found));
    });
}
