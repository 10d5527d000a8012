#pragma once

// Payloads of artifacts by cereal's portable binary archive. Include in .cpp files only. For a struct:
//
//   #include "varimap/artifact/cereal_eigen.h"
//   namespace varimap {
//   template <class Archive>
//   void serialize(Archive& archive, Basis& basis) { archive(basis.eigenvalues, basis.vectors); }
//   std::string encode(const Basis& basis) { return cereal_encode(basis); }
//   void decode(const std::string& payload, Basis& basis) { cereal_decode(payload, basis); }
//   }
//
// `serialize` stands in namespace varimap itself (not in an unnamed one: cereal finds it by
// argument-dependent lookup) and takes its struct by reference. Structs nested in it need a `serialize` too.
// Members may be numbers, bools, strings, vectors, pairs, arrays, optionals, dense Eigen matrices and vectors
// of numbers, and sparse ones. Checks that tie members to each other (equal lengths, indices in range) belong
// behind cereal_decode: throw ArtifactError there.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <cstdint>
#include <limits>
#include <sstream>
#include <streambuf>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "varimap/core/error.h"

namespace varimap {

/// Reads a payload in place, without a copy, and knows how much of it is left.
struct PayloadBuffer : std::streambuf {
    explicit PayloadBuffer(const std::string& payload) {
        char* begin = const_cast<char*>(payload.data());
        setg(begin, begin, begin + payload.size());
    }
    std::uint64_t left() const { return std::uint64_t(egptr() - gptr()); }
};

/// cereal's archive, from which reading can find out how much is left.
struct PayloadArchive : cereal::PortableBinaryInputArchive {
    PayloadArchive(std::istream& stream, const PayloadBuffer& payload)
        : cereal::PortableBinaryInputArchive(stream), buffer(payload) {}
    const PayloadBuffer& buffer;
};

}  // namespace varimap

