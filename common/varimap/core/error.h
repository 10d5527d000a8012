#pragma once

#include <stdexcept>
#include <string>

namespace varimap {

/// What a stage's process returns; the only place where exit codes are given their numbers.
enum class ExitCode : int {
    ok = 0,
    usage = 2,          ///< the command line
    bad_input = 3,      ///< a mesh or landmarks the method cannot serve
    bad_artifact = 4,   ///< incompatible, corrupt, or of the wrong lineage
    not_converged = 5,  ///< nothing was written
    input_output = 6,   ///< a file cannot be opened, read or written, or memory does not suffice
    internal = 70,      ///< a defect of varimap itself
};

/// A failure the user can act on. The message is one line: what, where, what to do.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

/// An option or a call that contradicts itself or what it is given.
struct UsageError : Error {
    explicit UsageError(const std::string& m) : Error(ExitCode::usage, m) {}
};
/// A mesh, landmarks or a table that cannot be served.
struct InputError : Error {
    explicit InputError(const std::string& m) : Error(ExitCode::bad_input, m) {}
};
/// An artifact that is damaged, incompatible or made from other inputs.
struct ArtifactError : Error {
    explicit ArtifactError(const std::string& m) : Error(ExitCode::bad_artifact, m) {}
};
/// An iteration that did not reach its tolerance.
struct ConvergenceError : Error {
    explicit ConvergenceError(const std::string& m) : Error(ExitCode::not_converged, m) {}
};
/// A file that cannot be opened, read or written, or too large for what holds it.
struct IoError : Error {
    explicit IoError(const std::string& m) : Error(ExitCode::input_output, m) {}
};

}  // namespace varimap
