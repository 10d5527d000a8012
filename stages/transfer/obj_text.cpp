#include "stages/transfer/obj_text.h"

#include <algorithm>
#include <vector>

#include "varimap/mesh/io/text_scanner.h"

namespace varimap {

namespace {

std::string turned(std::string_view polygon) {
    TextScanner scanner(polygon, "", LineStyle::plain);
    scanner.next_line();
    std::vector<std::string_view> words = scanner.words();
    if (words.size() > 2) std::reverse(words.begin() + 2, words.end());
    std::string line(words[0]);
    for (std::size_t i = 1; i < words.size(); ++i) {
        line += ' ';
        line += words[i];
    }
    return line;
}

}  // namespace

std::string with_turned_polygons(std::string_view obj) {
    std::string text;
    while (!obj.empty()) {
        const std::string_view line = split_off_line(obj);
        text += line.starts_with("f ") ? turned(line) : std::string(line);
        text += '\n';
    }
    return text;
}

}  // namespace varimap
