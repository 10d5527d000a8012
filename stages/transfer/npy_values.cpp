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
    // Labels are compared and copied by row, so halves serve; numbers are interpolated, and rounded anyway.
    const auto wide = kind == ValueKind::label ? WideIntegers::halved : WideIntegers::rounded;
    NpyArray array = parse_npy(bytes, path, wide);
    if (kind == ValueKind::number && holds_integers(array.type) &&
        (array.values.array().abs() >= exact_integers).any())
        warn("{}: holds integers beyond 2^53, which are rounded; numbers that mean names are --labels", path);
    ValueTable table{Place::vertex, std::move(array.values)};
    if (array.halved) table.label_columns.assign(std::size_t(table.values.cols()) / 2, 2);
    array.type = written_type(array.type, kind);
    const auto write = [array](const std::vector<ValueTable>& tables, const TriangleMesh&) {
        return to_npy(NpyArray{array.type, array.flat, array.halved, tables[0].values});
    };
    return {{std::move(table)}, write};
}

}  // namespace varimap
