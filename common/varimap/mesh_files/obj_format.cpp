#include "varimap/mesh_files/polygon_soup.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {
namespace {

/// The vertex of a corner such as 7, 7/1, 7//3 or -1: 0-based; negative indices count back from the last one.
long long corner_vertex(const TextScanner& scanner, std::string_view word, std::size_t points) {
    long long index;
    if (!to_integer(word.substr(0, word.find('/')), index) || index == 0)
        scanner.fail("a corner of a face is not a vertex number (they start at 1)");
    if (index > 0) return index - 1;
    if (index < -static_cast<long long>(points)) scanner.fail("a face counts back beyond the first vertex");
    return static_cast<long long>(points) + index;
}

/// The comments in front of everything else.
std::string_view leading_comments(std::string_view bytes) {
    std::size_t end = 0;
    while (end < bytes.size() && (bytes[end] == '#' || bytes[end] == '\n' || bytes[end] == '\r'))
        end = std::min(bytes.find_first_of("\r\n", end), bytes.size() - 1) + 1;
    return bytes.substr(0, end);
}

}  // namespace

PolygonSoup parse_obj(std::string_view bytes, const std::string& path) {
    PolygonSoup soup;
    soup.space = stated_space(leading_comments(bytes));
    TextScanner scanner(bytes, path);
    while (scanner.next_line()) {
        const auto& words = scanner.words();
        if (words[0] == "v") {
            soup.points.emplace_back(scanner.number(1, "x"), scanner.number(2, "y"), scanner.number(3, "z"));
        } else if (words[0] == "f") {
            if (words.size() < 4) scanner.fail("a face has fewer than 3 corners");
            for (std::size_t i = 1; i < words.size(); ++i)
                soup.corners.push_back(corner_vertex(scanner, words[i], soup.points.size()));
            soup.end_polygon();
        }
    }
    return soup;
}

}  // namespace varimap
