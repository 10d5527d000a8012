#include "stages/explore/inputs.h"

#include <utility>

#include "varimap/core/error.h"
#include "varimap/spectral/spectral_check.h"

namespace varimap {

namespace {

Candidates read_self_maps(Stage& stage, const PairInputs& inputs, const std::string& side,
                          const std::string& path, const TriangleMesh& input) {
    auto self_maps = stage.read<Candidates>("self-maps." + side, path);
    inputs.require_self_maps(self_maps.header, path, side);
    require_surfaces(self_maps.value, input, input);
    return std::move(self_maps.value);
}

void require_made_from(const RecordedInput& child, const char* role, const RecordedInput& parent) {
    Stage::require_lineage(child.header(), child.path(), role, parent.header(), parent.path());
}

}  // namespace

void require_surface(const Surface& surface) {
    if (!surface.is_surface())
        throw InputError(
            "varimap-explore looks for maps between surfaces only; for other domains give varimap-diffuse "
            "landmarks, or --start wasserstein");
}

SelfMapsOnDemand given_self_maps(Stage& stage, const PairInputs& inputs,
                                 const std::vector<std::string>& files, const Surface& A, const Surface& B) {
    if (files.empty()) return {};
    const auto of = [&](const std::string& side, const std::string& path, const TriangleMesh& input) {
        return [maps = read_self_maps(stage, inputs, side, path, input)] { return maps; };
    };
    return {of("A", files[0], A.input), of("B", files[1], B.input)};
}

void SketchedSurface::require_lineage() const {
    require_made_from(basis, "surface", surface);
    require_made_from(hierarchy, "surface", surface);
    require_made_from(hierarchy, "basis", basis);
}

SurfaceData SketchedSurface::read() const {
    SurfaceData data{surface.read<Surface>(), basis.read<Basis>(), hierarchy.read<Hierarchy>()};
    require_fit(data);
    return data;
}

SketchedSurfaces record_surfaces(Stage& stage, const std::vector<std::string>& files,
                                 const PairInputs& sketches) {
    const auto input = [&](std::size_t k) {
        return stage.record(std::string("surfaces.") + char('A' + k), files[k]);
    };
    const SketchedSurfaces surfaces{{input(0), input(1), input(2)}, {input(3), input(4), input(5)}};
    surfaces.A.require_lineage();
    surfaces.B.require_lineage();
    sketches.require_sketched("A", surfaces.A.surface.header(), surfaces.A.surface.path());
    sketches.require_sketched("B", surfaces.B.surface.header(), surfaces.B.surface.path());
    return surfaces;
}

}  // namespace varimap
