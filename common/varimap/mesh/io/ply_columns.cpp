#include "varimap/mesh/io/ply_columns.h"

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <map>

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

std::string to_ply(const TriangleMesh& mesh, const PlyColumns& columns) {
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\n"
        "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}"
        "element face {}\nproperty list uchar int vertex_indices\n{}end_header\n",
        mesh.vertex_count(), declarations(columns.vertex), mesh.face_count(), declarations(columns.face));
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        bytes.append(reinterpret_cast<const char*>(mesh.vertices.data() + 3 * v), 3 * sizeof(double));
        append_row(columns.vertex, v, bytes);
    }
    for (int f = 0; f < mesh.face_count(); ++f) {
        bytes.push_back(3);
        bytes.append(reinterpret_cast<const char*>(mesh.faces.data() + 3 * f), 3 * sizeof(int));
        append_row(columns.face, f, bytes);
    }
    return bytes;
}

}  // namespace varimap
