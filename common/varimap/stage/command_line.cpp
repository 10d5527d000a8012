#include "varimap/stage/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/printable.h"
#include "varimap/stage/config_file.h"
#include "varimap/stage/nearest_name.h"
#include "varimap/stage/parameter_text.h"
#include "varimap/stage/process.h"

namespace varimap {
namespace {

constexpr int most_threads = 4096;

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
    for (auto& file : line.positionals) app.add_option(file.name, file.value, file.help)->required();
    if (line.files) app.add_option(line.files->name, line.files->values, line.files->help)->required();
}

void add_options(CLI::App& app, CommandLine& line) {
    for (auto& option : line.options) {
        CLI::Option* added = app.add_option("--" + option.name, option.value, option.help)->type_name("TEXT");
        // Of two files one would be passed over.
        if (option.use != CommandLine::Use::input) added->take_last();
    }
    for (auto& list : line.list_options)
        app.add_option("--" + list.name, list.values, list.help)
            ->expected(list.minimum, list.maximum)
            ->type_name("TEXT");
    for (auto& flag : line.flags) app.add_flag("--" + flag.name, flag.value, flag.help);
}

/// What the question for parameters may hold besides these.
void add_parameter_options(CLI::App& app, CommandLine& line) {
    app.add_option("--config", line.config,
                   "TOML file of parameters; a section counts for the stage it names")
        ->take_last()
        ->type_name("FILE");
    app.add_flag("--parameters", line.asks_parameters,
                 "print the parameters that are not at their defaults, as options, and exit");
}

void add_common_options(CLI::App& app, CommandLine& line) {
    app.add_option("--threads", line.threads,
                   fmt::format("threads; results do not depend on it (default {}: the processors this "
                               "process may use; 1 to {})",
                               line.threads, most_threads))
        ->check(CLI::Range(1, most_threads))
        ->take_last()
        ->type_name("N");
    add_parameter_options(app, line);
    app.add_option(
           "--if-stale", line.if_stale,
           "do nothing where the output is what would be written now, from the same content of the inputs; "
           "FOLDER remembers their hashes by size and time")
        ->take_last()
        ->type_name("FOLDER");
    app.add_option("--stamp", line.stamp,
                   "file to write that tells --if-stale what outputs that are no artifacts were made from")
        ->take_last()
        ->type_name("FILE");
    app.add_option("--error-file", line.error_file,
                   "file to append \"CODE MESSAGE\" to when the stage fails, instead of saying it on stderr")
        ->take_last()
        ->type_name("FILE");
    app.add_option("--ran-file", line.ran_file,
                   "file to append the stage's name to when it had something to do")
        ->take_last()
        ->type_name("FILE");
    app.set_version_flag("--version", "varimap-" + line.stage + " " + version());
}

bool mentions(const std::vector<std::string>& arguments, const std::string& option) {
    return std::any_of(arguments.begin(), arguments.end(), [&](const std::string& argument) {
        return argument == option || argument.starts_with(option + "=");
    });
}

/// Dashes as underscores, so that spellings compare.
std::string spelling(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

/// Long names of all options, without their dashes.
std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const auto& name : option->get_lnames()) names.push_back(name);
    return names;
}

/// Replaces the dashes and underscores of long options by those they were declared with; all behind `--`
/// stays.
void use_declared_spelling(std::vector<std::string>& arguments, const CLI::App& app) {
    std::map<std::string, std::string> declared;
    for (const auto& name : option_names(app)) declared[spelling(name)] = name;
    for (auto& argument : arguments) {
        if (argument == "--") return;
        if (!argument.starts_with("--")) continue;
        const std::string given = argument.substr(2);
        const std::string name = given.substr(0, given.find('='));
        const auto known = declared.find(spelling(name));
        if (known != declared.end()) argument = "--" + known->second + given.substr(name.size());
    }
}

