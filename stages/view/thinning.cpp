#include "stages/view/thinning.h"

#include <utility>
#include <vector>

#include "varimap/core/error.h"
#include "varimap/core/index_set.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/mesh/coarsening.h"
#include "varimap/mesh/manifold.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

/// A surface as it is shown, and which vertex each of its vertices was.
struct Shown {
    TriangleMesh mesh;
    std::vector<int> vertex;
};

Shown whole(const TriangleMesh& mesh) {
    return {mesh, all_indices(mesh.vertex_count())};
}

/// The surface without the vertices that no face uses.
Shown used_part(const TriangleMesh& mesh) {
    UsedVertices used = used_vertices(mesh.faces, mesh.vertex_count());
    return {{mesh.vertices(used.vertex, Eigen::all), std::move(used.faces), mesh.space},
            std::move(used.vertex)};
}

Shown shown_of(const TriangleMesh& mesh, const std::string& file, int most) {
    if (mesh.vertex_count() <= most) return whole(mesh);
    try {
        require_manifold(mesh, file);
    } catch (const InputError&) {
        return whole(mesh);
    }
    Shown used = used_part(mesh);
    Coarsening coarse = coarsen(used.mesh, most);
    for (int& v : coarse.vertex) v = used.vertex[std::size_t(v)];
    coarse.mesh.space = mesh.space;
    log("{}: {} of {} vertices are shown", file, coarse.mesh.vertex_count(), mesh.vertex_count());
    return {std::move(coarse.mesh), std::move(coarse.vertex)};
}

/// The images of the vertices that are shown, on the other surface as it is shown.
PointMap images(const Shown& from, const PointMap& map, const TriangleMesh& to,
                const TriangleMesh& shown_to) {
    const ClosestPoint closest(shown_to);
    const TriangleMesh normals{vertex_normals(to), to.faces};
    PointMap result(from.vertex.size());
    parallel_for_each_index(int(result.size()), 256, [&](int v) {
        const SurfacePoint& image = map[std::size_t(from.vertex[std::size_t(v)])];
        if (image.face >= 0)
            result[std::size_t(v)] = closest(position(to, image), position(normals, image)).point;
    });
    return result;
}

}  // namespace

Correspondence thinned(const Correspondence& map, int most) {
    if (map.from.vertex_count() <= most && map.to.vertex_count() <= most) return map;
    const Shown from = shown_of(map.from, map.from_file, most), to = shown_of(map.to, map.to_file, most);
    return {map.from_file,
            map.to_file,
            from.mesh,
            to.mesh,
            images(from, map.there, map.to, to.mesh),
            images(to, map.back, map.from, from.mesh)};
}

}  // namespace varimap
