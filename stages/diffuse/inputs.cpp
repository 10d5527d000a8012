#include "stages/diffuse/inputs.h"

#include <utility>

#include "varimap/core/error.h"
#include "varimap/results/map_file.h"
#include "varimap/surface/part_region.h"

namespace varimap {

namespace {

/// Read against the meshes' files, whose vertices and faces it names.
std::optional<Correspondences> read_foreign_map(Stage& stage, const std::string& path, IndexBase base,
                                                const Surface& A, const Surface& B) {
    if (path.empty()) return {};
    const TriangleMesh source = in_numbers_of_file(A.input, A.link);
    const PointMap map = read_map_file(path, base, file_of(B), &source);
    stage.record_file("initial-map", path);
    return correspondences_of(map, A, B);
}

/// Where varimap-locate placed a part, whichever surface that is.
std::optional<Correspondences> read_placed(Stage& stage, const std::string& path, const Surface& A,
                                           const Surface& B) {
    if (path.empty()) return {};
    const PartRegion region = stage.read<PartRegion>("placed", path).value;
    const Surface &part = region.part_is_source ? A : B, &whole = region.part_is_source ? B : A;
    require_places(region, file_of(part), file_of(whole));
    Correspondences pairs = correspondences_of(region.placed, part, whole);
    if (!region.part_is_source) std::swap(pairs.from_A, pairs.from_B);
    return pairs;
}

}  // namespace

void require_effect(const DiffuseParams& params, const StartFiles& files) {
    if (!files.placed.empty() && !files.initial_map.empty())
        throw UsageError("give --placed or --initial-map, not both");
    if (!files.candidates.empty() && !files.initial_map.empty())
        throw UsageError("give --candidates or --initial-map, not both");
    if (params.candidate != DiffuseParams().candidate && files.candidates.empty())
        throw UsageError("--candidate says which of the maps of --candidates is continued: give these, too");
    if (params.map_base != DiffuseParams().map_base && files.initial_map.empty())
        throw UsageError("--map_base says how --initial-map counts vertices: give that, too");
}

std::optional<Candidates> read_candidates(Stage& stage, const PairInputs& inputs, const std::string& path,
                                          const Surface& A, const Surface& B) {
    if (path.empty()) return {};
    auto candidates = stage.read<Candidates>("candidates", path);
    inputs.require_sketches(candidates, path);
    require_surfaces(candidates.value, A.input, B.input);
    return std::move(candidates.value);
}

std::optional<Correspondences> read_initial_map(Stage& stage, const StartFiles& files, IndexBase base,
                                                const Surface& A, const Surface& B) {
    if (!files.initial_map.empty() && !(A.is_surface() && B.is_surface()))
        throw UsageError(
            "--initial-map is for meshes: points and graphs have no faces to map onto; give "
            "--landmarks instead");
    return files.placed.empty() ? read_foreign_map(stage, files.initial_map, base, A, B)
                                : read_placed(stage, files.placed, A, B);
}

}  // namespace varimap
