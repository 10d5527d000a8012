#include <algorithm>

#include "stages/register/comparison.h"
#include "stages/register/extent.h"
#include "stages/register/manifest.h"
#include "stages/register/results.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

struct RegisterParams {
    int components = 5;
    bool scale = true;
    LandmarkReading landmark_reading;

    void describe(ParameterList& list) {
        list.add("components", components, "principal components to write", 0, 1000);
        list.add("scale", scale, "bring all specimens to one size before shapes are compared");
        landmark_reading.describe(list);
    }
};

void warn_of_outliers(const std::vector<std::string>& names, const ShapeComparison& shapes) {
    for (std::size_t i = 0; i < names.size(); ++i)
        if (shapes.is_outlier[i])
            warn("{} is an outlier: {:.4g} from the mean shape", names[i], shapes.distances[i]);
}

}  // namespace

int main(int argc, char** argv) {
    RegisterParams params;
    Stage stage("register", "Corresponding points of specimens, their mean shape and principal components");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    const auto& manifest =
        stage.input("manifest", "JSON of varimap register: templates, specimens and their maps");
    const auto& out = stage.option("out", "folder for the results");
    const bool& check = stage.flag(
        "check", "only read the landmarks of the templates in the manifest, before there are maps");
    return stage.main(argc, argv, [&] {
        if (check) return check_landmarks(manifest, params.landmark_reading);
        if (out.empty()) throw UsageError("say where the results go: --out FOLDER");
        const Registration all = read_registration(manifest, params.landmark_reading);
        const Extents extents(all.first, all.points, all.is_part, all.names);
        const ResultFolder folder(stage, out);
        write_points(folder, all, extents);
        if (all.landmarks) write_landmarks(folder, all);
        const ShapeComparison shapes = compare_shapes(all, extents, params.components, params.scale);
        write_shapes(folder, all, extents, shapes);
        warn_of_outliers(all.names, shapes);
        log("{} specimens, {} of them parts; {} of {} vertices in all that are whole", all.names.size(),
            std::count(all.is_part.begin(), all.is_part.end(), true), extents.common().vertices.size(),
            all.first.vertex_count());
    });
}
