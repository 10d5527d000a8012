#pragma once

#include "stages/transfer/image.h"
#include "varimap/mesh_files/obj_model.h"
#include "varimap/results/correspondence.h"

namespace varimap {

/// A surface's texture: coordinates, and by material an image or a colour.
struct Texture {
    const ObjModel& model;
    const Materials& materials;
};

struct BakeSize {
    int pixels = 0;  ///< width and height; 0: nothing is baked
    /// Pixels beyond the rim of every patch, so that no background shows when it is shrunk; -1: 8.
    int padding = -1;
};

/// The texture of `map.from` drawn onto the texture coordinates that `map.to` has of its own; transparent
/// where no face lies. Where faces overlap the first counts, with a warning. Throws InputError where the
/// coordinates of `target`, which is read from `target_file`, leave the square from 0 to 1 or cover no pixel,
/// or an image is no PNG; IoError.
TextureImage bake(const Correspondence& map, const PointCarrier& back, const Texture& texture,
                  const ObjModel& target, const std::string& target_file, const BakeSize& size);

}  // namespace varimap
