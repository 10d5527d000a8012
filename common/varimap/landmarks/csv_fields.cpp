#include "varimap/landmarks/csv_fields.h"

#include <algorithm>

namespace varimap {
namespace {

constexpr std::string_view blanks = " \t";

void skip_blanks(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
}

std::string take_plain(std::string_view& line) {
    const std::string_view field = line.substr(0, line.find(','));
    line.remove_prefix(field.size());
    return std::string(field.substr(0, field.find_last_not_of(blanks) + 1));
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

std::optional<std::vector<std::string>> csv_fields(std::string_view line) {
    std::vector<std::string> fields;
    for (;; line.remove_prefix(1)) {
        skip_blanks(line);
        std::optional<std::string> field = line.starts_with('"') ? take_quoted(line) : take_plain(line);
        if (!field) return {};
        skip_blanks(line);
        fields.push_back(std::move(*field));
        if (line.empty()) return fields;
        if (!line.starts_with(',')) return {};
    }
}

}  // namespace varimap
