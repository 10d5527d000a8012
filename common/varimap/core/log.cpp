#include "varimap/core/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

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

}  // namespace

void set_log_name(const std::string& name) {
    logger().set_pattern("[" + name + "] %v");
}

void log_message(const std::string& message) {
    logger().info(message);
}

void log_warning(const std::string& message) {
    logger().warn("warning: {}", message);
}

}  // namespace varimap
