#include "varimap/core/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <mutex>

#include "varimap/core/printable.h"
#include "varimap/core/warnings.h"

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

struct Warnings {
    std::mutex mutex;
    std::vector<std::string> list;
};

Warnings& warnings() {
    static Warnings instance;
    return instance;
}

}  // namespace

void set_log_name(const std::string& name) {
    logger().set_pattern("[" + name + "] %v");
}

void log_message(const std::string& message) {
    logger().info(printable(message));
}

void log_warning(const std::string& message) {
    logger().warn("warning: {}", printable(message));
    const std::lock_guard lock(warnings().mutex);
    warnings().list.push_back(message);
}

std::vector<std::string> logged_warnings() {
    const std::lock_guard lock(warnings().mutex);
    return warnings().list;
}

}  // namespace varimap
