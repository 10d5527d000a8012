#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace varimap {

/// The bytes of a PNG file of 8-bit sRGB, rows from the top: three bytes a pixel, or with alpha four.
std::string encode_png(int width, int height, const std::vector<unsigned char>& pixels);

/// An image as 8-bit sRGB with alpha.
struct DecodedPng {
    int width = 0, height = 0;
    std::vector<unsigned char> rgba;  ///< four bytes a pixel, rows from the top
};
/// 16 bits of a channel count as sRGB where the file does not say what they are, as 8 bits do. Throws
/// InputError, naming `path`, where the bytes are no PNG.
DecodedPng decode_png(std::string_view bytes, const std::string& path);

/// Whether the bytes are a PNG of which a pixel is not opaque; not where it is damaged.
bool has_transparent_pixels(std::string_view bytes);

}  // namespace varimap
