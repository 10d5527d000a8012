#include "stages/locate/locate.h"
#include "varimap/core/log.h"
#include "varimap/pair_stage/pair_inputs.h"
#include "varimap/stage/stage_main.h"

using namespace varimap;

namespace {

/// Parts of people and animals in other poses were strained by .03 to .09 where they belong, and by .14 and
/// more where a limb or all was elsewhere.
constexpr double much_strain = 0.12;

void report(const Place& place, Part part) {
    const char* own = part == Part::source ? "source" : "target";
    const char* other = part == Part::source ? "target" : "source";
    log("the {} covers {:.1f}% of the {}, strain {:.3f}", own, 100 * place.share, other, place.strain);
    if (place.strain > much_strain)
        warn(
            "the {} had to be strained to lie on the {} (by {:.2f}): is it a part of it, and are the "
            "landmarks "
            "right? look at the picture, and give more landmarks",
            own, other, place.strain);
}

/// Refuses a surface of which that with this hash was not sketched.
Surface read_surface(Stage& stage, const PairInputs& sketches, const std::string& side,
                     const std::string& path) {
    auto surface = stage.read<Surface>("sketched." + side, path);
    if (sketches.sketched(side) != surface.header.payload_hash)
        throw ArtifactError("'" + path + "' is not the surface that was sketched; rerun varimap-coarsen");
    return std::move(surface.value);
}

}  // namespace

int main(int argc, char** argv) {
    LocateParams params;
    Stage stage("locate", "Where a part lies on its whole, by landmarks");
    stage.parameters([&](ParameterList& list) { params.describe(list); });
    PairInputs sketches(stage, "sketch.");
    const std::string& surface_A = stage.input("sketched.A", "the source, of which the sketch was made");
    const std::string& surface_B = stage.input("sketched.B", "the target, of which the sketch was made");
    const std::string& out =
        stage.output(ArtifactType<PartRegion>::kind, ArtifactType<PartRegion>::schema,
                     "region to write: what varimap-preprocess --region keeps of the whole");
    const auto& landmark_files = stage.input_list_option("landmarks", "as for varimap-diffuse", 1, 2);
    return stage.main(argc, argv, [&] {
        if (params.part == Part::none) throw UsageError("--part: say source or target");
        SurfaceData sketch_A = sketches.read_A(stage), sketch_B = sketches.read_B(stage);
        const Surface A = read_surface(stage, sketches, "A", surface_A),
                      B = read_surface(stage, sketches, "B", surface_B);
        const Landmarks landmarks = read_landmarks(stage, landmark_files, A, B, params.landmark_space);
        const auto at_vertices = to_mesh_vertices(landmarks.vertices, A, B);
        const PairContext context = pair_context(std::move(sketch_A), std::move(sketch_B), landmarks, 1);
        const Place place = locate(context, A, B, at_vertices, params);
        report(place, params.part);
        stage.record_number("area_percent", 100 * place.share);
        stage.record_number("scale", place.scale);
        stage.record_number("strain", place.strain);
        stage.write(out, place.region);
    });
}
