#pragma once

#include <optional>
#include <string>
#include <vector>

#include "varimap/results/correspondence.h"

namespace varimap {

/// A texture of the source, and where each corner of each triangle of both surfaces lies in it: u and v, v
/// upwards; -1 twice where there is none. Of the target, a triangle across a seam has coordinates that go on
/// beyond it from its middle.
struct PageTexture {
    std::string type;   ///< of the image: image/png, image/jpeg
    std::string image;  ///< the bytes of its file
    std::vector<float> source_uv, target_uv;
};

/// The texture that most triangles of an OBJ of the source have. None where it has no texture coordinates or
/// no image. Throws InputError where the file is another mesh, or the image of another type or too large for
/// a page; IoError.
std::optional<PageTexture> read_texture(const std::string& obj, const Correspondence& map);

}  // namespace varimap
