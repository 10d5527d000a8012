#include <png.h>

#include "stages/render/render.h"
#include "varimap/core/error.h"

namespace varimap {

std::string to_png(const Image& image) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = png_uint_32(image.width);
    header.height = png_uint_32(image.height);
    header.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = 0;
    std::string bytes;
    if (png_image_write_to_memory(&header, nullptr, &size, 0, image.rgb.data(), 0, nullptr)) {
        bytes.resize(size);
        if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr))
            return bytes.substr(0, size);
    }
    throw Error(ExitCode::internal, std::string("cannot encode the PNG: ") + header.message);
}

}  // namespace varimap
