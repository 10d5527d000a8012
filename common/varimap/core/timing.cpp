#include "varimap/core/timing.h"

#include <time.h>

#include <mutex>

namespace varimap {
namespace {

struct TimedParts {
    std::mutex mutex;
    std::map<std::string, double> seconds;
};

TimedParts& parts() {
    static TimedParts instance;
    return instance;
}

/// Unlike wall time, the same on a busy machine.
double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

}  // namespace

Timer::Timer(const char* part) : part_(part), start_(thread_seconds()) {}

Timer::~Timer() {
    const double passed = thread_seconds() - start_;
    const std::lock_guard lock(parts().mutex);
    parts().seconds[part_] += passed;
}

std::map<std::string, double> timed_parts() {
    const std::lock_guard lock(parts().mutex);
    return parts().seconds;
}

}  // namespace varimap
