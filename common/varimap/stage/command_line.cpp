#include "varimap/stage/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string_view>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/stage/parameter_text.h"
#include "varimap/stage/process.h"

namespace varimap {
namespace {

constexpr int most_threads = 4096;

/// One preset file serves all stages: entries in a section count only for the stage the section names.
class SectionOfStage : public CLI::ConfigTOML {
  public:
    explicit SectionOfStage(std::string stage) : stage_(std::move(stage)) {}
    std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
        std::vector<CLI::ConfigItem> kept;
        for (auto& item : CLI::ConfigTOML::from_config(input)) {
            if (item.name == "++" || item.name == "--") continue;  // CLI11's marks around a section
            if (!item.parents.empty() && item.parents.front() != stage_) continue;
            item.parents.clear();
            kept.push_back(std::move(item));
        }
        return kept;
    }

  private:
    std::string stage_;
};

std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n')
            c = ' ';
        else if (static_cast<unsigned char>(c) < ' ' || c == 127)
            c = '?';
    return text;
}

void add_parameter(CLI::App& app, const Parameter& parameter) {
    const std::string help =
        fmt::format("{} (default {}; {})", parameter.help, parameter.text(), allowed_values(parameter));
    app.add_option_function<std::string>(
           "--" + parameter.name, [&parameter](const std::string& text) { assign(parameter, text); }, help)
        ->take_last()
        ->type_name("VALUE")
        ->group("Parameters");
}

void add_positionals(CLI::App& app, CommandLine& line) {
    // --stale asks about files that exist, without naming what they would be made from.
    for (auto& file : line.positionals)
        app.add_option(file.name, file.value, file.help)->required(!line.asks_stale)->configurable(false);
    if (line.files)
        app.add_option(line.files->name, line.files->values, line.files->help)
            ->required(!line.asks_stale)
            ->configurable(false);
}

void add_options(CLI::App& app, CommandLine& line) {
    for (auto& option : line.options)
        app.add_option("--" + option.name, option.value, option.help)->take_last()->type_name("TEXT");
    for (auto& list : line.list_options)
        app.add_option("--" + list.name, list.values, list.help)
            ->expected(list.minimum, list.maximum)
            ->type_name("TEXT");
    for (auto& flag : line.flags) app.add_flag("--" + flag.name, flag.value, flag.help);
}

void add_common_options(CLI::App& app, CommandLine& line) {
    app.add_option("--threads", line.threads,
                   fmt::format("threads; results do not depend on it (default {}: the processors this "
                               "process may use; 1 to {})",
                               line.threads, most_threads))
        ->check(CLI::Range(1, most_threads))
        ->take_last()
        ->type_name("N");
    app.set_config("--config", "", "TOML file of options; a section counts for the stage it names")
        ->type_name("FILE");
    app.add_option("--stale", line.stale,
                   "print those of FILE... that exist and would be written differently now, and exit")
        ->expected(1, 1 << 20)
        ->configurable(false)
        ->type_name("FILE");
    app.set_version_flag("--version", "varimap-" + line.stage + " " + version());
}

bool mentions_stale(int argc, char** argv) {
    return std::any_of(argv + 1, argv + argc, [](std::string_view argument) {
        return argument == "--stale" || argument.starts_with("--stale=");
    });
}

}  // namespace

std::optional<std::string> CommandLine::parse(int argc, char** argv) {
    threads = available_threads();
    asks_stale = argc > 0 && mentions_stale(argc, argv);
    CLI::App app(summary, "varimap-" + stage);
    app.config_formatter(std::make_shared<SectionOfStage>(stage));
    app.allow_config_extras(CLI::config_extras_mode::error);
    for (const auto& parameter : parameters.all()) add_parameter(app, parameter);
    add_positionals(app, *this);
    add_options(app, *this);
    add_common_options(app, *this);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return app.help();
    } catch (const CLI::CallForVersion&) {
        return app.version() + "\n";
    } catch (const CLI::FileError& error) {
        throw IoError(one_line(error.what()));
    } catch (const CLI::ConfigError& error) {
        throw UsageError("--config: " + one_line(error.what()) + "; see varimap-" + stage + " --help");
    } catch (const CLI::ParseError& error) {
        throw UsageError(one_line(error.what()) + "; see varimap-" + stage + " --help");
    }
    return std::nullopt;
}

}  // namespace varimap
