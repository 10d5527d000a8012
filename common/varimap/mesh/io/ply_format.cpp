#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>

#include "varimap/core/error.h"
#include "varimap/mesh/io/polygon_soup.h"
#include "varimap/mesh/io/text_scanner.h"

namespace varimap {
namespace {

static_assert(std::endian::native == std::endian::little, "binary meshes are read in place");

/// A scalar type of PLY: how many bytes, and how to read them.
struct Type {
    int bytes = 0;
    double (*read)(const char*) = nullptr;
};

template <class T>
Type type_of() {
    return {int(sizeof(T)), [](const char* at) {
                T value;
                std::memcpy(&value, at, sizeof value);
                return double(value);
            }};
}

Type find_type(const TextScanner& scanner, std::string_view name) {
    static const std::map<std::string, Type, std::less<>> types{
        {"char", type_of<std::int8_t>()},     {"int8", type_of<std::int8_t>()},
        {"uchar", type_of<std::uint8_t>()},   {"uint8", type_of<std::uint8_t>()},
        {"short", type_of<std::int16_t>()},   {"int16", type_of<std::int16_t>()},
        {"ushort", type_of<std::uint16_t>()}, {"uint16", type_of<std::uint16_t>()},
        {"int", type_of<std::int32_t>()},     {"int32", type_of<std::int32_t>()},
        {"uint", type_of<std::uint32_t>()},   {"uint32", type_of<std::uint32_t>()},
        {"float", type_of<float>()},          {"float32", type_of<float>()},
        {"double", type_of<double>()},        {"float64", type_of<double>()}};
    const auto found = types.find(name);
    if (found == types.end()) scanner.fail("a property has a type that PLY does not know");
    return found->second;
}

struct Property {
    std::string name;
    Type count;  ///< of a list's length; 0 bytes where the property is one value
    Type value;
};

struct Element {
    std::string name;
    long long count = 0;
    std::vector<Property> properties;

    int find(const std::string& property) const {
        for (std::size_t i = 0; i < properties.size(); ++i)
            if (properties[i].name == property) return int(i);
        return -1;
    }
};

struct PlyHeader {
    std::string format;
    std::vector<Element> elements;
};

void read_property(const TextScanner& scanner, PlyHeader& header) {
    const auto& words = scanner.words();
    if (header.elements.empty()) scanner.fail("a property stands before any element");
    Property property;
    const bool is_list = words.size() > 1 && words[1] == "list";
    if (words.size() < (is_list ? 5u : 3u)) scanner.fail("a property is incomplete");
    if (is_list) property.count = find_type(scanner, words[2]);
    property.value = find_type(scanner, words[is_list ? 3 : 1]);
    property.name = words[is_list ? 4 : 2];
    header.elements.back().properties.push_back(property);
}

PlyHeader read_header(const std::string& text, const std::string& path) {
    PlyHeader header;
    TextScanner scanner(text, path);
    if (!scanner.next_line() || scanner.words()[0] != "ply")
        scanner.fail("the file does not start with 'ply'");
    while (scanner.next_line()) {
        const auto& words = scanner.words();
        if (words[0] == "format" && words.size() > 1) {
            header.format = words[1];
        } else if (words[0] == "element") {
            const long long count = scanner.integer(2, "the count of an element");
            if (count < 0) scanner.fail("the count of an element is negative");
            header.elements.push_back({std::string(words[1]), count, {}});
        } else if (words[0] == "property") {
            read_property(scanner, header);
        }
    }
    if (header.format != "ascii" && header.format != "binary_little_endian" &&
        header.format != "binary_big_endian")
        throw InputError(path + ": the header names no format that PLY knows");
    return header;
}

/// The numbers behind the header, one after the other.
class Body {
  public:
    Body(std::string_view bytes, const std::string& format, const std::string& path)
        : bytes_(bytes), ascii_(format == "ascii"), swap_(format == "binary_big_endian"), path_(path) {}

    double next(const Type& type) { return ascii_ ? next_word() : next_binary(type); }
    /// Refuses a list that cannot fit into the rest of the file.
    std::size_t next_count(const Property& property) {
        const double count = next(property.count);
        const double least = ascii_ ? 1 : property.value.bytes;
        if (!(count >= 0) || count != std::size_t(std::min(count, 1e15)) || count * least > left())
            fail("a list has a length that the file cannot hold");
        return std::size_t(count);
    }
    std::size_t left() const { return bytes_.size() - at_; }
    [[noreturn]] void fail(const std::string& message) const { throw InputError(path_ + ": " + message); }

