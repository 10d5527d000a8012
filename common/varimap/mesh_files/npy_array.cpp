#include "varimap/mesh_files/npy_array.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "varimap/artifact/npy.h"
#include "varimap/core/error.h"
#include "varimap/core/printable.h"
#include "varimap/mesh_files/number_type.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

bool is_npy(std::string_view bytes) {
    return bytes.starts_with("\x93NUMPY");
}

namespace {

/// Big-endian numbers; written they are little-endian.
template <class T>
NumberType reversed_type() {
    NumberType type = number_type<T>();
    type.read = [](const char* at) {
        std::array<char, sizeof(T)> bytes;
        std::reverse_copy(at, at + sizeof(T), bytes.begin());
        return number_type<T>().read(bytes.data());
    };
    return type;
}

/// IEEE 754's binary16.
double half_number(std::uint16_t bits) {
    const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
    using Limits = std::numeric_limits<double>;
    const double size = exponent == 0   ? std::ldexp(mantissa, -24)
                        : exponent < 31 ? std::ldexp(1024 + mantissa, exponent - 25)
                        : mantissa == 0 ? Limits::infinity()
                                        : Limits::quiet_NaN();
    return bits >> 15 == 0 ? size : -size;
}

/// Halves are read only.
NumberType half_type() {
    return {2,
            [](const char* at) { return half_number(std::uint16_t(number_type<std::uint16_t>().read(at))); },
            nullptr};
}

NumberType reversed_half_type() {
    return {
        2, [](const char* at) { return half_number(std::uint16_t(reversed_type<std::uint16_t>().read(at))); },
        nullptr};
}

/// What is written in place of a type that is only read.
std::string written_type(std::string type) {
    if (type.ends_with("f2")) return "<f4";
    if (type.starts_with('>')) type[0] = '<';
    return type;
}

const std::map<std::string, NumberType, std::less<>>& types() {
    static const std::map<std::string, NumberType, std::less<>> table{
        {"<f8", number_type<double>()},          {"<f4", number_type<float>()},
        {"|i1", number_type<std::int8_t>()},     {"|u1", number_type<std::uint8_t>()},
        {"|b1", number_type<std::uint8_t>()},    {"<i2", number_type<std::int16_t>()},
        {"<u2", number_type<std::uint16_t>()},   {"<i4", number_type<std::int32_t>()},
        {"<u4", number_type<std::uint32_t>()},   {"<i8", number_type<std::int64_t>()},
        {"<u8", number_type<std::uint64_t>()},   {"<f2", half_type()},
        {">f2", reversed_half_type()},           {">f8", reversed_type<double>()},
        {">f4", reversed_type<float>()},         {">i2", reversed_type<std::int16_t>()},
        {">u2", reversed_type<std::uint16_t>()}, {">i4", reversed_type<std::int32_t>()},
        {">u4", reversed_type<std::uint32_t>()}, {">i8", reversed_type<std::int64_t>()},
        {">u8", reversed_type<std::uint64_t>()}};
    return table;
}

/// The numbers that an item is read as.
struct ItemParts {
    std::string type;
    int count = 1;
    bool reversed = false;  ///< the last one comes first
};

/// None of types that are not read.
std::optional<ItemParts> parts_of(const std::string& type, NpyItems items) {
    const bool parted = items == NpyItems::parted, reversed = type.starts_with('>');
    if (parted && type.size() > 2 && (type[1] == 'U' || type[1] == 'S')) {
        constexpr long long most_letters = 1'000'000;
        long long letters;
        if (!to_integer(type.substr(2), letters) || letters < 1 || letters > most_letters) return {};
        return ItemParts{type[1] == 'S' ? "|u1" : reversed ? ">u4" : "<u4", int(letters)};
    }
    if (!types().contains(type)) return {};
    if (parted && (type.ends_with("i8") || type.ends_with("u8")))
        return ItemParts{reversed ? ">u4" : "<u4", 2, reversed};
    return ItemParts{type};
}

/// Rows and columns, or a list, which is flat.
struct NpyHeader {
    std::string type;
    bool column_major = false, flat = false;
    Eigen::Index rows = 0, columns = 1;
    std::size_t bytes = 0;  ///< where the numbers start
};

/// What stands behind `'key':` up to a comma, or, of a tuple, its inside.
std::string_view entry(std::string_view text, const std::string& key, const std::string& path) {
    const std::size_t at = text.find("'" + key + "':");
    if (at == text.npos) throw InputError(path + ": not an .npy file (its header has no " + key + ")");
    text.remove_prefix(std::min(text.size(), text.find_first_not_of(' ', at + key.size() + 3)));
    const bool tuple = text.starts_with('(');
    return tuple ? text.substr(1, text.find(')') - 1) : text.substr(0, text.find_first_of(",}"));
}

Eigen::Index extent(std::string_view text, const std::string& path) {
    const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
    long long value = 0;
    if (!to_integer(text.substr(begin), value) || value < 0 || value > std::numeric_limits<int>::max())
        throw InputError(path + ": its shape is not one of rows and columns");
    return Eigen::Index(value);
}

/// `12,` is a list; `12, 3` and `12, 3, ` are rows and columns.
void read_shape(std::string_view shape, const std::string& path, NpyHeader& header) {
    const std::size_t comma = std::min(shape.find(','), shape.size());
    header.rows = extent(shape.substr(0, comma), path);
    std::string_view rest = shape.substr(comma);
    rest = rest.substr(0, rest.find_last_not_of(" ,") + 1);
    header.flat = rest.empty();
    if (!header.flat) header.columns = extent(rest.substr(1), path);
}

NpyHeader read_npy_header(std::string_view bytes, const std::string& path) {
    if (!is_npy(bytes) || bytes.size() < 12) throw InputError(path + ": not an .npy file");
    const bool first_version = bytes[6] == 1;
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 8, first_version ? 2 : 4);
    NpyHeader header;
    header.bytes = std::size_t(first_version ? 10 : 12) + length;
    if (header.bytes > bytes.size()) throw InputError(path + ": the file ends within its header");
    const std::string_view text = bytes.substr(0, header.bytes);
    const std::string_view type = entry(text, "descr", path);
    if (type.size() > 2) header.type = type.substr(1, type.size() - 2);
    header.column_major = entry(text, "fortran_order", path).starts_with("True");
    read_shape(entry(text, "shape", path), path, header);
    return header;
}

