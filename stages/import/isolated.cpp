#include "stages/import/isolated.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <new>
#include <stdexcept>
#include <utility>

#include "varimap/core/error.h"

namespace varimap {
namespace {

/// The first byte of what the process says.
constexpr char done = 'd', refused = 'r', no_memory = 'm';

void limit(decltype(RLIMIT_AS) resource, double amount) {
    rlimit current;
    if (::getrlimit(resource, &current) != 0) return;
    const auto wanted = rlim_t(std::ceil(amount));
    if (current.rlim_max != RLIM_INFINITY && current.rlim_max < wanted) return;
    // One more, so that a process beyond its seconds gets the signal that says so before it is killed.
    const rlimit lower{wanted, std::min(wanted + 1, current.rlim_max)};
    ::setrlimit(resource, &lower);
}

void write_all(int descriptor, const std::string& bytes) {
    for (std::size_t written = 0; written < bytes.size();) {
        const ssize_t count = ::write(descriptor, bytes.data() + written, bytes.size() - written);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return;
        written += std::size_t(count);
    }
}

std::string read_all(int descriptor) {
    std::string bytes;
    std::string buffer(1 << 20, '\0');
    for (;;) {
        const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return bytes;
        bytes.append(buffer, 0, std::size_t(count));
    }
}

std::string answer_of(const std::function<std::string()>& task) {
    try {
        return done + task();
    } catch (const std::bad_alloc&) {
        return {no_memory};
    } catch (const std::length_error&) {
        return {no_memory};
    } catch (const std::exception& error) {
        return refused + std::string(error.what());
    }
}

[[noreturn]] void run_child(const std::function<std::string()>& task, const Limits& limits, int descriptor) {
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.seconds);
#ifndef __SANITIZE_ADDRESS__  // which reserves far more than it uses
    limit(RLIMIT_AS, limits.gigabytes * 1e9);
#endif
    for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGTERM, SIGINT})
        ::signal(signal, SIG_DFL);
    write_all(descriptor, answer_of(task));
    ::_exit(0);
}

}  // namespace

std::string run_isolated(const std::function<std::string()>& task, const Limits& limits,
                         const std::string& path) {
    int ends[2];
    if (::pipe(ends) != 0) throw IoError(path + ": no process can be started to read it");
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(ends[0]);
        run_child(task, limits, ends[1]);
    }
    ::close(ends[1]);
    if (child < 0) {
        ::close(ends[0]);
        throw IoError(path + ": no process can be started to read it");
    }
    std::string answer = read_all(ends[0]);
    ::close(ends[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    constexpr const char* advice = "save it from the program that made it, or from Blender, as OBJ or PLY";
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        throw InputError(
            fmt::format("{}: reading it takes more than {:.0f} s; {}", path, limits.seconds, advice));
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
        throw InputError(fmt::format("{}: reading it was killed (out of memory?)", path));
    if (WIFSIGNALED(status) || answer.empty() || WEXITSTATUS(status) != 0)
        throw InputError(
            fmt::format("{}: the library that reads such files crashed on it; {}", path, advice));
    const char kind = answer[0];
    answer.erase(0, 1);
    if (kind == refused) throw InputError(answer);
    if (kind == no_memory)
        throw InputError(
            fmt::format("{}: reading it takes more than {:.1f} GB; {}", path, limits.gigabytes, advice));
    return answer;
}

}  // namespace varimap
