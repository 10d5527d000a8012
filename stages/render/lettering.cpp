#include "stages/render/lettering.h"

#include <array>
#include <map>

namespace varimap {

namespace {

/// Rows from the top, the leftmost dot in the highest of five bits.
using Glyph = std::array<unsigned char, 7>;

const std::map<char, Glyph>& glyphs() {
    static const std::map<char, Glyph> table{
        {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},
        {'2', {14, 17, 1, 2, 4, 8, 31}},     {'3', {31, 2, 4, 2, 1, 17, 14}},
        {'4', {2, 6, 10, 18, 31, 2, 2}},     {'5', {31, 16, 30, 1, 1, 17, 14}},
        {'6', {6, 8, 16, 30, 17, 17, 14}},   {'7', {31, 1, 2, 4, 8, 8, 8}},
        {'8', {14, 17, 17, 14, 17, 17, 14}}, {'9', {14, 17, 17, 15, 1, 2, 12}},
        {'.', {0, 0, 0, 0, 0, 12, 12}},      {'+', {0, 4, 4, 31, 4, 4, 0}},
        {'a', {0, 0, 14, 1, 15, 17, 15}},    {'c', {0, 0, 14, 16, 16, 17, 14}},
        {'d', {1, 1, 13, 19, 17, 17, 15}},   {'e', {0, 0, 14, 17, 31, 16, 14}},
        {'f', {6, 9, 8, 28, 8, 8, 8}},       {'i', {4, 0, 12, 4, 4, 4, 14}},
        {'l', {12, 4, 4, 4, 4, 4, 14}},      {'m', {0, 0, 26, 21, 21, 17, 17}},
        {'n', {0, 0, 22, 25, 17, 17, 17}},   {'o', {0, 0, 14, 17, 17, 17, 14}},
        {'r', {0, 0, 22, 25, 16, 16, 16}},   {'s', {0, 0, 14, 16, 14, 1, 30}},
        {'t', {8, 8, 28, 8, 8, 9, 6}},       {'u', {0, 0, 17, 17, 17, 19, 13}},
        {'-', {0, 0, 0, 31, 0, 0, 0}}};
    return table;
}

}  // namespace

void draw_text(const std::string& text, int left, int top, int size,
               const std::function<void(int, int)>& set) {
    for (size_t n = 0; n < text.size(); ++n) {
        const auto glyph = glyphs().find(text[n]);
        if (glyph == glyphs().end()) continue;
        for (int y = 0; y < letter_height * size; ++y)
            for (int x = 0; x < 5 * size; ++x)
                if (glyph->second[size_t(y / size)] >> (4 - x / size) & 1)
                    set(left + int(n) * letter_spacing * size + x, top + y);
    }
}

}  // namespace varimap
