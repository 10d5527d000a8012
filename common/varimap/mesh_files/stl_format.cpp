#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <unordered_map>

#include "varimap/core/error.h"
#include "varimap/core/lower_case.h"
#include "varimap/mesh_files/polygon_soup.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {
namespace {

static_assert(std::endian::native == std::endian::little, "binary meshes are read in place");

/// Makes corners with equal coordinates one vertex.
class Welder {
  public:
    explicit Welder(PolygonSoup& soup) : soup_(soup) {}
    void add_corner(const Vec3& point) {
        const Vec3 key = point.array() + 0.0;  // -0 becomes 0, which is equal to it
        const auto [entry, is_new] = vertex_.try_emplace({key[0], key[1], key[2]}, soup_.points.size());
        if (is_new) soup_.points.push_back(key);
        soup_.corners.push_back(static_cast<long long>(entry->second));
    }

  private:
    using Key = std::array<double, 3>;
    struct Hash {
        std::size_t operator()(const Key& key) const {
            std::uint64_t hash = 0;
            for (const double x : key) {
                hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u;
                hash ^= hash >> 29;
            }
            return hash;
        }
    };
    PolygonSoup& soup_;
    std::unordered_map<Key, std::size_t, Hash> vertex_;
};

constexpr std::size_t header_bytes = 84, facet_bytes = 50;

std::size_t binary_facets(std::string_view bytes) {
    std::uint32_t count = 0;
    if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + 80, 4);
    return count;
}

PolygonSoup parse_binary(std::string_view bytes, const std::string& path) {
    const std::size_t facets = binary_facets(bytes);
    if (bytes.size() < header_bytes || bytes.size() - header_bytes < facets * facet_bytes)
        throw InputError(path + ": neither an ascii STL file nor a whole binary one (is it truncated?)");
    PolygonSoup soup;
    Welder welder(soup);
    for (std::size_t f = 0; f < facets; ++f) {
        float corner[9];
        std::memcpy(corner, bytes.data() + header_bytes + f * facet_bytes + 12, sizeof corner);
        for (int c = 0; c < 3; ++c) welder.add_corner({corner[3 * c], corner[3 * c + 1], corner[3 * c + 2]});
        soup.end_polygon();
    }
    return soup;
}

/// Some programs write the words of the format in capitals.
bool is_word(std::string_view word, std::string_view expected) {
    return std::ranges::equal(word, expected, {}, [](char c) { return lower_case(c); });
}

PolygonSoup parse_ascii(std::string_view bytes, const std::string& path) {
    PolygonSoup soup;
    Welder welder(soup);
    TextScanner scanner(bytes, path);
    bool ended = false;
    while (scanner.next_line()) {
        const auto& words = scanner.words();
        ended = is_word(words[0], "endsolid");
        if (is_word(words[0], "vertex")) {
            welder.add_corner({scanner.number(1, "x"), scanner.number(2, "y"), scanner.number(3, "z")});
        } else if (is_word(words[0], "endfacet")) {
            soup.end_polygon();
            if (soup.corners.size() != 3 * soup.ends.size()) scanner.fail("a facet does not have 3 corners");
        }
    }
    if (!ended || soup.corners.size() != 3 * soup.ends.size())
        scanner.fail("the last facet or 'endsolid' is missing (is the file truncated?)");
    return soup;
}

}  // namespace

PolygonSoup parse_stl(std::string_view bytes, const std::string& path) {
    // Binary files may start with "solid" too: their size decides.
    const bool binary_size =
        bytes.size() >= header_bytes && bytes.size() - header_bytes == binary_facets(bytes) * facet_bytes;
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    const bool starts_as_ascii = start != bytes.npos && is_word(bytes.substr(start, 5), "solid");
    const bool binary = binary_size || !starts_as_ascii;
    PolygonSoup soup = binary ? parse_binary(bytes, path) : parse_ascii(bytes, path);
    // The first 80 bytes are free text; in an ascii file the first line is.
    soup.space = stated_space(bytes.substr(0, binary ? 80 : bytes.find_first_of("\r\n", start)));
    return soup;
}

}  // namespace varimap
