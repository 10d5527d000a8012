#pragma once

#include <string>

#include "varimap/mesh/io/obj_model.h"

namespace varimap {

/// A binary glTF 2.0 file (.glb) of the textured mesh, images inside. Images must be PNG or JPEG. Throws
/// IoError, InputError.
std::string to_glb(const TexturedMesh& textured, const Materials& materials);

}  // namespace varimap
