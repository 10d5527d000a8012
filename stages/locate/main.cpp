#include <cmath>

#include "stages/locate/locate.h"
#include "varimap/core/log.h"
#include "varimap/pair_stage/landmark_vertices.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

namespace {

void report(const Located& located, PartSide part) {
    const char* own = part == PartSide::source ? "source" : "target";
    const char* other = part == PartSide::source ? "target" : "source";
    log("the {} covers {:.1f}% of the {}, strain {:.3f}", own, 100 * located.share, other, located.strain);
}

Surface read_surface(Stage& stage, const PairInputs& sketches, const std::string& side,
                     const std::string& path) {
    auto surface = stage.read<Surface>("sketched." + side, path);
    sketches.require_sketched(side, surface.header, path);
    return std::move(surface.value);
}

}  // namespace

int main(int argc, char** argv) {
    LocateParams params;
    Stage stage("locate", "Where a part lies on its whole");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    PairInputs sketches(stage, "placing.");  // other sketches than those of varimap-explore
    const std::string& surface_A = stage.input("sketched.A", "the source, of which the sketch was made");
    const std::string& surface_B = stage.input("sketched.B", "the target, of which the sketch was made");
    const std::string& out =
        stage.output(ArtifactType<PartRegion>::kind, ArtifactType<PartRegion>::schema,
                     "region to write: what varimap-preprocess --region keeps of the whole, and where "
                     "varimap-diffuse and varimap-relax --placed begin");
    const auto& landmark_files = stage.input_list_option("landmarks", "as for varimap-diffuse", 1, 2);
    return stage.main(argc, argv, [&] {
        if (params.part == PartSide::none) throw UsageError("--part: say source or target");
        SurfaceData sketch_A = sketches.read_A(stage), sketch_B = sketches.read_B(stage);
        const Surface A = read_surface(stage, sketches, "A", surface_A),
                      B = read_surface(stage, sketches, "B", surface_B);
        const Landmarks landmarks = read_landmarks(stage, landmark_files, A, B, params.landmark_reading);
        const auto at_vertices = to_mesh_vertices(landmarks.vertices, A, B);
        const PairContext context = sketch_context(std::move(sketch_A), std::move(sketch_B), landmarks, 1);
        const Located located = locate(context, A, B, at_vertices, params);
        report(located, params.part);
        stage.record_number("area_percent", 100 * located.share);
        stage.record_number("scale", located.scale);
        stage.record_number("strain", located.strain);
        if (std::isfinite(located.lead)) stage.record_number("lead", located.lead);
        stage.write(out, located.region);
    });
}
