#pragma once

#include <functional>
#include <string>

namespace varimap {

/// What a process of its own may use.
struct Limits {
    double seconds;    ///< of a core
    double gigabytes;  ///< of memory
};

/// Runs `task` in a process of its own and returns what it returns, so that code of others that crashes, runs
/// on or eats memory ends nothing else. Throws InputError with the message of what `task` threw, or, naming
/// `path`, with what happened to it. To be called before threads are started.
std::string run_isolated(const std::function<std::string()>& task, const Limits& limits,
                         const std::string& path);

}  // namespace varimap
