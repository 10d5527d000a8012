#include "varimap/core/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <mutex>

#include "varimap/core/logged.h"
#include "varimap/core/printable.h"

namespace varimap {
namespace {

/// spdlog's own default logger writes to stdout, which is for results.
spdlog::logger& logger() {
    static const auto instance = [] {
        auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
        auto made = std::make_shared<spdlog::logger>("varimap", std::move(sink));
        made->set_pattern("[varimap] %v");
        made->flush_on(spdlog::level::info);
        return made;
    }();
    return *instance;
}

class Kept {
  public:
    void add(const std::string& message) {
        const std::lock_guard lock(mutex_);
        messages_.push_back(message);
    }
    std::vector<std::string> messages() {
        const std::lock_guard lock(mutex_);
        return messages_;
    }

  private:
    std::mutex mutex_;
    std::vector<std::string> messages_;
};

Kept& notes() {
    static Kept instance;
    return instance;
}
Kept& warnings() {
    static Kept instance;
    return instance;
}

}  // namespace

void set_log_name(const std::string& name) {
    logger().set_pattern("[" + name + "] %v");
}

void log_message(const std::string& message) {
    logger().info(printable(message));
}

void log_note(const std::string& message) {
    logger().info("note: {}", printable(message));
    notes().add(message);
}

void log_warning(const std::string& message) {
    logger().warn("warning: {}", printable(message));
    warnings().add(message);
}

std::vector<std::string> logged_notes() {
    return notes().messages();
}

std::vector<std::string> logged_warnings() {
    return warnings().messages();
}

}  // namespace varimap
