#include "varimap/stage/process.h"

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace varimap {
namespace {

int affinity_count() {
    cpu_set_t set;
    CPU_ZERO(&set);
    // Fails on machines with more processors than the set has room for.
    if (sched_getaffinity(0, sizeof(set), &set) == 0) return std::max(1, CPU_COUNT(&set));
    return std::max(1, int(std::thread::hardware_concurrency()));
}

rusage usage_of_process() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage;
}

double seconds(const timeval& time) {
    return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
}

}  // namespace

int available_threads() {
    const int count = affinity_count();
    const char* text = std::getenv("SLURM_CPUS_PER_TASK");
    int slurm = 0;
    if (text != nullptr) std::from_chars(text, text + std::strlen(text), slurm);
    return slurm > 0 ? std::min(count, slurm) : count;
}

double cpu_seconds() {
    const rusage usage = usage_of_process();
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peak_megabytes() {
    return double(usage_of_process().ru_maxrss) / 1024;
}

}  // namespace varimap