  private:
    double next_word() {
        at_ = std::min(bytes_.find_first_not_of(" \t\r\n", at_), bytes_.size());
        const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n", at_), bytes_.size());
        double value;
        if (at_ == end) fail("the file ends before its last element");
        if (!to_number(bytes_.substr(at_, end - at_), value))
            fail(fmt::format("the text at byte {} behind the header is not a number", at_));
        at_ = end;
        return value;
    }
    double next_binary(const Type& type) {
        if (left() < std::size_t(type.bytes)) fail("the file ends before its last element");
        char value[8] = {};
        for (int i = 0; i < type.bytes && i < 8; ++i)
            value[swap_ ? type.bytes - 1 - i : i] = bytes_[at_ + std::size_t(i)];
        at_ += type.bytes;
        return type.read(value);
    }

    std::string_view bytes_;
    bool ascii_, swap_;
    std::string path_;
    std::size_t at_ = 0;
};

/// Reads one element after the other and hands over the value of each property.
void read_element(Body& body, const Element& element,
                  const std::function<void(std::size_t property, const std::vector<double>& values)>& take,
                  const std::function<void()>& end) {
    std::vector<double> values;
    for (long long i = 0; i < element.count && !element.properties.empty(); ++i) {
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            const Property& property = element.properties[p];
            values.resize(property.count.bytes > 0 ? body.next_count(property) : 1);
            for (double& value : values) value = body.next(property.value);
            take(p, values);
        }
        end();
    }
}

void read_vertices(Body& body, const Element& element, PolygonSoup& soup) {
    const std::array<int, 3> axis{element.find("x"), element.find("y"), element.find("z")};
    if (*std::min_element(axis.begin(), axis.end()) < 0) body.fail("the vertices have no x, y and z");
    for (const int a : axis)
        if (element.properties[a].count.bytes > 0) body.fail("x, y or z of the vertices is a list");
    Vec3 point;
    read_element(
        body, element,
        [&](std::size_t property, const std::vector<double>& values) {
            for (int i = 0; i < 3; ++i)
                if (axis[i] == int(property)) point[i] = values[0];
        },
        [&] { soup.points.push_back(point); });
}

void read_faces(Body& body, const Element& element, PolygonSoup& soup) {
    const int list = std::max(element.find("vertex_indices"), element.find("vertex_index"));
    if (list < 0 || element.properties[list].count.bytes == 0)
        body.fail("the faces have no list vertex_indices");
    read_element(
        body, element,
        [&](std::size_t property, const std::vector<double>& values) {
            if (int(property) != list) return;
            if (values.size() < 3)
                body.fail(fmt::format("face {} has fewer than 3 corners", soup.ends.size()));
            for (const double value : values)
                soup.corners.push_back(
                    value >= 0 && value < 1e15 && value == std::floor(value) ? (long long)value : -1);
        },
        [&] { soup.end_polygon(); });
}

}  // namespace

PolygonSoup parse_ply(const std::string& bytes, const std::string& path) {
    const std::size_t keyword = bytes.find("end_header");
    if (keyword == bytes.npos) throw InputError(path + ": not a PLY file (no 'end_header')");
    const std::size_t line_end = bytes.find_first_of("\r\n", keyword);
    const std::size_t begin = std::min(
        bytes.size(),
        line_end == bytes.npos ? bytes.size() : line_end + (bytes.compare(line_end, 2, "\r\n") == 0 ? 2 : 1));
    const PlyHeader header = read_header(bytes.substr(0, keyword), path);
    Body body(std::string_view(bytes).substr(begin), header.format, path);
    PolygonSoup soup;
    for (const Element& element : header.elements) {
        if (element.name == "vertex") {
            read_vertices(body, element, soup);
        } else if (element.name == "face") {
            read_faces(body, element, soup);
        } else {
            read_element(
                body, element, [](std::size_t, const std::vector<double>&) {}, [] {});
        }
    }
    return soup;
}

}  // namespace varimap
