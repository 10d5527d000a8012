#include "varimap/stage/config_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/printable.h"
#include "varimap/core/trimmed.h"
#include "varimap/stage/known_hashes.h"
#include "varimap/stage/nearest_name.h"
#include "varimap/stage/parameter_text.h"

namespace varimap {
namespace {

/// Nothing but blanks and a comment.
bool is_empty(std::string_view text) {
    const std::string_view rest = trimmed(text);
    return rest.empty() || rest.front() == '#';
}

bool is_name(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::string_view("-_").find(char(c)) != std::string_view::npos || (c < 128 && std::isalnum(c));
    });
}

std::string_view unquoted(std::string_view text) {
    const bool quoted =
        text.size() >= 2 && text.front() == text.back() && (text.front() == '"' || text.front() == '\'');
    return quoted ? text.substr(1, text.size() - 2) : text;
}

/// The value at the start of `text`, before a comment; nothing where there is none, or more than one.
std::optional<std::string> parse_value(std::string_view text) {
    const char quote = text.empty() ? ' ' : text.front();
    if (quote == '"' || quote == '\'') {
        const auto end = text.find(quote, 1);
        if (end == text.npos || !is_empty(text.substr(end + 1))) return {};
        return std::string(text.substr(1, end - 1));
    }
    const std::string_view value = trimmed(text.substr(0, text.find('#')));
    if (value.empty() || value.find_first_of(" \t\"'[]{},=") != value.npos) return {};
    return std::string(value);
}

/// The section that a line `[SECTION]` begins.
std::optional<std::string> parse_section(std::string_view text) {
    const auto end = text.find(']');
    if (end == text.npos || !is_empty(text.substr(end + 1))) return {};
    const std::string_view name = unquoted(trimmed(text.substr(1, end - 1)));
    return is_name(name) ? std::optional<std::string>(name) : std::nullopt;
}

/// An entry `NAME = VALUE` or `SECTION.NAME = VALUE`.
std::optional<ConfigLine> parse_entry(std::string_view text, std::string_view section) {
    const auto equals = text.find('=');
    if (equals == text.npos) return {};
    const auto value = parse_value(trimmed(text.substr(equals + 1)));
    std::string_view name = trimmed(text.substr(0, equals)), within = section;
    if (const auto dot = name.find('.'); dot != name.npos && section.empty()) {
        within = unquoted(trimmed(name.substr(0, dot)));
        name = trimmed(name.substr(dot + 1));
    }
    name = unquoted(name);
    if (!value || !is_name(name) || (!within.empty() && !is_name(within))) return {};
    ConfigLine line{0, std::string(within), std::string(name), *value};
    std::replace(line.name.begin(), line.name.end(), '-', '_');
    return line;
}

[[noreturn]] void refuse(const std::string& path, int line, const std::string& reason) {
    throw UsageError(fmt::format("{}, line {}: {}", path, line, reason));
}

std::string suggestion(const std::string& name, const std::vector<std::string>& names) {
    const std::string nearest = nearest_name(name, names);
    return nearest.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                           : fmt::format("did you mean {}?", nearest);
}

const Parameter& find_parameter(const ConfigLine& line, const std::string& path, const std::string& stage,
                                const ParameterList& parameters) {
    std::vector<std::string> names;
    for (const auto& parameter : parameters.all()) {
        if (parameter.name == line.name) return parameter;
        names.push_back(parameter.name);
    }
    refuse(path, line.number,
           fmt::format("varimap-{} has no parameter {}; {}", stage, printable(line.name),
                       suggestion(line.name, names)));
}

void assign_line(const ConfigLine& line, const std::string& path, const std::string& stage,
                 const ParameterList& parameters) {
    const auto& stages = stage_names();
    const bool own = line.section.empty() || line.section == stage;
    if (!own && std::find(stages.begin(), stages.end(), line.section) == stages.end())
        refuse(path, line.number,
               fmt::format("no stage is called {}; {}", printable(line.section),
                           suggestion(line.section, stages)));
    if (!own || line.name.empty()) return;
    const Parameter& parameter = find_parameter(line, path, stage, parameters);
    try {
        assign(parameter, line.value);
    } catch (const UsageError& error) {
        refuse(path, line.number, error.what());
    }
}

}  // namespace

std::vector<ConfigLine> parse_config(const std::string& text, const std::string& path) {
    std::istringstream stream(text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text);
    std::vector<ConfigLine> lines;
    std::set<std::pair<std::string, std::string>> seen;
    std::string line, section;
    for (int number = 1; std::getline(stream, line); ++number) {
        if (is_empty(line)) continue;
        const std::string_view content = trimmed(line);
        std::optional<ConfigLine> parsed;
        if (content.front() != '[')
            parsed = parse_entry(content, section);
        else if (const auto head = parse_section(content))
            parsed = ConfigLine{0, section = *head, "", ""};
        if (!parsed)
            refuse(path, number, "neither [STAGE] nor NAME = VALUE (a number, true, false or \"text\")");
        parsed->number = number;
        if (!seen.emplace(parsed->section, parsed->name).second)
            refuse(path, number,
                   (parsed->name.empty() ? "[" + section + "]" : parsed->name) + " is there twice");
        lines.push_back(std::move(*parsed));
    }
    return lines;
}

void assign_config(const std::string& path, const std::string& stage, const ParameterList& parameters) {
    file_state(path);  // refuses a pipe, at which reading would wait
    for (const auto& line : parse_config(read_file(path), path)) assign_line(line, path, stage, parameters);
}

const std::vector<std::string>& stage_names() {
    static const std::vector<std::string> names{VARIMAP_STAGES};
    return names;
}

}  // namespace varimap
