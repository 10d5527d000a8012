#include "varimap/landmarks/csv_fields.h"

#include <algorithm>
#include <array>

#include "varimap/core/lower_case.h"

namespace varimap {
namespace {

/// A tab that separates is no blank.
std::string_view blanks_beside(char separator) {
    return separator == '\t' ? " " : " \t";
}

void skip_blanks(std::string_view& line, char separator) {
    line.remove_prefix(std::min(line.find_first_not_of(blanks_beside(separator)), line.size()));
}

std::string take_plain(std::string_view& line, char separator) {
    const std::string_view field = line.substr(0, line.find(separator));
    line.remove_prefix(field.size());
    return std::string(field.substr(0, field.find_last_not_of(blanks_beside(separator)) + 1));
}

bool holds_outside_quotes(std::string_view line, char separator) {
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (c == separator && !quoted) return true;
    }
    return false;
}

}  // namespace

std::optional<std::string> take_quoted(std::string_view& line) {
    std::string field;
    line.remove_prefix(1);
    for (;;) {
        const std::size_t quote = line.find('"');
        if (quote == line.npos) return {};
        field += line.substr(0, quote);
        line.remove_prefix(quote + 1);
        if (!line.starts_with('"')) return field;
        field += '"';
        line.remove_prefix(1);
    }
}

std::string_view take_raw_field(std::string_view& line) {
    bool quoted = false;
    const auto end = std::find_if(line.begin(), line.end(), [&](char c) {
        if (c == '"') quoted = !quoted;
        return c == ',' && !quoted;
    });
    const auto size = std::size_t(end - line.begin());
    const std::string_view field = line.substr(0, size);
    line.remove_prefix(std::min(size + 1, line.size()));
    return field;
}

std::string in_quotes(std::string_view field) {
    std::string text = "\"";
    for (const char c : field) text += c == '"' ? "\"\"" : std::string(1, c);
    return text + '"';
}

char separator_of(std::string_view line) {
    line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
    for (const char separator : {',', ';', '\t'})
        if (holds_outside_quotes(line, separator)) return separator;
    return ' ';
}

std::optional<std::vector<std::string>> csv_fields(std::string_view line, char separator) {
    std::vector<std::string> fields;
    for (;; line.remove_prefix(1)) {
        skip_blanks(line, separator);
        std::optional<std::string> field =
            line.starts_with('"') ? take_quoted(line) : take_plain(line, separator);
        if (!field) return {};
        skip_blanks(line, separator);
        fields.push_back(std::move(*field));
        if (line.empty()) return fields;
        if (!line.starts_with(separator)) return {};
    }
}

bool is_missing(std::string_view field) {
    constexpr std::array<std::string_view, 8> words{"", "na", "n/a", "nan", "null", "none", "?", "-"};
    return std::ranges::find(words, lower_case(field)) != words.end();
}

}  // namespace varimap
