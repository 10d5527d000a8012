#include "varimap/sliding/inverse_map.h"

#include <utility>

#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/topology.h"
#include "varimap/quality/image_mesh.h"

namespace varimap {

struct InverseMap::Search {
    ImageMesh target_on_source;
    ClosestPoint closest;
    Points normals;  ///< of the source

    Search(const SlidingMap& map, const PointMap& back)
        : target_on_source(back, map.target(), map.source()),
          closest(target_on_source.image),
          normals(vertex_normals(map.source())) {}
};

InverseMap::InverseMap(const SlidingMap& map, const PointMap& back) : map_(map), back_(back) {}
InverseMap::~InverseMap() = default;

SurfacePoint InverseMap::operator()(int v) {
    if (back_.empty()) return {};
    if (!search_) search_ = std::make_unique<Search>(map_, back_);
    const SurfacePoint point =
        search_->closest(map_.source().vertex(v), search_->normals.row(v).transpose()).point;
    return search_->target_on_source.is_mapped(point.face) ? point : SurfacePoint{};
}

void InverseMap::place(SlidingMap& map, const VertexData<bool>& marked) {
    for (int v = 0; v < marked.size(); ++v) {
        if (!marked[v] || !map.has_image(v)) continue;
        if (const SurfacePoint image = (*this)(v); image.face >= 0) map.place(v, image);
    }
}

PointMap laid_by_inverse(PointMap back, const PointMap& there, const TriangleMesh& source,
                         const TriangleMesh& target, const VertexData<bool>& marked) {
    SlidingMap map(std::move(back), source, target);
    InverseMap(map, there).place(map, marked);
    return map.points();
}

}  // namespace varimap
