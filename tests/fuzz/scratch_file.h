#pragma once

#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace varimap::fuzz {

/// A file for readers that take a path, in memory where the system has such a place.
class ScratchFile {
  public:
    ScratchFile(const std::string& bytes, const std::string& ending)
        : path_((::access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp") + std::string("/varimap-fuzz-") +
                std::to_string(::getpid()) + ending) {
        if (!(std::ofstream(path_, std::ios::binary) << bytes))
            throw std::runtime_error("cannot write " + path_);
    }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ~ScratchFile() { ::unlink(path_.c_str()); }
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

}  // namespace varimap::fuzz
