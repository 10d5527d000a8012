#include "varimap/landmarks/csv_fields.h"

#include <algorithm>

namespace varimap {
namespace {

constexpr std::string_view blanks = " \t";

void skip_blanks(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
}

/// Takes a field in quotes off the line; false where its end is missing.
bool take_quoted(std::string_view& line, std::string& field) {
    line.remove_prefix(1);
    for (;;) {
        const std::size_t quote = line.find('"');
        if (quote == line.npos) return false;
        field += line.substr(0, quote);
        line.remove_prefix(quote + 1);
        if (!line.starts_with('"')) return true;
        field += '"';
        line.remove_prefix(1);
    }
}

std::string take_plain(std::string_view& line) {
    const std::string_view field = line.substr(0, line.find(','));
    line.remove_prefix(field.size());
    return std::string(field.substr(0, field.find_last_not_of(blanks) + 1));
}

}  // namespace

std::optional<std::vector<std::string>> csv_fields(std::string_view line) {
    std::vector<std::string> fields;
    for (;; line.remove_prefix(1)) {
        skip_blanks(line);
        std::string field;
        if (!line.starts_with('"'))
            field = take_plain(line);
        else if (!take_quoted(line, field))
            return {};
        skip_blanks(line);
        fields.push_back(std::move(field));
        if (line.empty()) return fields;
        if (!line.starts_with(',')) return {};
    }
}

}  // namespace varimap
