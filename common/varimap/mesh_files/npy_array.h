#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace varimap {

/// The numbers of an .npy file: rows and columns, or a list, which is flat and has one column.
struct NpyArray {
    std::string type;  ///< as NumPy says it: "<f8", "<i4"; little-endian, and float32 of a file of float16
    bool flat = false;
    std::string part_type;  ///< that of the numbers in `values`: `type`, where items are not parted
    int parts = 1;          ///< columns for each item
    Eigen::MatrixXd values;
};

/// What becomes of items that doubles do not hold: 64-bit integers are rounded and text is refused, or both
/// come in parts, low and high halves and letters.
enum class NpyItems : int { numbers, parted };

/// Whether the bytes begin as an .npy file does.
bool is_npy(std::string_view bytes);
/// Throws InputError, naming `path`, for more than two extents, types that are neither real numbers nor,
/// where they may be parted, text, and files that end too early.
NpyArray parse_npy(std::string_view bytes, const std::string& path, NpyItems items = NpyItems::numbers);
/// The bytes of such a file, row by row.
std::string to_npy(const NpyArray& array);

}  // namespace varimap
