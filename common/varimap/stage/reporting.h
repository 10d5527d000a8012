#pragma once

#include <functional>
#include <string>

namespace varimap {

/// Opens those of stdin, stdout and stderr that are closed, uselessly: the next file that is opened would be
/// given their place, and messages would go into it.
void open_standard_descriptors();

/// Writes to stdout. Throws IoError where the result does not arrive, in a closed pipe or on a full disk.
void print_result(const std::string& text);

/// Where failures are said: as `PROGRAM: error: MESSAGE` on stderr, or behind the exit code in a file.
struct ErrorReport {
    std::string program;
    const std::string& file;  ///< known only once the command line is read
    bool json = false;        ///< on stdout, too, as {"error": MESSAGE, "code": EXIT CODE}
};

/// Runs `run` and returns the exit code: the one place where failures become exit codes. `report` is read
/// afterwards.
int guarded(const ErrorReport& report, const std::function<void()>& run);

}  // namespace varimap
