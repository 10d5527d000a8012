// varimap_fuzz TARGET [--runs N] [--seed S] [--seconds T] [--cases FOLDER]
//     reads every file in FOLDER/TARGET, then makes N inputs and reads them, all in this process
// varimap_fuzz TARGET FILE...                               reads these
// varimap_fuzz --list                                       the targets
//
// An input that takes longer than 10 s of the processor (a stage: 60), or 100 s in all, ends the process,
// throws anything but an Error, or takes more memory than 400 times its length and the target's base (known
// under the address sanitizer only) is written to fuzz-TARGET-NUMBER, and the exit status is 1. Number N of
// seed S is the same input on every machine.

#include <fcntl.h>
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "fuzz/mutation.h"
#include "fuzz/target.h"
#include "varimap/core/error.h"

// Defined where a sanitizer is linked.
extern "C" {
__attribute__((weak)) void __sanitizer_set_death_callback(void (*)());
__attribute__((weak)) void __sanitizer_set_report_fd(void*);
__attribute__((weak)) int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*,
                                                                             std::size_t),
                                                                    void (*)(const volatile void*));
__attribute__((weak)) std::size_t __sanitizer_get_allocated_size(const volatile void*);
}

namespace varimap::fuzz {
namespace {

constexpr unsigned longest_seconds = 100;
constexpr std::size_t memory_factor = 400;

std::string current_input, current_name;
int messages = 2;  ///< where reports go; what the readers log goes nowhere
std::atomic<std::int64_t> allocated{0}, most_allocated{0};

/// The worst of all inputs so far.
struct {
    double seconds = 0;
    std::string slowest;
    std::size_t bytes = 0;
    double multiple = 0;  ///< bytes beyond the target's base by the input's length
} worst;
std::map<int, std::uint64_t> ends;  ///< how many inputs ended with each exit code

void say(const std::string& text) {
    [[maybe_unused]] const auto written = ::write(messages, text.data(), text.size());
}

void keep_input() {
    say("fuzz: the input is kept as " + current_name + "\n");
    const int file = ::open(current_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    [[maybe_unused]] const auto written = ::write(file, current_input.data(), current_input.size());
    ::close(file);
}

[[noreturn]] void fail(const std::string& why) {
    say("fuzz: " + why + "\n");
    keep_input();
    ::_exit(1);
}

void on_signal(int signal) {
    if (signal == SIGPROF) fail("an input takes too long");
    fail(signal == SIGALRM ? "an input takes longer than 100 s" : fmt::format("signal {}", signal));
}

/// Other work on the machine makes inputs late, not slow; but one that waits for something is caught, too.
void start_timers(unsigned cpu_seconds, unsigned seconds) {
    const itimerval timer{{0, 0}, {cpu_seconds, 0}};
    ::setitimer(ITIMER_PROF, &timer, nullptr);
    ::alarm(seconds);
}

void watch() {
    ::signal(SIGALRM, on_signal);
    ::signal(SIGPROF, on_signal);
    if (__sanitizer_set_death_callback) {
        __sanitizer_set_death_callback(keep_input);
    } else {
        for (const int s : {SIGSEGV, SIGABRT, SIGFPE, SIGILL, SIGBUS}) ::signal(s, on_signal);
    }
    if (__sanitizer_install_malloc_and_free_hooks)
        __sanitizer_install_malloc_and_free_hooks(
            [](const volatile void*, std::size_t size) {
                const std::int64_t now = allocated += std::int64_t(size);
                if (now > most_allocated) most_allocated = now;
            },
            [](const volatile void* at) { allocated -= std::int64_t(__sanitizer_get_allocated_size(at)); });
    messages = ::dup(2);
    if (__sanitizer_set_report_fd)
        __sanitizer_set_report_fd(reinterpret_cast<void*>(std::intptr_t(messages)));
    ::dup2(::open("/dev/null", O_WRONLY), 2);
}

/// Messages are one line without what steers a terminal.
void require_message(const std::string& message) {
    for (const char c : message)
        if (static_cast<unsigned char>(c) < ' ' || c == 127)
            fail("a message holds control characters: " + message);
    if (message.empty()) fail("a message is empty");
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void note_worst(const Target& target, const std::string& bytes, std::size_t taken, double seconds) {
    if (seconds > worst.seconds) worst.seconds = seconds, worst.slowest = current_name;
    worst.bytes = std::max(worst.bytes, taken);
    if (taken > target.memory_base && !bytes.empty())
        worst.multiple = std::max(worst.multiple, double(taken - target.memory_base) / double(bytes.size()));
}

void run_one(const Target& target, const std::string& bytes, const std::string& name) {
    current_input = bytes;
    current_name = name;
    start_timers(target.longest_cpu_seconds, longest_seconds);
    const auto start = Clock::now();
    const std::int64_t before = allocated;
    most_allocated = before;
    try {
        target.run(bytes);
        ++ends[0];
    } catch (const Error& error) {
        ++ends[int(error.code())];
        require_message(error.what());
        if (error.code() == ExitCode::internal) fail(error.what());
    } catch (const std::exception& error) {
        fail(std::string("an exception that is no Error: ") + error.what());
    }
    start_timers(0, 0);
    const auto taken = std::size_t(most_allocated - before);
    note_worst(target, bytes, taken, seconds_since(start));
    if (taken > target.memory_base + memory_factor * bytes.size())
        fail(fmt::format("{} bytes of memory for an input of {}", taken, bytes.size()));
}

std::vector<Target> all_targets() {
    std::vector<Target> all;
    for (const auto& list : {mesh_targets(), landmark_targets(), artifact_targets(), stage_targets(),
                             config_targets(), transfer_targets(),
#ifdef VARIMAP_HAS_IMPORT
                             import_targets()
#endif
         })
        all.insert(all.end(), list.begin(), list.end());
    return all;
}

struct Options {
    std::uint64_t runs = 1000, seed = 1;
    double seconds = 0;  ///< 0: until all runs are done
    std::string cases;
    std::vector<std::string> files;
};

Options parse(const std::vector<std::string>& words) {
    Options options;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool is_option = words[i].starts_with("--") && i + 1 < words.size();
        if (!is_option) {
            options.files.push_back(words[i]);
        } else if (words[i] == "--runs") {
            options.runs = std::stoull(words[++i]);
        } else if (words[i] == "--seed") {
            options.seed = std::stoull(words[++i]);
        } else if (words[i] == "--seconds") {
            options.seconds = std::stod(words[++i]);
        } else if (words[i] == "--cases") {
            options.cases = words[++i];
        }
    }
    return options;
}

std::string read_whole(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void run_cases(const Target& target, const std::filesystem::path& folder) {
    if (!std::filesystem::is_directory(folder / target.name)) return;
    for (const auto& entry : std::filesystem::directory_iterator(folder / target.name))
        run_one(target, read_whole(entry.path().string()), entry.path().filename().string());
}

void run_made(const Target& target, const Options& options) {
    const auto start = Clock::now();
    for (const std::string& seed : target.seeds) run_one(target, seed, "fuzz-" + target.name + "-seed");
    Mutator mutate(target.seeds, target.dictionary);
    std::uint64_t done = 0;
    for (; done < options.runs && (options.seconds == 0 || seconds_since(start) < options.seconds); ++done) {
        const std::uint64_t number = options.seed * 1'000'000'000 + done;
        run_one(target, target.forge ? target.forge(number) : mutate(number),
                fmt::format("fuzz-{}-{}", target.name, number));
    }
    fmt::print("{}: {} inputs from seed {} in {:.0f} s; the slowest, {}, {:.3f} s", target.name, done,
               options.seed, seconds_since(start), worst.slowest, worst.seconds);
    if (__sanitizer_install_malloc_and_free_hooks)
        fmt::print("; {:.1f} MB at most, {:.0f} bytes for each of the input's beyond the first {:.0f} MB",
                   double(worst.bytes) / (1 << 20), worst.multiple, double(target.memory_base) / (1 << 20));
    fmt::print("; exit codes");
    for (const auto& [code, count] : ends) fmt::print(" {}: {}", code, count);
    fmt::print("\n");
}

int run(const std::vector<std::string>& words) {
    watch();
    const std::vector<Target> targets = all_targets();
    const std::string name = words.empty() ? "--list" : words[0];
    if (name == "--list") {
        for (const Target& target : targets) fmt::print("{}\n", target.name);
        return 0;
    }
    const auto target =
        std::find_if(targets.begin(), targets.end(), [&](const Target& t) { return t.name == name; });
    if (target == targets.end()) {
        say(fmt::format("varimap_fuzz: no target '{}'; see --list\n", name));
        return 2;
    }
    const Options options = parse({words.begin() + 1, words.end()});
    using oneapi::tbb::global_control;
    const global_control one_thread(global_control::max_allowed_parallelism, 1);
    if (target->prepare) target->prepare();
    for (const std::string& file : options.files) run_one(*target, read_whole(file), file + ".again");
    if (options.files.empty()) {
        run_cases(*target, options.cases);
        run_made(*target, options);
    }
    return 0;
}

}  // namespace
}  // namespace varimap::fuzz

int main(int argc, char** argv) {
    return varimap::fuzz::run({argv + 1, argv + argc});
}