/// The value of the option `name` among arguments that may be refused.
std::string value_among(const std::vector<std::string>& arguments, const std::string& name) {
    std::string value;
    for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i)
        if (arguments[i].starts_with(name + "="))
            value = arguments[i].substr(name.size() + 1);
        else if (arguments[i] == name && i + 1 < arguments.size())
            value = arguments[i + 1];
    return value;
}

/// What CLI11 says, and which option may have been meant.
std::string explained(const CLI::ParseError& error, const std::vector<std::string>& arguments,
                      const CLI::App& app, const CommandLine& line) {
    const auto names = option_names(app);
    for (const auto& argument : arguments) {
        const std::string name = argument.substr(0, argument.find('='));
        if (!name.starts_with("--") || name == "--" || app.get_option_no_throw(name) != nullptr) continue;
        const std::string nearest = nearest_name(name.substr(2), names);
        if (line.asks_parameters)
            return fmt::format("{} is not a parameter{}", printable(name.substr(2)),
                               nearest.empty() ? "" : "; did you mean " + nearest + "?");
        if (!nearest.empty())
            return fmt::format("there is no option {}; did you mean --{}?", printable(name), nearest);
    }
    return one_line(error.what());
}

/// Values on the command line count more than those of the file.
void use_config(const CommandLine& line, const CLI::App& app) {
    std::map<std::string, std::string> given;
    for (const auto& parameter : line.parameters.all())
        if (app.count("--" + parameter.name) > 0) given[parameter.name] = parameter.text();
    assign_config(line.config, line.stage, line.parameters);
    for (const auto& parameter : line.parameters.all())
        if (given.contains(parameter.name)) assign(parameter, given[parameter.name]);
}

std::string changed_parameters(const CommandLine& line,
                               const std::vector<std::pair<std::string, std::string>>& defaults) {
    const auto now = line.parameters.resolved();
    std::vector<std::string> changed;
    for (std::size_t i = 0; i < now.size(); ++i)
        if (now[i] != defaults[i]) changed.push_back("--" + now[i].first + " " + now[i].second);
    return changed.empty() ? "" : fmt::format("{}\n", fmt::join(changed, " "));
}

}  // namespace

std::optional<std::string> CommandLine::parse(int argc, char** argv) {
    const auto defaults = parameters.resolved();
    std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    threads = available_threads();
    asks_parameters = mentions(arguments, "--parameters");
    CLI::App app(summary, "varimap-" + stage);
    app.footer("Names of options may be written with dashes or underscores.");
    for (const auto& parameter : parameters.all()) add_parameter(app, parameter);
    if (asks_parameters) {
        add_parameter_options(app, *this);
    } else {
        add_positionals(app, *this);
        add_options(app, *this);
        add_common_options(app, *this);
    }
    use_declared_spelling(arguments, app);
    error_file = value_among(arguments, "--error-file");
    try {
        app.parse(
            std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 takes the last first
    } catch (const CLI::CallForHelp&) {
        return app.help();
    } catch (const CLI::CallForVersion&) {
        return app.version() + "\n";
    } catch (const CLI::ParseError& error) {
        throw UsageError(explained(error, arguments, app, *this) + "; see varimap-" + stage + " --help");
    }
    if (!config.empty()) use_config(*this, app);
    if (asks_parameters) return changed_parameters(*this, defaults);
    return std::nullopt;
}

std::vector<std::pair<std::string, std::string>> CommandLine::input_files() const {
    std::vector<std::pair<std::string, std::string>> result;
    const auto add = [&](const Text& text) {
        if (text.use == Use::input && !text.value.empty()) result.emplace_back(text.name, text.value);
    };
    const auto add_list = [&](const TextList& list) {
        const auto& given = list.values;
        for (std::size_t i = 0; i < given.size() && list.use == Use::input; ++i)
            result.emplace_back(given.size() == 1 ? list.name : list.name + "." + char('A' + i % 26),
                                given[i]);
    };
    for (const auto& text : positionals) add(text);
    if (files) add_list(*files);
    for (const auto& text : options) add(text);
    for (const auto& list : list_options) add_list(list);
    return result;
}

}  // namespace varimap
