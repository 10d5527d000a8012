#include "varimap/mesh/io/polygon_soup.h"
#include "varimap/mesh/io/text_scanner.h"

namespace varimap {
namespace {

void require_line(TextScanner& scanner, const char* what) {
    if (!scanner.next_line()) scanner.fail(std::string("the file ends before ") + what);
}

/// Reads the keyword, which may be missing, and leaves the scanner on the line with the counts.
/// Returns the position of the first count in that line.
std::size_t read_keyword(TextScanner& scanner) {
    require_line(scanner, "its header");
    const std::string keyword(scanner.words()[0]);
    if (keyword.size() < 3 || keyword.substr(keyword.size() - 3) != "OFF") return 0;
    if (keyword.find_first_of("4n") != keyword.npos)
        scanner.fail("only OFF files in three dimensions are read");
    if (scanner.words().size() > 1 && scanner.words()[1] == "BINARY")
        scanner.fail("binary OFF files are not read; save it as ascii");
    if (scanner.words().size() > 1) return 1;
    require_line(scanner, "the counts of vertices and faces");
    return 0;
}

}  // namespace

PolygonSoup parse_off(const std::string& bytes, const std::string& path) {
    PolygonSoup soup;
    TextScanner scanner(bytes, path);
    const std::size_t at = read_keyword(scanner);
    const long long vertices = scanner.integer(at, "the count of vertices");
    const long long faces = scanner.integer(at + 1, "the count of faces");
    for (long long v = 0; v < vertices; ++v) {
        require_line(scanner, "its last vertex");
        soup.points.emplace_back(scanner.number(0, "x"), scanner.number(1, "y"), scanner.number(2, "z"));
    }
    for (long long f = 0; f < faces; ++f) {
        require_line(scanner, "its last face");
        const long long corners = scanner.integer(0, "the count of corners");
        if (corners < 3) scanner.fail("a face has fewer than 3 corners");
        for (long long c = 1; c <= corners; ++c)
            soup.corners.push_back(scanner.integer(c, "a corner of a face"));
        soup.end_polygon();
    }
    return soup;
}

}  // namespace varimap
