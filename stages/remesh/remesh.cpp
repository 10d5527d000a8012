#include "stages/remesh/remesh.h"

#include "stages/remesh/quality_json.h"

namespace varimap {

namespace {

PointMap on_input(const PointMap& images, const Surface& source, const Surface& target) {
    PointMap map(source.vertex_of_input.size());
    for (std::size_t i = 0; i < map.size(); ++i) {
        const int vertex = source.vertex_of_input[i];
        if (vertex >= 0) map[i] = to_input(target, images[std::size_t(vertex)]);
    }
    return map;
}

}  // namespace

SurfaceMap remesh(const Surface& A, const Surface& B, const Plan& plan) {
    const VertexMaps images = read_out(plan, A, B);
    SurfaceMap map{on_input(images.A_to_B, A, B), on_input(images.B_to_A, B, A), {}};
    map.quality = quality_json(map, A, B, plan);
    return map;
}

TriangleMesh cross_remesh(const PointMap& map, const Surface& source, const Surface& target) {
    Points fallback = source.input.vertices;
    fallback.rowwise() -= source.centre.transpose();
    fallback *= source.scale / target.scale;
    fallback.rowwise() += target.centre.transpose();
    return {image_positions(map, target.input, fallback), source.input.faces};
}

}  // namespace varimap
