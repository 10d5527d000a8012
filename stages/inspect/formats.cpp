#include "stages/inspect/formats.h"

#include <fmt/format.h>

#include <iterator>

#include "varimap/artifact/npy.h"

namespace varimap {

std::string to_npy(const ArrayView& array) {
    const bool real = std::holds_alternative<const double*>(array.data);
    std::string bytes =
        npy_header(real ? "<f8" : "<i4", {array.shape.begin(), array.shape.end()}, array.column_major);
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

std::string to_npz(const SparseMatrix& matrix) {
    std::vector<double> data;
    std::vector<int> indices, indptr{0};
    for (Eigen::Index row = 0; row < matrix.outerSize(); ++row) {
        for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry) {
            data.push_back(entry.value());
            indices.push_back(int(entry.col()));
        }
        indptr.push_back(int(data.size()));
    }
    return to_zip(csr_files(matrix.rows(), matrix.cols(), data, indices, indptr));
}

}  // namespace varimap
