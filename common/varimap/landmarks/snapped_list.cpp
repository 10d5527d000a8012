#include <fmt/format.h>

#include <algorithm>

#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/printable.h"
#include "varimap/landmarks/private/named.h"

namespace varimap {

namespace {

/// Points in the mesh's axes, as the vertices nearest to where they lie on the surface.
void place(std::vector<Named>& list, const std::vector<Vec3>& positions, const std::string& path,
           const TriangleMesh& mesh) {
    const Snapped snapped = snap(positions, mesh);
    const auto farthest = std::ranges::max_element(snapped.distances) - snapped.distances.begin();
    require_near(snapped, positions, mesh, row_of(path, list[std::size_t(farthest)].line).place, "landmarks");
    for (std::size_t i = 0; i < list.size(); ++i) {
        std::string what = row_of(path, list[i].line).place + ": landmark";
        if (!list[i].name.empty()) what += fmt::format(" {}", excerpt(list[i].name));
        log("{} lies {:.4f} from the surface, in units of sqrt(area); vertex {}", what, snapped.distances[i],
            snapped.vertices[i]);
        if (snapped.distances[i] > far_from_surface)
            warn("{} lies far from the surface: is the list that of this mesh?", what);
        list[i].vertex = snapped.vertices[i];
        list[i].point = snapped.points[i];
    }
}

}  // namespace

std::vector<Named> snapped_list(const std::vector<PickedPoint>& picked, const std::string& path,
                                const TriangleMesh& mesh, LandmarkSpace space) {
    std::vector<Named> defined, list;
    std::vector<Vec3> positions;
    for (const PickedPoint& point : picked) {
        if (!point.defined) continue;
        defined.push_back({point.line, no_vertex, point.name});
        positions.push_back(in_axes_of(mesh, point, space));
    }
    if (defined.empty()) throw InputError(path + ": all of its landmarks are missing or switched off");
    place(defined, positions, path, mesh);
    auto next = defined.begin();
    for (const PickedPoint& point : picked)
        list.push_back(point.defined ? *next++ : Named{point.line, no_vertex, point.name});
    return list;
}

}  // namespace varimap
