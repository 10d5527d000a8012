#pragma once

#include <functional>
#include <string>

namespace varimap {

/// Small letters and digits for legends: 5 x 7 dots, 6 apart. Characters without a glyph leave a gap.
inline constexpr int letter_height = 7, letter_spacing = 6;

inline int text_width(const std::string& text) {
    return letter_spacing * int(text.size()) - 1;
}
/// Calls set(x, y) for every pixel of the text, whose upper left corner is given; `size` pixels per dot.
void draw_text(const std::string& text, int left, int top, int size,
               const std::function<void(int, int)>& set);

}  // namespace varimap
