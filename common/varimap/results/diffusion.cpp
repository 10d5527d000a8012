#include "varimap/results/diffusion.h"

#include "varimap/results/checks.h"
#include "varimap/results/serialization.h"

namespace varimap {

template <class Archive>
void serialize(Archive& archive, Diffusion& diffusion) {
    serialize(archive, static_cast<SolvedPair&>(diffusion));
    archive(diffusion.image_vertex_A, diffusion.image_vertex_B);
}

std::string encode(const Diffusion& diffusion) {
    return cereal_encode(diffusion);
}

void decode(const std::string& payload, Diffusion& diffusion) {
    cereal_decode(payload, diffusion);
    const auto a = Eigen::Index(diffusion.image_vertex_A.size()),
               b = Eigen::Index(diffusion.image_vertex_B.size());
    require_consistent<Diffusion>(diffusion, a, b);
    require<Diffusion>(are_in_range(diffusion.image_vertex_A, b) && are_in_range(diffusion.image_vertex_B, a),
                       "image vertices");
}

}  // namespace varimap
