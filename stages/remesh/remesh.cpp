#include "stages/remesh/remesh.h"

#include <fmt/format.h>

namespace varimap {

TriangleMesh cross_remesh(const PointMap& map, const Surface& source, const Surface& target) {
    Points fallback = source.input.vertices;
    fallback.rowwise() -= source.centre.transpose();
    fallback *= source.scale / target.scale;
    fallback.rowwise() += target.centre.transpose();
    const TriangleMesh in_file = target.mirrored ? with_reversed_orientation(target).input : target.input;
    Faces faces = source.input.faces;
    if (target.mirrored) faces.col(1).swap(faces.col(2));
    return {image_positions(map, in_file, fallback), faces};
}

std::string masses_csv(const Surface& surface, const std::vector<int>& samples,
                       const Eigen::VectorXd& transported, const Eigen::VectorXd& mass) {
    std::vector<int> sample_at(std::size_t(surface.mesh.vertex_count()), -1);
    for (std::size_t k = 0; k < samples.size(); ++k) sample_at[std::size_t(samples[k])] = int(k);
    std::string text = "vertex,ratio\n";
    for (std::size_t i = 0; i < surface.vertex_of_input.size(); ++i) {
        const int vertex = surface.vertex_of_input[i], k = vertex < 0 ? -1 : sample_at[std::size_t(vertex)];
        if (k >= 0) text += fmt::format("{},{}\n", i, transported[k] / mass[k]);
    }
    return text;
}

}  // namespace varimap
