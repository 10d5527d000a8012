#include "varimap/stage/reporting.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <system_error>

#include "varimap/core/error.h"
#include "varimap/core/printable.h"

namespace varimap {
namespace {

/// Whether all of it was written.
bool append(const std::string& path, const std::string& text) {
    std::FILE* file = std::fopen(path.c_str(), "ae");
    if (file == nullptr) return false;
    const bool written = std::fputs(text.c_str(), file) >= 0;
    return std::fclose(file) == 0 && written;
}

/// stderr may be closed, which is no reason to fail in another way.
int say(const ErrorReport& report, ExitCode code, const std::string& message) {
    const std::string text = fmt::format("{}: error: {}\n", report.program, printable(message));
    if (report.file.empty() || !append(report.file, fmt::format("{} {}", int(code), text)))
        std::fputs(text.c_str(), stderr);
    if (report.json) {
        const nlohmann::ordered_json told{{"error", printable(message)}, {"code", int(code)}};
        std::puts(told.dump().c_str());
    }
    return int(code);
}

[[noreturn]] void end_after_defect() {
    std::fputs("varimap: error: internal: an exception nobody caught\n", stderr);
    std::_Exit(int(ExitCode::internal));
}

}  // namespace

void open_standard_descriptors() {
    for (const int descriptor : {0, 1, 2})
        if (::fcntl(descriptor, F_GETFD) < 0)
            // Not for the use it has, so that a result that cannot be written is still an error.
            (void)!::open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY);
}

void print_result(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
        throw IoError("cannot write to standard output");
}

int guarded(const ErrorReport& report, const std::function<void()>& run) {
    std::set_terminate(end_after_defect);
    try {
        run();
        return int(ExitCode::ok);
    } catch (const Error& error) {
        return say(report, error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return say(report, ExitCode::input_output,
                   "out of memory; use a smaller mesh or a machine with more");
    } catch (const std::system_error& error) {
        return say(report, ExitCode::input_output, error.what());
    } catch (const std::exception& error) {
        return say(report, ExitCode::internal, std::string("internal: ") + error.what());
    } catch (...) {
        return say(report, ExitCode::internal, "internal: unknown exception");
    }
}

}  // namespace varimap
