#pragma once

#include <string>

namespace varimap {

/// While it lives no other process holds the lock on the file `path`; waits for one that does. The lock is a
/// file `path`.lock and ends with the process, however that ends; the next holder removes what a kill left.
/// Throws IoError where the file cannot be made. Where the file system knows no locks there is none: whole
/// files are renamed into place, so the cost is work done twice.
class FileLock {
  public:
    explicit FileLock(const std::string& path);
    ~FileLock();
    /// Whether there is such a file, held or left by a kill.
    static bool exists(const std::string& path);
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

  private:
    std::string name_;
    int descriptor_ = -1;
};

}  // namespace varimap
