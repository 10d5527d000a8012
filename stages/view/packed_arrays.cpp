#include "stages/view/packed_arrays.h"

#include <zlib.h>

#include "varimap/core/error.h"

namespace varimap {

std::string base64(std::string_view bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
        for (int k = 0; k < 4; ++k) text += digits[group >> (18 - 6 * k) & 63];
    }
    for (std::size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k) text[text.size() - 1 - k] = '=';
    return text;
}

std::string PackedArrays::text() const {
    uLongf size = compressBound(uLong(bytes_.size()));
    std::string deflated(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(deflated.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes_.data()), uLong(bytes_.size()), 6) != Z_OK)
        throw Error(ExitCode::internal, "cannot deflate the page's arrays");
    deflated.resize(size);
    return base64(deflated);
}

}  // namespace varimap
