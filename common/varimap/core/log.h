#pragma once

#include <fmt/format.h>

#include <string>

namespace varimap {

/// Name shown in front of every log line; stage_main sets it.
void set_log_name(const std::string& name);

/// Writes "[stage] message" to stderr. stdout is for results only.
void log_message(const std::string& message);
/// The same, kept for the run file besides (logged.h): a note is what users should know of, such as a repair
/// that changes nothing, a warning what makes a result doubtful until somebody has looked.
void log_note(const std::string& message);
void log_warning(const std::string& message);

/// The same of formatted text (fmt).
template <class... Args>
void log(fmt::format_string<Args...> format, Args&&... args) {
    log_message(fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void note(fmt::format_string<Args...> format, Args&&... args) {
    log_note(fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
    log_warning(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace varimap
