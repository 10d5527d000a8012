#pragma once

#include <sys/stat.h>

#include <string>

namespace varimap {

/// Of a file that is to be read. Throws IoError where there is none, or it is not a regular one.
struct stat regular_file_status(const std::string& path);

/// Whether an open file is still the one of that name: another process may have removed or renamed it.
bool is_named(int descriptor, const std::string& path);

/// Makes a folder, and those that hold it, where they are not there yet. Throws IoError.
void make_folder(const std::string& path);

}  // namespace varimap
