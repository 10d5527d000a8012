#include "stages/render/render.h"

#include <fmt/format.h>

#include "common/mapping/chord_mesh.h"
#include "common/mesh/closest_point.h"
#include "common/stage/error.h"
#include "stages/render/figure.h"
#include "stages/render/panels.h"
#include "stages/render/view.h"

namespace varimap {

namespace {

void require_fit(const PointMap& map, const TriangleMesh& from, const TriangleMesh& to, const char* name,
                 const char* from_name, const char* to_name) {
    if (int(map.size()) != from.vertex_count())
        throw InputError(fmt::format("{} has {} rows, but the {} mesh has {} vertices", name, map.size(),
                                     from_name, from.vertex_count()));
    for (size_t v = 0; v < map.size(); ++v)
        if (map[v].face >= to.face_count())
            throw InputError(fmt::format("{} sends vertex {} to face {}, but the {} mesh has {} faces", name,
                                         v, map[v].face, to_name, to.face_count()));
}

std::vector<bool> have_image(const PointMap& map) {
    std::vector<bool> result;
    for (const SurfacePoint& point : map) result.push_back(point.face >= 0);
    return result;
}

/// Colour at the source's point closest to the image of a point of the target.
Colour carried_colour(const ChordMesh& back, const ClosestPoint& closest, const SourceColour& colour,
                      const SurfacePoint& point) {
    if (!back.is_mapped(point.face)) return unmapped_colour;
    return colour(position(back.target, closest(position(back.image, point)).point));
}

}  // namespace

Image render(const TriangleMesh& source, const TriangleMesh& target, const PointMap& source_to_target,
             const PointMap& target_to_source, const RenderParams& params) {
    if (!(surface_area(source) > 0) || !(surface_area(target) > 0))
        throw InputError("a mesh without area cannot be shown");
    require_fit(source_to_target, source, target, "source_to_target", "source", "target");
    require_fit(target_to_source, target, source, "target_to_source", "target", "source");
    const ChordMesh there(source_to_target, source, target), back(target_to_source, target, source);
    const SourceColour colour(there.source, params.checker);
    const ClosestPoint closest(there.source);
    const auto flags = [&](const ChordMesh& chords) {
        return params.flips ? reversed_faces(chords) : std::vector<bool>(size_t(chords.source.face_count()));
    };
    const Figure source_figure(
        there.source, [&](const SurfacePoint& p) { return colour(position(there.source, p)); }, flags(there));
    const Figure target_figure(
        back.source, [&](const SurfacePoint& p) { return carried_colour(back, closest, colour, p); },
        flags(back));
    const View source_view = natural_view(source, params.up);
    const View target_view =
        matching_view(back.source, back.image.vertices, have_image(target_to_source), source_view);
    return draw_panels(source_figure, source_view, target_figure, target_view, params);
}

}  // namespace varimap
