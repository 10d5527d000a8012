#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "varimap/artifact/artifact.h"
#include "varimap/artifact/file_status.h"
#include "varimap/artifact/hash.h"
#include "varimap/artifact/temporaries.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

constexpr std::size_t chunk = 1 << 20;

IoError io_error(const std::string& doing, const std::string& path, int code = errno) {
    return IoError("cannot " + doing + " '" + path + "': " + std::generic_category().message(code));
}

/// Owns a file descriptor.
struct File {
    int descriptor;
    explicit File(int d) : descriptor(d) {}
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File() {
        if (descriptor >= 0) ::close(descriptor);
    }
    int release() { return std::exchange(descriptor, -1); }
};

/// Calls consume(bytes, count) with the file piece by piece.
template <class Consume>
void read_pieces(const std::string& path, Consume consume) {
    File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.descriptor < 0) throw io_error("open", path);
    std::vector<char> buffer(chunk);
    for (;;) {
        const ssize_t count = ::read(file.descriptor, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw io_error("read", path);
        if (count == 0) return;
        consume(buffer.data(), std::size_t(count));
    }
}

void write_all(int descriptor, const std::string& bytes, const std::string& path) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::write(descriptor, bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw io_error("write", path);
        done += std::size_t(count);
    }
}

/// Temporary files beside `path` have small numbers, so that those that a kill left are found without reading
/// the folder: of a collection it holds a million files.
std::string temporary_name(const std::string& path, int number) {
    return path + ".tmp." + std::to_string(number);
}
constexpr int most_temporaries = 16;  // that are looked for; one for each writer at a time

/// Its writer may have renamed it, and another begun one of the same name.
void remove_if_dead(const std::string& path) {
    const File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (file.descriptor >= 0 && ::flock(file.descriptor, LOCK_EX | LOCK_NB) == 0 &&
        is_named(file.descriptor, path))
        ::unlink(path.c_str());
}

/// A new file beside `path` under a name nobody else uses; removed again unless it is renamed to `path`.
/// Locked as long as its writer lives, which tells it from one that a kill left.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& path) : path_(path), file_(-1) {
        do open_new();
        while (is_lost());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (!name_.empty()) ::unlink(name_.c_str());
    }
    int descriptor() const { return file_.descriptor; }
    void become_target() {
        if (::fsync(file_.descriptor) != 0 && errno != EINVAL) throw io_error("write", path_);
        // Still locked: else another might take it for a dead one, and its name for a file of its own.
        if (::rename(name_.c_str(), path_.c_str()) != 0) throw io_error("write", path_);
        name_.clear();
    }

  private:
    void open_new() {
        if (file_.descriptor >= 0) ::close(file_.release());
        int number = 0;
        do {
            name_ = temporary_name(path_, number++);
            file_.descriptor = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        } while (file_.descriptor < 0 && errno == EEXIST);
        if (file_.descriptor < 0) throw io_error("write", path_);
    }
    /// Taken for a dead one, and removed, before it was locked.
    bool is_lost() const {
        if (::flock(file_.descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return true;
        struct stat status;
        return ::fstat(file_.descriptor, &status) == 0 && status.st_nlink == 0;
    }

    std::string path_, name_;
    File file_;
};

void require_replaceable(const std::string& path) {
    struct stat status;
    if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
        throw IoError("cannot write '" + path + "': it is there and not a regular file");
}

/// Makes the rename itself survive a power failure, where the file system can.
void flush_folder_of(const std::string& path) {
    const auto parent = std::filesystem::path(path).parent_path();
    File folder(::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.descriptor >= 0) ::fsync(folder.descriptor);
}

}  // namespace

std::string content_hash(const std::string& bytes) {
    Hasher hasher;
    hasher.add(bytes.data(), bytes.size());
    return hasher.hexadecimal();
}

std::string file_hash(const std::string& path) {
    Hasher hasher;
    read_pieces(path, [&](const char* bytes, std::size_t count) { hasher.add(bytes, count); });
    return hasher.hexadecimal();
}

std::string read_file(const std::string& path) {
    std::string bytes;
    struct stat status;
    if (::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode))
        bytes.reserve(std::size_t(status.st_size));
    read_pieces(path, [&](const char* piece, std::size_t count) { bytes.append(piece, count); });
    return bytes;
}

void write_file_atomically(const std::string& path, const std::string& bytes) {
    require_replaceable(path);
    TemporaryFile temporary(path);
    write_all(temporary.descriptor(), bytes, path);
    temporary.become_target();
    flush_folder_of(path);
}

void remove_dead_temporaries(const std::string& path) {
    for (int number = 0; number < most_temporaries; ++number) remove_if_dead(temporary_name(path, number));
}

}  // namespace varimap
