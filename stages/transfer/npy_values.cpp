#include "stages/transfer/values.h"
#include "varimap/core/log.h"
#include "varimap/mesh_files/npy_array.h"

namespace varimap {

namespace {

constexpr double exact_integers = 9007199254740992;  // 2^53

bool holds_integers(const std::string& type) {
    return type.size() > 1 && (type[1] == 'i' || type[1] == 'u');
}

/// Weights are fractions, which integers and truth values do not hold.
std::string written_type(const std::string& type, ValueKind kind) {
    const bool fractions = type.size() > 1 && type[1] == 'f';
    return kind == ValueKind::weight && !fractions ? "<f8" : type;
}

}  // namespace

ValueFile parse_npy_values(std::string_view bytes, const std::string& path, ValueKind kind) {
    // Labels are compared and copied by row, so parts serve; numbers are interpolated, and rounded anyway.
    const auto items = kind == ValueKind::label ? NpyItems::parted : NpyItems::numbers;
    NpyArray array = parse_npy(bytes, path, items);
    if (kind == ValueKind::number && holds_integers(array.type) &&
        (array.values.array().abs() >= exact_integers).any())
        warn("{}: holds integers beyond 2^53, which are rounded; numbers that mean names are --labels", path);
    ValueTable table{Place::vertex, std::move(array.values)};
    if (array.parts > 1)
        table.label_columns.assign(std::size_t(table.values.cols() / array.parts), array.parts);
    const std::string written = written_type(array.type, kind);
    if (written != array.type) array.type = array.part_type = written;
    const auto write = [array](const std::vector<ValueTable>& tables, const TriangleMesh&) {
        return to_npy(NpyArray{array.type, array.flat, array.part_type, array.parts, tables[0].values});
    };
    return {{std::move(table)}, write};
}

}  // namespace varimap
