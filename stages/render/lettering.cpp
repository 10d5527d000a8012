#include "stages/render/lettering.h"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <vector>

namespace varimap {

namespace {

std::string ascii(std::string text) {
    for (char& c : text)
        if (c < ' ' || c > '~') c = '?';
    return text;
}

/// A corner of a rectangle, as stb_easy_font lays them out, four for each.
struct Corner {
    float x, y, z;
    unsigned char colour[4];
};

}  // namespace

int text_width(const std::string& text) {
    return stb_easy_font_width(ascii(text).data());
}

void draw_text(const std::string& text, int left, int top, int size,
               const std::function<void(int, int)>& set) {
    constexpr std::size_t most = 4 * 16;  // corners of one letter
    std::string letters = ascii(text);
    std::vector<Corner> corners(most * (letters.size() + 1));
    const int count = stb_easy_font_print(0, 0, letters.data(), nullptr, corners.data(),
                                          int(corners.size() * sizeof(Corner)));
    for (int r = 0; r < count; ++r) {
        // The first corner is the upper left, the third the lower right.
        const Corner &low = corners[4 * std::size_t(r)], &high = corners[4 * std::size_t(r) + 2];
        for (int y = int(low.y) * size; y < int(high.y) * size; ++y)
            for (int x = int(low.x) * size; x < int(high.x) * size; ++x) set(left + x, top + y);
    }
}

}  // namespace varimap