ItemParts require_parts(const std::string& type, NpyItems items, const std::string& path) {
    if (const auto parts = parts_of(type, items)) return *parts;
    throw InputError(fmt::format("{}: has items of type {}; save it as {}", path, excerpt(type),
                                 items == NpyItems::parted ? "integers or text, such as array.astype(str)"
                                                           : "float64, float32 or integers"));
}

}  // namespace

NpyArray parse_npy(std::string_view bytes, const std::string& path, NpyItems items) {
    const NpyHeader header = read_npy_header(bytes, path);
    const ItemParts parts = require_parts(header.type, items, path);
    const NumberType& part = types().find(parts.type)->second;
    const int item_bytes = parts.count * part.bytes;
    const auto available = (bytes.size() - header.bytes) / std::size_t(item_bytes);
    if (header.columns == 0 || available / std::size_t(header.columns) < std::size_t(header.rows))
        throw InputError(path + ": the file ends before its last number, or has no columns");
    NpyArray array{written_type(header.type), header.flat, written_type(parts.type), parts.count,
                   Eigen::MatrixXd(header.rows, header.columns * parts.count)};
    for (Eigen::Index row = 0; row < header.rows; ++row)
        for (Eigen::Index column = 0; column < header.columns; ++column) {
            const auto at = header.column_major ? column * header.rows + row : row * header.columns + column;
            const char* item = bytes.data() + header.bytes + std::size_t(at) * std::size_t(item_bytes);
            for (int p = 0; p < parts.count; ++p)
                array.values(row, column * parts.count + p) =
                    part.read(item + (parts.reversed ? parts.count - 1 - p : p) * part.bytes);
        }
    return array;
}

std::string to_npy(const NpyArray& array) {
    const Eigen::MatrixXd& values = array.values;
    std::vector<long long> shape{values.rows()};
    if (!array.flat) shape.push_back(values.cols() / array.parts);
    const NumberType& type = types().find(array.part_type)->second;
    std::string bytes = npy_header(array.type, shape);
    for (Eigen::Index row = 0; row < values.rows(); ++row)
        for (Eigen::Index column = 0; column < values.cols(); ++column)
            type.append(values(row, column), bytes);
    return bytes;
}

}  // namespace varimap
