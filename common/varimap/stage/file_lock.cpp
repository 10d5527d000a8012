#include "varimap/stage/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "varimap/artifact/file_status.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"

namespace varimap {
namespace {

void wait_for_lock(int descriptor, const std::string& name) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return;
    if (errno == EWOULDBLOCK) log("waiting for another run that holds '{}'", name);
    while (::flock(descriptor, LOCK_EX) != 0 && errno == EINTR) {
    }
}

}  // namespace

FileLock::FileLock(const std::string& path) : name_(path + ".lock") {
    for (;;) {
        descriptor_ = ::open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0)
            throw IoError("cannot write '" + name_ + "': " + std::generic_category().message(errno));
        wait_for_lock(descriptor_, name_);
        if (is_named(descriptor_, name_)) return;  // else the holder before has removed it
        ::close(descriptor_);
    }
}

bool FileLock::exists(const std::string& path) {
    return ::access((path + ".lock").c_str(), F_OK) == 0;
}

FileLock::~FileLock() {
    ::unlink(name_.c_str());  // before the lock goes, so that nobody can hold a removed file
    ::close(descriptor_);
}

}  // namespace varimap
