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
    for (std::size_t i = 0; i < surface.on_mesh.size(); ++i) {
        const SurfacePoint& point = surface.on_mesh[i];
        double ratio = 0;
        bool known = point.face >= 0;
        for (int c = 0; c < 3 && known; ++c) {
            if (point.barycentric[c] == 0) continue;
            const int k = sample_at[std::size_t(surface.mesh.faces(point.face, c))];
            known = k >= 0;
            if (known) ratio += point.barycentric[c] * transported[k] / mass[k];
        }
        if (known) text += fmt::format("{},{}\n", i, ratio);
    }
    return text;
}

}  // namespace varimap
