#include "varimap/mesh/io/ply_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>

#include "varimap/mesh/io/polygon_soup.h"

namespace varimap {
namespace {

std::string declarations(const std::vector<PlyColumn>& columns) {
    std::string text;
    for (const PlyColumn& column : columns) text += fmt::format("property {} {}\n", column.type, column.name);
    return text;
}

void append_row(const std::vector<PlyColumn>& columns, int row, std::string& bytes) {
    for (const PlyColumn& column : columns)
        ply_type(column.type)->append(column.values[std::size_t(row)], bytes);
}

/// The rest of a line of text: numbers as their types hold them, which read back the same.
void append_text(const std::vector<PlyColumn>& columns, int row, std::string& bytes) {
    for (const PlyColumn& column : columns) {
        std::string number;
        const NumberType& type = *ply_type(column.type);
        type.append(column.values[std::size_t(row)], number);
        const double value = type.read(number.data());
        const bool single = column.type == "float" || column.type == "float32";
        bytes += single ? fmt::format(" {}", float(value)) : fmt::format(" {}", value);
    }
    bytes += '\n';
}

}  // namespace

const NumberType* ply_type(std::string_view name) {
    static const std::map<std::string, NumberType, std::less<>> types{
        {"char", number_type<std::int8_t>()},     {"int8", number_type<std::int8_t>()},
        {"uchar", number_type<std::uint8_t>()},   {"uint8", number_type<std::uint8_t>()},
        {"short", number_type<std::int16_t>()},   {"int16", number_type<std::int16_t>()},
        {"ushort", number_type<std::uint16_t>()}, {"uint16", number_type<std::uint16_t>()},
        {"int", number_type<std::int32_t>()},     {"int32", number_type<std::int32_t>()},
        {"uint", number_type<std::uint32_t>()},   {"uint32", number_type<std::uint32_t>()},
        {"float", number_type<float>()},          {"float32", number_type<float>()},
        {"double", number_type<double>()},        {"float64", number_type<double>()}};
    const auto found = types.find(name);
    return found == types.end() ? nullptr : &found->second;
}

PlyFormat ply_format(std::string_view bytes) {
    const std::string_view header = bytes.substr(0, bytes.find("end_header"));
    return header.find("\nformat ascii") == header.npos ? PlyFormat::binary : PlyFormat::ascii;
}

std::string to_ply(const TriangleMesh& mesh, const PlyColumns& columns, PlyFormat format) {
    const bool ascii = format == PlyFormat::ascii;
    std::string bytes = fmt::format(
        "ply\nformat {} 1.0\n"
        "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}"
        "element face {}\nproperty list uchar int vertex_indices\n{}end_header\n",
        ascii ? "ascii" : "binary_little_endian", mesh.vertex_count(), declarations(columns.vertex),
        mesh.face_count(), declarations(columns.face));
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (ascii) {
            bytes += fmt::format("{} {} {}", mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2));
            append_text(columns.vertex, v, bytes);
        } else {
            bytes.append(reinterpret_cast<const char*>(mesh.vertices.data() + 3 * v), 3 * sizeof(double));
            append_row(columns.vertex, v, bytes);
        }
    }
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (ascii) {
            bytes += fmt::format("3 {} {} {}", mesh.faces(f, 0), mesh.faces(f, 1), mesh.faces(f, 2));
            append_text(columns.face, f, bytes);
        } else {
            bytes.push_back(3);
            bytes.append(reinterpret_cast<const char*>(mesh.faces.data() + 3 * f), 3 * sizeof(int));
            append_row(columns.face, f, bytes);
        }
    }
    return bytes;
}

std::string to_ply(const PolygonSoup& soup, PlyFormat format) {
    const bool ascii = format == PlyFormat::ascii;
    std::size_t begin = 0, most = 0;
    for (const std::size_t end : soup.ends) most = std::max(most, end - std::exchange(begin, end));
    const bool is_small = most < 256;
    std::string bytes = fmt::format(
        "ply\nformat {} 1.0\n"
        "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "element face {}\nproperty list {} int vertex_indices\nend_header\n",
        ascii ? "ascii" : "binary_little_endian", soup.points.size(), soup.ends.size(),
        is_small ? "uchar" : "int");
    const auto append = [&](auto value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    for (const Vec3& x : soup.points)
        if (ascii)
            bytes += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
        else
            for (const double number : x) append(number);
    begin = 0;
    for (const std::size_t end : soup.ends) {
        if (ascii)
            bytes += fmt::format("{}", end - begin);
        else if (is_small)
            append(std::uint8_t(end - begin));
        else
            append(std::int32_t(end - begin));
        for (; begin < end; ++begin)
            if (ascii)
                bytes += fmt::format(" {}", soup.corners[begin]);
            else
                append(std::int32_t(soup.corners[begin]));
        if (ascii) bytes += '\n';
    }
    return bytes;
}

}  // namespace varimap
