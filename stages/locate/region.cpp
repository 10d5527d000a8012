#include "stages/locate/region.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "stages/locate/covered.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/mesh/topology.h"
#include "varimap/surface/part_region.h"

namespace varimap {

namespace {

/// The faces around each landmark, and those around these: landmarks at the rim hang together with the rest.
void add_landmarks(const Sides& sides, FaceData<char>& covered) {
    const TriangleMesh& mesh = sides.whole.input;
    const Adjacency faces_of_vertex = vertex_faces(mesh);
    for (const int v : sides.landmarks_whole) {
        std::vector<int> faces{sides.whole.on_input[std::size_t(v)].face};
        for (int ring = 0; ring < 2; ++ring) {
            std::vector<int> around;
            for (const int u : vertices_of(mesh, faces))
                around.insert(around.end(), faces_of_vertex[u].begin(), faces_of_vertex[u].end());
            faces = std::move(around);
        }
        for (const int f : faces) covered[f] = 1;
    }
}

/// The first landmark around which no marked faces hang together with the region's, numbered from 1; 0 if
/// there is none.
std::size_t landmark_apart(const Sides& sides, const std::vector<int>& region, const FaceData<char>& marked) {
    const Edges edges = find_edges(sides.whole.input);
    FaceData<char> hangs_together(marked.size());
    for (const std::vector<int>& patch : face_components(edges, {marked.begin(), marked.end()})) {
        const bool of_region = std::any_of(patch.begin(), patch.end(), [&](int f) {
            return std::binary_search(region.begin(), region.end(), f);
        });
        for (const int f : patch) hangs_together[f] = of_region;
    }
    for (std::size_t i = 0; i < sides.landmarks_whole.size(); ++i) {
        const SurfacePoint& at = sides.whole.on_input[std::size_t(sides.landmarks_whole[i])];
        if (!hangs_together[at.face]) return i + 1;
    }
    return 0;
}

}  // namespace

std::vector<int> region_of(const Placement& placement, const Sides& sides) {
    const TriangleMesh& whole = sides.whole.input;
    const FaceData<char> touched = touched_faces(placement.images, sides.part.mesh, sides.whole);
    FaceData<char> covered = covered_faces(placement.images, sides.part.mesh, sides.whole);
    join_patches(whole, touched, covered);
    std::vector<int> region = tidy_region(whole, std::move(covered));
    if (sides.landmarks_whole.empty()) return region;
    FaceData<char> marked(whole.face_count());
    for (const int f : region) marked[f] = 1;
    add_landmarks(sides, marked);
    join_patches(whole, touched, marked);
    const std::size_t apart = landmark_apart(sides, region, marked);
    if (apart > 0 && placement.strain <= PartRegion::much_strain)
        join_patches(whole, FaceData<char>(whole.face_count(), 1), marked);
    if (const std::size_t still = landmark_apart(sides, region, marked); still > 0)
        throw InputError(fmt::format(
            "landmark {} lies outside of where the part was put (strained by {:.2f}): is it right, and away "
            "from the rim? If the whole has other components, map the largest alone (--components largest)",
            still, placement.strain));
    if (apart > 0)
        warn("landmark {} lies beside where the part was put: is it right, and away from the rim?", apart);
    return tidy_region(whole, std::move(marked));
}

}  // namespace varimap
