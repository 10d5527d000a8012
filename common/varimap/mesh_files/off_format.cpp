#include "varimap/mesh_files/polygon_soup.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {
namespace {

/// The words behind the keyword, line after line.
class OffWords {
  public:
    OffWords(std::string_view bytes, const std::string& path) : scanner_(bytes, path) {}

    void read_keyword();
    /// The next word; goes on in the next line where this one ends.
    long long integer(const char* what) { return scanner_.integer(step(what), what); }
    double number(const char* what) { return scanner_.number(step(what), what); }
    std::size_t left_in_line() const { return scanner_.words().size() - at_; }
    /// Leaves what is left of the line.
    void end_line() { at_ = scanner_.words().size(); }
    /// Whether enough lines are left for each of `count` elements to start one.
    bool has_lines_for(long long count) const;
    bool at_end() const { return at_ == scanner_.words().size() && !has_lines_for(1); }
    [[noreturn]] void fail(const std::string& message) const { scanner_.fail(message); }

  private:
    void require_line(const char* what) {
        if (!scanner_.next_line()) fail(std::string("the file ends before ") + what);
        at_ = 0;
    }
    std::size_t step(const char* what) {
        if (at_ == scanner_.words().size()) require_line(what);
        return at_++;
    }

    TextScanner scanner_;
    std::size_t at_ = 0;
};

/// The keyword may be missing; the counts may stand behind it.
void OffWords::read_keyword() {
    require_line("its header");
    const std::string keyword(scanner_.words()[0]);
    if (keyword.size() < 3 || keyword.substr(keyword.size() - 3) != "OFF") return;
    if (keyword.find_first_of("4n") != keyword.npos) fail("only OFF files in three dimensions are read");
    if (scanner_.words().size() > 1 && scanner_.words()[1] == "BINARY")
        fail("binary OFF files are not read; save it as ascii");
    at_ = 1;
}

bool OffWords::has_lines_for(long long count) const {
    TextScanner ahead = scanner_;
    while (count > 0 && ahead.next_line()) --count;
    return count <= 0;
}

/// Sums of two counts must not overflow.
long long bounded(long long count) {
    return std::clamp(count, 0ll, 1ll << 60);
}

void read_vertices(OffWords& words, long long count, bool packed, PolygonSoup& soup) {
    for (long long v = 0; v < count; ++v) {
        const double x = words.number("the x of a vertex"), y = words.number("the y of a vertex");
        soup.points.emplace_back(x, y, words.number("the z of a vertex"));
        if (!packed) words.end_line();
    }
}

void read_faces(OffWords& words, long long count, bool packed, PolygonSoup& soup) {
    for (long long f = 0; f < count; ++f) {
        const long long corners = words.integer("the count of a face's corners");
        if (corners < 3) words.fail("a face has fewer than 3 corners");
        for (long long c = 0; c < corners; ++c) soup.corners.push_back(words.integer("a corner of a face"));
        soup.end_polygon();
        if (!packed) words.end_line();
    }
}

}  // namespace

PolygonSoup parse_off(std::string_view bytes, const std::string& path) {
    PolygonSoup soup;
    OffWords words(bytes, path);
    words.read_keyword();
    const long long vertices = words.integer("the count of vertices");
    const long long faces = words.integer("the count of faces");
    // The count of edges, which may be missing; or all of the file is in this line.
    if (words.left_in_line() > 1)
        words.integer("the count of edges");
    else
        words.end_line();
    const bool packed_vertices = !words.has_lines_for(bounded(vertices) + bounded(faces));
    read_vertices(words, vertices, packed_vertices, soup);
    const bool packed_faces = !words.has_lines_for(faces);
    read_faces(words, faces, packed_faces, soup);
    if (words.at_end()) return soup;
    // A truncated file has fewer lines too; what follows its elements is read as them, and does not come out
    // even.
    words.fail(packed_vertices || packed_faces
                   ? "there are fewer lines than vertices and faces, and more numbers than these need"
                   : "more follows than the vertices and faces that the header counts");
}

}  // namespace varimap
