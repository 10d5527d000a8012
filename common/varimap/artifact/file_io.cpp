#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "varimap/artifact/artifact.h"
#include "varimap/artifact/hash.h"
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

/// A new file beside `path` under a name nobody else uses; removed again unless it is renamed to `path`.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& path) : path_(path), file_(-1) {
        static std::atomic<unsigned> counter{0};
        do {
            name_ = path + ".tmp." + std::to_string(::getpid()) + "." + std::to_string(counter++);
            file_.descriptor = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        } while (file_.descriptor < 0 && errno == EEXIST);
        if (file_.descriptor < 0) throw io_error("write", path);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (!name_.empty()) ::unlink(name_.c_str());
    }
    int descriptor() const { return file_.descriptor; }
    void become_target() {
        if (::fsync(file_.descriptor) != 0 && errno != EINVAL) throw io_error("write", path_);
        if (::close(file_.release()) != 0) throw io_error("write", path_);
        if (::rename(name_.c_str(), path_.c_str()) != 0) throw io_error("write", path_);
        name_.clear();
    }

  private:
    std::string path_, name_;
    File file_;
};

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
    TemporaryFile temporary(path);
    write_all(temporary.descriptor(), bytes, path);
    temporary.become_target();
    flush_folder_of(path);
}

}  // namespace varimap
