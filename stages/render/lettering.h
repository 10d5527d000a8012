#pragma once

#include <functional>
#include <string>

namespace varimap {

/// Height of capital letters in dots; letters with tails go two dots further down.
inline constexpr int letter_height = 7;

/// Width in dots.
int text_width(const std::string& text);
/// Calls set(x, y) for every pixel of the text, whose upper left corner is given; `size` pixels per dot.
/// What is not ASCII is shown as a question mark.
void draw_text(const std::string& text, int left, int top, int size,
               const std::function<void(int, int)>& set);

}  // namespace varimap