namespace cereal {

inline void varimap_require(bool consistent) {
    if (!consistent) throw Exception("recorded sizes contradict each other");
}

/// Nothing is allocated for `count` elements that the rest of the payload cannot hold.
inline void varimap_require_left(PortableBinaryInputArchive& archive, std::uint64_t count,
                                 std::uint64_t size) {
    varimap_require(count <= dynamic_cast<varimap::PayloadArchive&>(archive).buffer.left() / size);
}

/// Takes precedence over cereal's own reading of the sizes of vectors and strings, which trusts them.
template <class T>
void CEREAL_SERIALIZE_FUNCTION_NAME(PortableBinaryInputArchive& archive, SizeTag<T>& tag) {
    archive(tag.size);
    varimap_require_left(archive, tag.size, 1);
}

/// A dense matrix: rows, columns, coefficients in its own storage order.
template <class Archive, class Scalar, int R, int C, int O, int MR, int MC>
std::enable_if_t<std::is_arithmetic_v<Scalar>> save(Archive& archive,
                                                    const Eigen::Matrix<Scalar, R, C, O, MR, MC>& matrix) {
    archive(std::int64_t(matrix.rows()), std::int64_t(matrix.cols()));
    archive(binary_data(matrix.data(), std::size_t(matrix.size()) * sizeof(Scalar)));
}

template <class Scalar, int R, int C, int O, int MR, int MC>
std::enable_if_t<std::is_arithmetic_v<Scalar>> load(PortableBinaryInputArchive& archive,
                                                    Eigen::Matrix<Scalar, R, C, O, MR, MC>& matrix) {
    std::int64_t rows = 0, columns = 0;
    archive(rows, columns);
    varimap_require(rows >= 0 && columns >= 0);
    varimap_require((R == Eigen::Dynamic || rows == R) && (C == Eigen::Dynamic || columns == C));
    // Rows first, so that the product below cannot overflow.
    varimap_require_left(archive, std::uint64_t(rows), columns > 0 ? sizeof(Scalar) : 1);
    if (rows > 0) varimap_require_left(archive, std::uint64_t(columns), std::uint64_t(rows) * sizeof(Scalar));
    matrix.resize(rows, columns);
    archive(binary_data(matrix.data(), std::size_t(matrix.size()) * sizeof(Scalar)));
}

/// A sparse matrix in compressed form: rows, columns, entries, then outer starts, inner indices and values.
template <class Archive, class Scalar, int O, class Index>
void save(Archive& archive, const Eigen::SparseMatrix<Scalar, O, Index>& matrix) {
    if (!matrix.isCompressed()) {
        auto compressed = matrix;
        compressed.makeCompressed();
        return save(archive, compressed);
    }
    const auto entries = std::size_t(matrix.nonZeros());
    archive(std::int64_t(matrix.rows()), std::int64_t(matrix.cols()), std::int64_t(entries));
    archive(binary_data(matrix.outerIndexPtr(), std::size_t(matrix.outerSize() + 1) * sizeof(Index)));
    archive(binary_data(matrix.innerIndexPtr(), entries * sizeof(Index)));
    archive(binary_data(matrix.valuePtr(), entries * sizeof(Scalar)));
}

/// Outer starts ascend from 0 to the number of entries; inner indices ascend within each row (or column).
template <class Matrix>
void require_valid_structure(const Matrix& matrix, std::int64_t entries) {
    const auto* outer = matrix.outerIndexPtr();
    const auto* inner = matrix.innerIndexPtr();
    varimap_require(outer[0] == 0 && outer[matrix.outerSize()] == entries);
    for (Eigen::Index row = 0; row < matrix.outerSize(); ++row) varimap_require(outer[row] <= outer[row + 1]);
    for (Eigen::Index row = 0; row < matrix.outerSize(); ++row)
        for (auto k = outer[row]; k < outer[row + 1]; ++k)
            varimap_require((k == outer[row] ? 0 <= inner[k] : inner[k - 1] < inner[k]) &&
                            inner[k] < matrix.innerSize());
}

template <class Scalar, int O, class Index>
void load(PortableBinaryInputArchive& archive, Eigen::SparseMatrix<Scalar, O, Index>& matrix) {
    constexpr std::int64_t limit = std::numeric_limits<Index>::max();
    std::int64_t rows = 0, columns = 0, entries = 0;
    archive(rows, columns, entries);
    varimap_require(rows >= 0 && columns >= 0 && entries >= 0);
    varimap_require(rows < limit && columns < limit && entries <= limit);
    const std::int64_t outer = (O & Eigen::RowMajor) ? rows : columns;
    varimap_require_left(archive, std::uint64_t(outer) + 1, sizeof(Index));
    varimap_require_left(archive, std::uint64_t(entries), sizeof(Index) + sizeof(Scalar));
    matrix.resize(rows, columns);
    matrix.resizeNonZeros(entries);
    archive(binary_data(matrix.outerIndexPtr(), std::size_t(matrix.outerSize() + 1) * sizeof(Index)));
    archive(binary_data(matrix.innerIndexPtr(), std::size_t(entries) * sizeof(Index)));
    archive(binary_data(matrix.valuePtr(), std::size_t(entries) * sizeof(Scalar)));
    require_valid_structure(matrix, entries);
}

}  // namespace cereal

namespace varimap {

/// The bytes of `value`: the same for equal values on every machine.
template <class T>
std::string cereal_encode(const T& value) {
    std::ostringstream stream(std::ios::binary);
    {
        cereal::PortableBinaryOutputArchive archive(
            stream, cereal::PortableBinaryOutputArchive::Options::LittleEndian());
        archive(value);
    }
    return std::move(stream).str();
}

/// The inverse of cereal_encode; every byte of `payload` must be used. Throws ArtifactError.
template <class T>
void cereal_decode(const std::string& payload, T& value) {
    try {
        PayloadBuffer buffer(payload);
        std::istream stream(&buffer);
        PayloadArchive archive(stream, buffer);
        archive(value);
        if (buffer.left() > 0) throw cereal::Exception("bytes are left over");
    } catch (const cereal::Exception& error) {
        std::string reason = error.what();
        throw ArtifactError("the payload of an artifact does not have its recorded form (" +
                            reason.substr(0, reason.find('\n')) + "); rerun the stage that wrote it");
    }
}

}  // namespace varimap
