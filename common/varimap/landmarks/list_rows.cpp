#include "varimap/landmarks/list_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/core/lower_case.h"
#include "varimap/core/printable.h"
#include "varimap/landmarks/csv_fields.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

namespace {

bool has_commas(const TextScanner& scanner) {
    return std::ranges::any_of(scanner.words(), [](auto word) { return word.find(',') != word.npos; });
}

/// Whether a field is a number whose decimals have a comma, which stands between digits.
bool has_decimal_comma(std::string_view field, double& number) {
    const std::size_t comma = field.find(',');
    if (comma == field.npos || comma == 0 || comma + 1 == field.size()) return false;
    std::string with_point(field);
    with_point[comma] = '.';
    return to_number(with_point, number);
}

bool is_value(std::string_view field) {
    double ignored;
    return is_number(field) || has_decimal_comma(field, ignored);
}

bool separates_decimal_commas(const TextScanner& line, char separator) {
    const auto fields = csv_fields(line.line_text(), separator);
    double ignored;
    return fields && fields->size() > 1 &&
           std::ranges::any_of(*fields, [&](const auto& f) { return has_decimal_comma(f, ignored); });
}

/// Semicolon or tab where the first line is one of a table with these; else a blank. Numbers that tabs
/// separate are those that blanks separate.
char separator_of_table(const TextScanner& first_line) {
    if (std::ranges::all_of(first_line.words(), is_number)) return ' ';
    for (const char separator : {';', '\t'})
        if (separates_decimal_commas(first_line, separator)) return separator;
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

/// Headings are no values, and missing ones only in front of names of rows.
bool are_headings(std::span<const std::string> fields) {
    return std::ranges::none_of(fields, is_value) && std::ranges::none_of(fields.subspan(1), is_missing);
}

/// Reads the lines of one list, of which the first says how they are split.
class RowReader {
  public:
    /// None of a line of headings.
    std::optional<ListRow> read(const TextScanner& line) {
        const bool first = std::exchange(is_first_, false);
        if (first) of_table_ = separator_of_table(line);
        // Lines with commas and with blanks may stand in one file.
        const char separator = of_table_ == ' ' && has_commas(line) ? ',' : of_table_;
        if (separator == ' ') {
            const std::vector<std::string> words(line.words().begin(), line.words().end());
            return ListRow{line.line(), numbers_of(words, line)};
        }
        const std::vector<std::string> fields = fields_of(line, separator);
        if (!first || !are_headings(fields)) return row_of_table(fields, line);
        require_order(fields, line);
        first_is_name_ = is_heading_of_names(fields.front());
        return {};
    }

  private:
    /// A line of a table, whose first or last field may be a name. One that is missing is a name where lines
    /// before have one there.
    ListRow row_of_table(std::span<const std::string> fields, const TextScanner& line) {
        const auto is_name = [](const std::string& field, bool others_are) {
            return !is_value(field) && (others_are || !is_missing(field));
        };
        ListRow row{line.line(), {}};
        if (first_is_name_ || is_name(fields.front(), named_first_)) {
            named_first_ = true;
            row.name = fields.front();
            fields = fields.subspan(1);
        } else if (is_name(fields.back(), named_last_)) {
            named_last_ = true;
            row.name = fields.back();
            fields = fields.first(fields.size() - 1);
        }
        row.numbers = numbers_of(fields, line);
        return row;
    }
    std::vector<double> numbers_of(std::span<const std::string> fields, const TextScanner& line) {
        std::vector<double> numbers;
        for (const std::string& field : fields) numbers.push_back(number_of(field, line));
        return numbers;
    }
    double number_of(const std::string& field, const TextScanner& line) {
        if (is_missing(field)) return std::numeric_limits<double>::quiet_NaN();
        double number;
        const bool has_comma = has_decimal_comma(field, number);
        if (!has_comma && (!to_number(field, number) || !std::isfinite(number)))
            line.fail(fmt::format("'{}' is not a number{}", excerpt(field),
                                  field.find(' ') != field.npos
                                      ? "; where decimals have commas, semicolons or tabs separate columns"
                                      : ""));
        commas_ = commas_ || has_comma;
        points_ = points_ || field.find('.') != field.npos;
        // 1,234 beside 0.5 is a thousand.
        if (commas_ && points_) line.fail("some numbers have a decimal comma, others a decimal point");
        return number;
    }

    bool is_first_ = true;
    char of_table_ = ' ';
    bool first_is_name_ = false;                     ///< the heading says so, also of numbers
    bool named_first_ = false, named_last_ = false;  ///< a line before has a name there
    bool commas_ = false, points_ = false;           ///< of decimals so far
};

/// Landmarks of many specimens in one file.
void require_readable_format(const std::string& path) {
    for (const char* format : {".tps", ".dta", ".nts"})
        if (has_ending(path, format))
            throw InputError(fmt::format(
                "{}: {} files are not read; save the landmarks of each specimen as a .csv with lines x,y,z "
                "or name,x,y,z",
                path, format));
}

}  // namespace

std::vector<ListRow> read_list_rows(const std::string& path) {
    require_readable_format(path);
    const std::string bytes = read_file(path);
    TextScanner scanner(without_byte_order_mark(bytes, path), path);
    std::vector<ListRow> rows;
    RowReader reader;
    while (scanner.next_line())
        if (auto row = reader.read(scanner)) rows.push_back(std::move(*row));
    if (rows.empty()) throw InputError(path + ": holds no vertices or points");
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
