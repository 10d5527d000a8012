#include "varimap/image/png_file.h"

#include <png.h>

#include <cstddef>

#include "varimap/core/error.h"

namespace varimap {

std::string encode_png(int width, int height, const std::vector<unsigned char>& pixels) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = png_uint_32(width);
    header.height = png_uint_32(height);
    const bool alpha = pixels.size() == 4 * std::size_t(width) * std::size_t(height);
    header.format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    // As much as may be needed: asking for the size would compress the picture twice.
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels.data(), 0, nullptr)) {
        bytes.resize(size);
        return bytes;
    }
    throw Error(ExitCode::internal, std::string("cannot encode the PNG: ") + header.message);
}

DecodedPng decode_png(std::string_view bytes, const std::string& path) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()))
        throw InputError(path + ": not a PNG; save the texture as one (" + header.message + ")");
    header.format = PNG_FORMAT_RGBA;
    header.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    DecodedPng image{int(header.width), int(header.height), {}};
    image.rgba.resize(PNG_IMAGE_SIZE(header));
    if (!png_image_finish_read(&header, nullptr, image.rgba.data(), 0, nullptr))
        throw InputError(path + ": the PNG is damaged (" + header.message + ")");
    return image;
}

bool has_transparent_pixels(std::string_view bytes) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&header, bytes.data(), bytes.size())) return false;
    const bool has_alpha = (header.format & PNG_FORMAT_FLAG_ALPHA) != 0;
    png_image_free(&header);
    if (!has_alpha) return false;
    try {
        const DecodedPng image = decode_png(bytes, "");
        for (std::size_t alpha = 3; alpha < image.rgba.size(); alpha += 4)
            if (image.rgba[alpha] < 255) return true;
    } catch (const InputError&) {
        // Damaged: whoever shows the image will say so.
    }
    return false;
}

}  // namespace varimap
