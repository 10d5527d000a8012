#pragma once

#include <string>

#include "varimap/mesh/io/obj_model.h"

namespace varimap {

/// A binary glTF 2.0 file (.glb) of the textured mesh, images inside, each once. Where a material's image is
/// neither PNG nor JPEG, which glTF does not take, it has the material's colour, and a warning says so.
/// Throws IoError.
std::string to_glb(const TexturedMesh& textured, const Materials& materials);

}  // namespace varimap
