#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace varimap {

/// What stands in front of the numbers of an .npy file (NumPy's format 1.0). `type` as NumPy says it: "<f8",
/// "<i4"; a shape without extents is one value.
std::string npy_header(const std::string& type, const std::vector<long long>& shape,
                       bool column_major = false);

/// An .npy file of a list of numbers, row by row.
template <class T>
std::string to_npy(const char* type, const std::vector<long long>& shape, const std::vector<T>& numbers) {
    return npy_header(type, shape) +
           std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
}

/// A zip archive of files (name, bytes), stored as they are, with the date 1980-01-01: the same bytes for the
/// same files. An .npz is one of .npy files. Throws IoError beyond 2 GB.
std::string to_zip(const std::vector<std::pair<std::string, std::string>>& files);

/// The files of a sparse matrix as SciPy's load_npz reads it (compressed rows): format, shape, data, indices,
/// indptr.
std::vector<std::pair<std::string, std::string>> csr_files(long long rows, long long columns,
                                                           const std::vector<double>& data,
                                                           const std::vector<int>& indices,
                                                           const std::vector<int>& indptr);

/// Whether the bytes begin as a zip archive does.
bool is_zip(std::string_view bytes);
/// The files of a zip archive by their names, stored or deflated. Throws InputError, naming `path`, for
/// archives that are damaged, encrypted, or of more than 4 GB.
std::map<std::string, std::string> from_zip(std::string_view bytes, const std::string& path);

}  // namespace varimap
