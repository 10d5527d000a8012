#include "stages/transfer/image.h"

#include <cmath>
#include <utility>

#include "varimap/artifact/artifact.h"
#include "varimap/image/png_file.h"

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
    DecodedPng decoded = decode_png(read_file(path), path);
    TextureImage image;
    image.width = decoded.width, image.height = decoded.height;
    image.rgba = std::move(decoded.rgba);
    return image;
}

std::string to_png(const TextureImage& image) {
    return encode_png(image.width, image.height, image.rgba);
}

}  // namespace varimap
