#include "stages/inspect/formats.h"

#include <fmt/format.h>

#include <bit>
#include <iterator>

namespace varimap {

static_assert(std::endian::native == std::endian::little, "to_npy writes memory as it is");

std::string to_npy(const ArrayView& array) {
    const bool real = std::holds_alternative<const double*>(array.data);
    std::string shape;
    for (const auto extent : array.shape) shape += fmt::format("{}, ", extent);
    std::string text = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': ({}), }}",
                                   real ? "<f8" : "<i4", array.column_major ? "True" : "False", shape);
    // Ten bytes go before the text; together with it and a line break they fill a multiple of 64.
    text.append(63 - (10 + text.size()) % 64, ' ');
    text += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += char(text.size() % 256);
    bytes += char(text.size() / 256);
    bytes += text;
    std::visit(
        [&](const auto* data) {
            if (array.size() > 0)
                bytes.append(reinterpret_cast<const char*>(data), std::size_t(array.size()) * sizeof(*data));
        },
        array.data);
    return bytes;
}

std::string to_matrix_market(const SparseMatrix& matrix) {
    std::string text = "%%MatrixMarket matrix coordinate real general\n";
    auto out = std::back_inserter(text);
    fmt::format_to(out, "{} {} {}\n", matrix.rows(), matrix.cols(), matrix.nonZeros());
    for (Eigen::Index row = 0; row < matrix.outerSize(); ++row)
        for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry)
            fmt::format_to(out, "{} {} {}\n", entry.row() + 1, entry.col() + 1, entry.value());
    return text;
}

}  // namespace varimap
