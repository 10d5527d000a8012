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
    // What cannot be seen has no colour to blend in; where nothing can, the colours below are kept.
    Rgba mean = Rgba::Zero(), seen = Rgba::Zero();
    for (const int column : {0, 1})
        for (const int row : {0, 1}) {
            const double share =
                (column == 0 ? 1 - right_share : right_share) * (row == 0 ? 1 - low_share : low_share);
            const Rgba colour = texel(image, left + column, top + row);
            mean += share * colour;
            seen += share * colour[3] * colour;
        }
    if (mean[3] > 0) mean.head<3>() = seen.head<3>() / mean[3];
    return mean;
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
