#pragma once

#include <functional>
#include <string>

#include "varimap/mesh_files/obj_model.h"

namespace varimap {

/// An image file, and whether what lies behind it shows through.
struct GltfImage {
    std::string bytes;
    bool transparent = false;
};
/// The image that materials name by that path.
using GltfImageSource = std::function<GltfImage(const std::string& path)>;
/// That of the file. Throws IoError.
GltfImage read_gltf_image(const std::string& path);

/// A binary glTF 2.0 file (.glb) of the textured mesh, images inside, each once. Where a material's image is
/// neither PNG nor JPEG, which glTF does not take, it has the material's colour, and a warning says so.
/// Throws what `image_of` throws.
std::string to_glb(const TexturedMesh& textured, const Materials& materials,
                   const GltfImageSource& image_of = read_gltf_image);

}  // namespace varimap
