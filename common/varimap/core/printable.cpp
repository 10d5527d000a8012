#include "varimap/core/printable.h"

#include <fmt/format.h>

#include <cstdint>

namespace varimap {
namespace {

bool is_continuation(char c) {
    return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

/// Bytes of the character at the start of `text` that may be shown; 0: it may not.
std::size_t shown_bytes(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text.front());
    if (lead < 0x80) return lead >= 0x20 && lead != 0x7f ? 1 : 0;
    const std::size_t size = lead < 0xc2 || lead > 0xf4 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    if (size == 0 || text.size() < size) return 0;
    std::uint32_t code = lead & (0xffu >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) {
        if (!is_continuation(text[i])) return 0;
        code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3f);
    }
    constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool overlong = code < least[size], surrogate = code >= 0xd800 && code < 0xe000;
    const bool control = code < 0xa0;
    // They turn the direction of the text round them.
    const bool turns = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
    return overlong || surrogate || control || turns || code > 0x10ffff ? 0 : size;
}

}  // namespace

std::string printable(std::string_view text) {
    std::string shown;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t size = shown_bytes(rest);
        if (size > 0)
            shown += rest.substr(0, size);
        else
            shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(rest.front()));
        rest.remove_prefix(size > 0 ? size : 1);
    }
    return shown;
}

std::string excerpt(std::string_view text) {
    return printable(text.substr(0, 40));
}

}  // namespace varimap
