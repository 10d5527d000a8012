#include "stages/transfer/image.h"

#include <png.h>

#include <cmath>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"

namespace varimap {

namespace {

int repeated(int i, int size) {
    return ((i % size) + size) % size;
}

Rgba texel(const TextureImage& image, int x, int y) {
    const unsigned char* at = image.pixel(repeated(x, image.width), repeated(y, image.height));
    return {double(at[0]), double(at[1]), double(at[2]), double(at[3])};
}

}  // namespace

Rgba sample_image(const TextureImage& image, const Vec2& uv) {
    const double x = (uv[0] - std::floor(uv[0])) * image.width - .5;
    const double y = (1 - (uv[1] - std::floor(uv[1]))) * image.height - .5;
    const int left = int(std::floor(x)), top = int(std::floor(y));
    const double right_share = x - left, low_share = y - top;
    const Rgba above =
        (1 - right_share) * texel(image, left, top) + right_share * texel(image, left + 1, top);
    const Rgba below =
        (1 - right_share) * texel(image, left, top + 1) + right_share * texel(image, left + 1, top + 1);
    return (1 - low_share) * above + low_share * below;
}

TextureImage read_png(const std::string& path) {
    const std::string bytes = read_file(path);
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()))
        throw InputError(path + ": not a PNG; save the texture as one (" + header.message + ")");
    header.format = PNG_FORMAT_RGBA;
    TextureImage image(int(header.width), int(header.height));
    if (!png_image_finish_read(&header, nullptr, image.rgba.data(), 0, nullptr))
        throw InputError(path + ": the PNG is damaged (" + header.message + ")");
    return image;
}

std::string encode_png(const TextureImage& image) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = png_uint_32(image.width);
    header.height = png_uint_32(image.height);
    header.format = PNG_FORMAT_RGBA;
    png_alloc_size_t size = 0;
    std::string bytes;
    if (png_image_write_to_memory(&header, nullptr, &size, 0, image.rgba.data(), 0, nullptr)) {
        bytes.resize(size);
        if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgba.data(), 0, nullptr))
            return bytes.substr(0, size);
    }
    throw Error(ExitCode::internal, std::string("cannot encode the PNG: ") + header.message);
}

}  // namespace varimap
