#include "varimap/artifact/file_status.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "varimap/core/error.h"

namespace varimap {

struct stat regular_file_status(const std::string& path) {
    struct stat status;
    if (::stat(path.c_str(), &status) != 0)
        throw IoError("cannot open '" + path + "': " + std::generic_category().message(errno));
    if (!S_ISREG(status.st_mode)) throw IoError("cannot read '" + path + "': not a regular file");
    return status;
}

bool is_named(int descriptor, const std::string& path) {
    struct stat open, named;
    return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &named) == 0 &&
           open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

void make_folder(const std::string& path) {
    std::error_code failure;
    std::filesystem::create_directories(path, failure);
    if (failure) throw IoError("cannot make the folder '" + path + "': " + failure.message());
}

}  // namespace varimap
