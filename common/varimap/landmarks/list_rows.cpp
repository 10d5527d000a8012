#include "varimap/landmarks/list_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/lower_case.h"
#include "varimap/core/printable.h"
#include "varimap/landmarks/csv_fields.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

namespace {

bool has_commas(const TextScanner& scanner) {
    return std::ranges::any_of(scanner.words(), [](auto word) { return word.find(',') != word.npos; });
}

/// Semicolon or tab where the first line is one of a table with these; else a blank. Numbers that tabs
/// separate are those that blanks separate.
char separator_of_table(const TextScanner& first_line) {
    if (std::ranges::all_of(first_line.words(), is_number)) return ' ';
    const char separator = separator_of(first_line.line_text());
    return separator == ',' ? ' ' : separator;
}

std::vector<std::string> fields_of(const TextScanner& scanner, char separator) {
    const auto fields = csv_fields(scanner.line_text(), separator);
    if (!fields)
        scanner.fail(
            "a quote has no end before the line or, with #, its comment, or more than a separator behind it");
    return *fields;
}

/// Whether a column of that heading names landmarks, though they may be called 1, 2, 3. Tables are often
/// written with a first column of row numbers that has no heading.
bool is_heading_of_names(const std::string& heading) {
    constexpr std::array headings{"", "name", "label", "id", "landmark", "point"};
    return std::ranges::find(headings, lower_case(heading)) != headings.end();
}

/// Columns are read in their order: those that the heading names in another one would be exchanged.
void require_order(const std::vector<std::string>& headings, std::span<const char* const> names,
                   const TextScanner& scanner) {
    std::size_t last = 0;
    for (const char* name : names) {
        const auto found =
            std::ranges::find_if(headings, [&](const std::string& h) { return lower_case(h) == name; });
        if (found == headings.end()) return;
        const auto place = std::size_t(found - headings.begin()) + 1;
        if (place < last)
            scanner.fail(fmt::format("columns have to stand in the order {}", fmt::join(names, ",")));
        last = place;
    }
}

void require_order(const std::vector<std::string>& headings, const TextScanner& scanner) {
    require_order(headings, std::array{"source", "target"}, scanner);
    require_order(headings, std::array{"x", "y", "z"}, scanner);
}

std::vector<double> numbers_of(std::span<const std::string> fields, const TextScanner& scanner) {
    std::vector<double> numbers;
    for (const std::string& field : fields) {
        double number;
        if (!to_number(field, number) || !std::isfinite(number))
            scanner.fail(fmt::format("'{}' is not a number", excerpt(field)));
        numbers.push_back(number);
    }
    return numbers;
}

/// A line of a table, whose first or last field may be a name.
ListRow row_of_table(std::span<const std::string> fields, bool first_is_name, const TextScanner& scanner) {
    ListRow row{scanner.line(), {}};
    if (first_is_name || !is_number(fields.front())) {
        row.name = fields.front();
        fields = fields.subspan(1);
    } else if (!is_number(fields.back())) {
        row.name = fields.back();
        fields = fields.first(fields.size() - 1);
    }
    row.numbers = numbers_of(fields, scanner);
    return row;
}

}  // namespace

std::vector<ListRow> read_list_rows(const std::string& path) {
    const std::string bytes = read_file(path);
    TextScanner scanner(without_byte_order_mark(bytes, path), path);
    std::vector<ListRow> rows;
    bool first_is_name = false;
    char of_table = ' ';
    for (bool first = true; scanner.next_line(); first = false) {
        if (first) of_table = separator_of_table(scanner);
        // Lines with commas and with blanks may stand in one file.
        const char separator = of_table == ' ' && has_commas(scanner) ? ',' : of_table;
        if (separator == ' ') {
            const std::vector<std::string> words(scanner.words().begin(), scanner.words().end());
            rows.push_back({scanner.line(), numbers_of(words, scanner)});
            continue;
        }
        const std::vector<std::string> fields = fields_of(scanner, separator);
        if (first && std::ranges::none_of(fields, is_number)) {
            require_order(fields, scanner);
            first_is_name = is_heading_of_names(fields.front());
        } else {
            rows.push_back(row_of_table(fields, first_is_name, scanner));
        }
    }
    if (rows.empty()) throw InputError(path + ": holds no vertex numbers");
    return rows;
}

void require_count(const std::vector<ListRow>& rows, const std::string& path,
                   std::initializer_list<std::size_t> counts, const char* expected) {
    for (const ListRow& row : rows)
        if (std::ranges::find(counts, row.numbers.size()) == counts.end())
            fail_at(path, row.line,
                    fmt::format("expected {}, found {} number(s)", expected, row.numbers.size()));
}

}  // namespace varimap
