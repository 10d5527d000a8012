#include "stages/explore/candidate_maps.h"

#include <algorithm>

#include "stages/explore/telling_vertex.h"
#include "varimap/core/parallel.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/results/choice.h"
#include "varimap/surface/input_locator.h"

namespace varimap {

namespace {

PointPairs on_inputs(const PointMap& map, const Surface& from, const InputLocator& to) {
    PointPairs pairs(map.size());
    parallel_for_each_index(map.size(), std::size_t(64), [&](std::size_t v) {
        pairs[v] = {from.on_input[v], to(map[v])};
    });
    return pairs;
}

/// Per vertex of the file of `from` its image on the file of `to`, linear on the mesh's faces.
PointMap preview(const PointMap& map, const Surface& from, const Surface& to) {
    const InputLocator locate(to);
    const TriangleMesh image{positions(to.mesh, map), from.mesh.faces},
        normals{pulled_back(vertex_normals(to.mesh), to.mesh, map), from.mesh.faces};
    PointMap result(from.on_mesh.size());
    parallel_for_each_index(result.size(), std::size_t(64), [&](std::size_t v) {
        const SurfacePoint& at = from.on_mesh[v];
        if (at.face >= 0) result[v] = locate(position(image, at), position(normals, at));
    });
    return to_file(std::move(result), from, to);
}

}  // namespace

Correspondences correspondences(const MapPair& maps, const Surface& A, const Surface& B) {
    const InputLocator on_A(A), on_B(B);
    return {on_inputs(maps.A_to_B, A, on_B), on_inputs(maps.B_to_A, B, on_A)};
}

Candidates candidates_of(const std::vector<Appraised>& list, const PairContext& context) {
    Candidates found;
    found.list = ratings(list);
    for (const Appraised& one : list)
        found.maps.push_back(correspondences(one.map.maps, context.A().surface, context.B().surface));
    return found;
}

Candidates with_previews(const std::vector<Appraised>& list, const PairContext& context) {
    constexpr std::size_t shown = 3;
    Candidates found = candidates_of(list, context);
    if (confidence_of(found.list).confident) return found;
    const std::size_t count = std::min(list.size(), shown);
    if (count > 1) found.telling = telling_vertex(list, count, context);
    for (std::size_t k = 0; k < count; ++k)
        found.previews.push_back(preview(list[k].map.maps.B_to_A, context.B().surface, context.A().surface));
    return found;
}

}  // namespace varimap
