#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace varimap {

/// The numbers of an .npy file: rows and columns, or a list, which is flat and has one column.
struct NpyArray {
    std::string type;  ///< as NumPy says it: "<f8", "<i4"
    bool flat = false;
    Eigen::MatrixXd values;
};

bool is_npy(std::string_view bytes);
/// Throws InputError, naming `path`, for more than two extents, types that are no real numbers, and files
/// that end too early.
NpyArray parse_npy(std::string_view bytes, const std::string& path);
/// The bytes of such a file, row by row.
std::string to_npy(const NpyArray& array);

}  // namespace varimap
