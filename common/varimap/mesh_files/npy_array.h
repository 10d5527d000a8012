#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace varimap {

/// The numbers of an .npy file: rows and columns, or a list, which is flat and has one column.
struct NpyArray {
    std::string type;  ///< as NumPy says it: "<f8", "<i4"; little-endian, and float32 of a file of float16
    bool flat = false;
    bool halved = false;  ///< two columns for each number: the low and the high half of a 64-bit integer
    Eigen::MatrixXd values;
};

/// What becomes of 64-bit integers, which doubles do not hold exactly.
enum class WideIntegers : int { rounded, halved };

/// Whether the bytes begin as an .npy file does.
bool is_npy(std::string_view bytes);
/// Throws InputError, naming `path`, for more than two extents, types that are no real numbers, and files
/// that end too early.
NpyArray parse_npy(std::string_view bytes, const std::string& path,
                   WideIntegers wide = WideIntegers::rounded);
/// The bytes of such a file, row by row.
std::string to_npy(const NpyArray& array);

}  // namespace varimap
