#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "varimap/core/error.h"
#include "varimap/core/printable.h"
#include "varimap/mesh_files/number_type.h"
#include "varimap/mesh_files/ply_columns.h"
#include "varimap/mesh_files/polygon_soup.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {
namespace {

const NumberType& find_type(const TextScanner& scanner, std::string_view name) {
    const NumberType* type = ply_type(name);
    if (type == nullptr) scanner.fail("a property has a type that PLY does not know");
    return *type;
}

struct Property {
    std::string name;
    std::string type;  ///< of the value, as the file calls it
    NumberType count;  ///< of a list's length; 0 bytes where the property is one value
    NumberType value;
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
    std::size_t bytes = 0;  ///< its length
};

void read_property(const TextScanner& scanner, PlyHeader& header) {
    const auto& words = scanner.words();
    if (header.elements.empty()) scanner.fail("a property stands before any element");
    Property property;
    const bool is_list = words.size() > 1 && words[1] == "list";
    if (words.size() < (is_list ? 5u : 3u)) scanner.fail("a property is incomplete");
    if (is_list) property.count = find_type(scanner, words[2]);
    property.type = words[is_list ? 3 : 1];
    property.value = find_type(scanner, property.type);
    property.name = words[is_list ? 4 : 2];
    header.elements.back().properties.push_back(property);
}

/// One line of the header; false for the last one.
bool read_header_line(const TextScanner& scanner, PlyHeader& header) {
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
    return words[0] != "end_header";
}

/// Lines are taken as they are: what a comment says or ends with means nothing.
PlyHeader read_ply_header(std::string_view bytes, const std::string& path) {
    PlyHeader header;
    TextScanner scanner(bytes, path, LineStyle::plain);
    if (!scanner.next_line() || scanner.words()[0] != "ply")
        scanner.fail("the file does not start with 'ply'");
    while (scanner.next_line())
        if (!read_header_line(scanner, header)) {
            header.bytes = scanner.position();
            break;
        }
    if (header.bytes == 0) throw InputError(path + ": not a PLY file (no 'end_header')");
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

    double next(const NumberType& type) { return ascii_ ? next_word() : next_binary(type); }
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
    double next_binary(const NumberType& type) {
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

/// Which property lists the vertices of a face or strip; -1: none.
int corner_list(const Element& element) {
    return std::max(element.find("vertex_indices"), element.find("vertex_index"));
}

int find_corners(const Body& body, const Element& element) {
    const int list = corner_list(element);
    if (list < 0 || element.properties[list].count.bytes == 0)
        body.fail("the " + excerpt(element.name) + " have no list vertex_indices");
    return list;
}

/// A vertex number; -1, which is none, for a value that cannot be one.
long long to_corner(double value) {
    return value >= 0 && value < 1e15 && value == std::floor(value) ? (long long)value : -1;
}

void read_faces(Body& body, const Element& element, PolygonSoup& soup) {
    const int list = find_corners(body, element);
    read_element(
        body, element,
        [&](std::size_t property, const std::vector<double>& values) {
            if (int(property) != list) return;
            if (values.size() < 3)
                body.fail(fmt::format("face {} has fewer than 3 corners", soup.ends.size()));
            for (const double value : values) soup.corners.push_back(to_corner(value));
        },
        [&] { soup.end_polygon(); });
}

/// One strip: every vertex makes a triangle with the two before it, in turn this way and that way round.
/// Triangles that repeat a vertex only carry the strip on.
void add_strip(const std::vector<long long>& strip, PolygonSoup& soup) {
    for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
        const long long a = strip[i], b = strip[i + 1], c = strip[i + 2];
        if (a == b || b == c || c == a) continue;
        soup.corners.insert(soup.corners.end(), {i % 2 == 0 ? a : b, i % 2 == 0 ? b : a, c});
        soup.end_polygon();
    }
}

/// Strips stand one after the other in a list, parted by -1.
void read_strips(Body& body, const Element& element, PolygonSoup& soup) {
    const int list = find_corners(body, element);
    read_element(
        body, element,
        [&](std::size_t property, const std::vector<double>& values) {
            if (int(property) != list) return;
            std::vector<long long> strip;
            for (const double value : values) {
                if (value != -1) {
                    strip.push_back(to_corner(value));
                } else {
                    add_strip(strip, soup);
                    strip.clear();
                }
            }
            add_strip(strip, soup);
        },
        [] {});
}

/// The numbers of one element, a column for each property that is no list, and how long its list of corners
/// is each time.
std::vector<PlyColumn> read_columns(Body& body, const Element& element, std::vector<std::size_t>& corners) {
    std::vector<PlyColumn> columns;
    std::vector<int> column_of;
    const int list = corner_list(element);
    for (const Property& property : element.properties) {
        column_of.push_back(property.count.bytes > 0 ? -1 : int(columns.size()));
        if (property.count.bytes == 0) columns.push_back({property.name, property.type, {}});
    }
    read_element(
        body, element,
        [&](std::size_t property, const std::vector<double>& values) {
            if (column_of[property] >= 0)
                columns[std::size_t(column_of[property])].values.push_back(values[0]);
            else if (int(property) == list)
                corners.push_back(values.size());
        },
        [] {});
    return columns;
}

}  // namespace

PlyColumns parse_ply_columns(std::string_view bytes, const std::string& path) {
    const PlyHeader header = read_ply_header(bytes, path);
    Body body(bytes.substr(header.bytes), header.format, path);
    PlyColumns columns;
    for (const Element& element : header.elements) {
        std::vector<std::size_t> corners;
        std::vector<PlyColumn> found = read_columns(body, element, corners);
        if (element.name == "vertex") columns.vertex = std::move(found);
        if (element.name == "face") columns.face = std::move(found), columns.corners = std::move(corners);
    }
    return columns;
}

PolygonSoup parse_ply(std::string_view bytes, const std::string& path) {
    const PlyHeader header = read_ply_header(bytes, path);
    Body body(bytes.substr(header.bytes), header.format, path);
    PolygonSoup soup;
    soup.space = stated_space(bytes.substr(0, header.bytes));
    for (const Element& element : header.elements) {
        if (element.name == "vertex") {
            read_vertices(body, element, soup);
        } else if (element.name == "face") {
            read_faces(body, element, soup);
        } else if (element.name == "tristrips") {
            read_strips(body, element, soup);
        } else {
            read_element(
                body, element, [](std::size_t, const std::vector<double>&) {}, [] {});
        }
    }
    return soup;
}

}  // namespace varimap
