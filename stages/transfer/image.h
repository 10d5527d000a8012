#pragma once

#include <string>
#include <vector>

#include "varimap/core/linear_algebra.h"

namespace varimap {

/// 8-bit sRGB with alpha, four bytes a pixel, rows from the top.
struct TextureImage {
    int width = 0, height = 0;
    std::vector<unsigned char> rgba;

    TextureImage() = default;
    TextureImage(int columns, int rows)
        : width(columns), height(rows), rgba(4 * std::size_t(columns) * std::size_t(rows), 0) {}
    unsigned char* pixel(int x, int y) { return rgba.data() + 4 * (std::size_t(y) * std::size_t(width) + x); }
    const unsigned char* pixel(int x, int y) const {
        return rgba.data() + 4 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
    }
};

using Rgba = Eigen::Array4d;  ///< 0 to 255

/// Bilinear between the centres of pixels; repeats beyond 0 to 1, v upwards.
Rgba sample_image(const TextureImage& image, const Vec2& uv);

/// Throws InputError where the file is no PNG, IoError.
TextureImage read_png(const std::string& path);
/// The bytes of a PNG file.
std::string to_png(const TextureImage& image);

}  // namespace varimap
