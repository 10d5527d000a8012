#include "varimap/mesh_files/ply_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include "varimap/mesh_files/polygon_soup.h"

namespace varimap {
namespace {

/// The text of a PLY file, part by part.
class PlyWriter {
  public:
    explicit PlyWriter(PlyFormat format) : ascii_(format == PlyFormat::ascii) {}

    /// most_corners: of a face.
    void header(std::size_t vertices, std::size_t faces, std::size_t most_corners, Space space,
                const PlyColumns& columns) {
        count_is_small_ = most_corners < 256;
        bytes_ = fmt::format(
            "ply\nformat {} 1.0\n{}"
            "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}"
            "element face {}\nproperty list {} int vertex_indices\n{}end_header\n",
            ascii_ ? "ascii" : "binary_little_endian",
            space == Space::unstated ? "" : fmt::format("comment {}\n", statement_of(space)), vertices,
            declarations(columns.vertex), faces, count_is_small_ ? "uchar" : "int",
            declarations(columns.face));
    }
    void vertex(const Vec3& x, const std::vector<PlyColumn>& columns, int row) {
        if (ascii_)
            bytes_ += fmt::format("{} {} {}", x[0], x[1], x[2]);
        else
            for (const double number : x) append(number);
        end_row(columns, row);
    }
    template <class Index>
    void face(std::span<const Index> corners, const std::vector<PlyColumn>& columns, int row) {
        if (ascii_)
            bytes_ += fmt::format("{}", corners.size());
        else if (count_is_small_)
            append(std::uint8_t(corners.size()));
        else
            append(std::int32_t(corners.size()));
        for (const Index corner : corners)
            if (ascii_)
                bytes_ += fmt::format(" {}", corner);
            else
                append(std::int32_t(corner));
        end_row(columns, row);
    }
    std::string take() { return std::move(bytes_); }

  private:
    static std::string declarations(const std::vector<PlyColumn>& columns) {
        std::string text;
        for (const PlyColumn& column : columns)
            text += fmt::format("property {} {}\n", column.type, column.name);
        return text;
    }
    template <class Number>
    void append(Number value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void end_row(const std::vector<PlyColumn>& columns, int row) {
        for (const PlyColumn& column : columns) {
            const double value = column.values[std::size_t(row)];
            if (ascii_)
                append_text(column.type, value);
            else
                ply_type(column.type)->append(value, bytes_);
        }
        if (ascii_) bytes_ += '\n';
    }
    /// A number as its type holds it, which reads back the same.
    void append_text(const std::string& type_name, double value) {
        std::string number;
        const NumberType& type = *ply_type(type_name);
        type.append(value, number);
        const double held = type.read(number.data());
        const bool single = type_name == "float" || type_name == "float32";
        bytes_ += single ? fmt::format(" {}", float(held)) : fmt::format(" {}", held);
    }

    bool ascii_, count_is_small_ = true;
    std::string bytes_;
};

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
    PlyWriter writer(format);
    writer.header(std::size_t(mesh.vertex_count()), std::size_t(mesh.face_count()), 3, mesh.space, columns);
    for (int v = 0; v < mesh.vertex_count(); ++v) writer.vertex(mesh.vertex(v), columns.vertex, v);
    for (int f = 0; f < mesh.face_count(); ++f)
        writer.face(std::span<const int>(mesh.faces.data() + 3 * f, 3), columns.face, f);
    return writer.take();
}

std::string to_ply(const PolygonSoup& soup, PlyFormat format) {
    std::size_t begin = 0, most = 0;
    for (const std::size_t end : soup.ends) most = std::max(most, end - std::exchange(begin, end));
    PlyWriter writer(format);
    writer.header(soup.points.size(), soup.ends.size(), most, soup.space, {});
    for (const Vec3& x : soup.points) writer.vertex(x, {}, 0);
    begin = 0;
    for (const std::size_t end : soup.ends) {
        writer.face(std::span<const long long>(soup.corners).subspan(begin, end - begin), {}, 0);
        begin = end;
    }
    return writer.take();
}

}  // namespace varimap
