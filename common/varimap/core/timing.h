#pragma once

#include <map>
#include <string>

namespace varimap {

/// Adds the CPU seconds that its thread spends while it lives to those of the part of the program of that
/// name. What runs side by side counts for each; results must not depend on it. Thread-safe.
class Timer {
  public:
    explicit Timer(const char* part);
    ~Timer();
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

  private:
    const char* part_;
    double start_;
};

/// CPU seconds by part, of all timers that have ended so far in this process.
std::map<std::string, double> timed_parts();

}  // namespace varimap
