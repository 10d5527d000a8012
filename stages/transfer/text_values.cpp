#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "stages/transfer/text_rows.h"
#include "stages/transfer/values.h"
#include "varimap/core/counted.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/lower_case.h"
#include "varimap/core/printable.h"
#include "varimap/core/shortest_text.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

namespace {

bool any_number(const TextRow& row) {
    return std::any_of(row.words.begin(), row.words.end(), is_number);
}

bool has_number(const TextRow& row, std::size_t number) {
    long long found;
    return to_index(row.words[0], found) && found == static_cast<long long>(number);
}

/// Whether the rows behind the first begin with their numbers, and go on: the first of them tells if these
/// are from 0, all if they are from 1, as R's are.
bool seem_numbered(const std::vector<TextRow>& rows) {
    if (rows[1].words.size() < 2) return false;
    if (has_number(rows[1], 0)) return true;
    for (std::size_t i = 1; i < rows.size(); ++i)
        if (!has_number(rows[i], i)) return false;
    return true;
}

/// Words stand for numbers where values are labels.
class Dictionary {
  public:
    double number_of(std::string_view word) {
        const auto [entry, added] = numbers_.try_emplace(std::string(word), words_.size());
        if (added) words_.push_back(entry->first);
        return double(entry->second);
    }
    std::string word_of(double number) const {
        return std::isnan(number) ? "nan" : words_[std::size_t(number)];
    }

  private:
    std::map<std::string, std::size_t> numbers_;
    std::vector<std::string> words_;
};

/// Rows are as many as the mesh has vertices or triangles. Where a line that holds none was passed over, they
/// are so also if the first one, which no other is like, names columns, and the missing one is counted.
void require_certain_names(const TextRows& text, const std::string& path) {
    const auto& rows = text.rows;
    if (text.passed_over == 0) return;
    if (std::any_of(rows.begin() + 1, rows.end(),
                    [&](const TextRow& row) { return row.words == rows[0].words; }))
        return;
    throw InputError(fmt::format(
        "{}: '{}' may name columns or be the first row, for {} over; write something there, or leave these "
        "lines out",
        path, excerpt(join(rows[0].words, text.separator)),
        counted(text.passed_over, "line without a row is passed", "lines without a row are passed")));
}

/// Labels stand for parts, on many rows each: a first row that holds one no other row holds looks as if it
/// named the column, and a row were missing.
void warn_of_lonely_label(const TextRows& text, const std::string& path) {
    constexpr std::size_t rows_of_a_label = 2;  // in the mean, at least
    std::set<std::vector<std::string>> others;
    for (std::size_t i = 1; i < text.rows.size(); ++i) others.insert(text.rows[i].words);
    const std::vector<std::string>& first = text.rows[0].words;
    if (others.contains(first) || text.rows.size() - 1 < rows_of_a_label * others.size()) return;
    warn(
        "{}: '{}', which no other row holds, is taken for the first row; if it names the column, a row is "
        "missing",
        path, excerpt(join(first, text.separator)));
}

/// A first line that may name the columns does so where the rows without it are those of the mesh. Where
/// their number does not tell, it does above numbers, and in front of rows that it says are numbered.
bool has_names(const TextRows& text, ValueKind kind, const TriangleMesh& mesh, const std::string& path) {
    const auto& rows = text.rows;
    if (rows.size() < 2) return false;
    const bool names_rows = is_index_name(rows[0].words[0]);
    if (!names_rows && any_number(rows[0])) return false;
    // No number is called so, and nothing else stands above rows that are numbered.
    if (names_rows && (kind != ValueKind::label || seem_numbered(rows))) return true;
    const bool all_fit = place_of(rows.size(), mesh).has_value();
    const bool others_fit = place_of(rows.size() - 1, mesh).has_value();
    if (all_fit && !others_fit) {
        require_certain_names(text, path);
        if (kind == ValueKind::label) warn_of_lonely_label(text, path);
    }
    if (all_fit != others_fit) return others_fit;
    return names_rows || kind != ValueKind::label || any_number(rows[1]);
}

/// What to do with a word where a number should stand.
const char* advice_about(std::string_view word) {
    const std::string lower = lower_case(word);
    if (lower == "na" || lower == "n/a" || lower == "null" || lower == "none" || lower == "-")
        return "write nan where there is none";
    std::string with_point(word);
    std::ranges::replace(with_point, ',', '.');
    double ignored;
    if (to_number(with_point, ignored)) return "write decimals with a point";
    return "give words as --labels, and write nan where a number is missing";
}

double cell(const TextRow& row, std::size_t column, ValueKind kind, Dictionary& words,
            const std::string& path) {
    const std::string_view word = row.words[column];
    if (kind == ValueKind::label) return words.number_of(word);
    double value;
    if (word.empty()) fail_at(path, row.line, "a number is missing; write nan where there is none");
    if (!to_number(word, value))
        fail_at(path, row.line, fmt::format("'{}' is not a number; {}", excerpt(word), advice_about(word)));
    return value;
}

/// Rows of a numbered table stand in the order of their numbers, from 0 or 1.
void require_number(const TextRow& row, std::size_t number, const std::string& name,
                    const std::string& path) {
    if (!has_number(row, number))
        fail_at(path, row.line,
                fmt::format("number '{}' where {} should stand: the column '{}' numbers the rows, in their "
                            "order from 0 or from 1; call one that holds values otherwise",
                            excerpt(row.words[0]), number, excerpt(name)));
}

/// The name of a single column may be several words.
void join_name(TextRows& text) {
    auto& first = text.rows[0].words;
    if (text.separator != ' ' || text.rows.size() < 2 || text.rows[1].words.size() != 1) return;
    double ignored;
    if (std::none_of(first.begin(), first.end(), [&](const auto& w) { return to_number(w, ignored); }))
        first = {fmt::format("{}", fmt::join(first, " "))};
}

void warn_of_decimal_commas(const TextRows& text, const std::string& path) {
    const auto is_split_decimal = [](const TextRow& row) {
        long long number;
        return row.words.size() == 2 && to_integer(row.words[0], number) && to_integer(row.words[1], number);
    };
    if (text.separator == ',' && std::ranges::all_of(text.rows, is_split_decimal))
        warn("{}: read as two columns of whole numbers; if these are decimals, write them with points", path);
}

/// What a file looks like besides its values.
struct TableLayout {
    std::string names;                        ///< the first line, if it names columns
    std::optional<std::size_t> first_number;  ///< if the first column numbers the rows
    char separator = ' ';
    ValueKind kind;
    Dictionary words;
};

std::string to_text(const Eigen::MatrixXd& values, const TableLayout& layout) {
    std::string text = layout.names;
    for (Eigen::Index row = 0; row < values.rows(); ++row) {
        std::vector<std::string> words;
        if (layout.first_number) words.push_back(std::to_string(std::size_t(row) + *layout.first_number));
        for (const double value : values.row(row))
            words.push_back(layout.kind == ValueKind::label ? layout.words.word_of(value)
                                                            : shortest_text(value));
        text += join(words, layout.separator) + '\n';
    }
    return text;
}

/// The rows behind `first`, without the column that numbers them.
Eigen::MatrixXd read_cells(const TextRows& text, std::size_t first, const std::string& path,
                           TableLayout& layout) {
    const std::size_t width = text.rows[0].words.size(), skipped = layout.first_number ? 1 : 0;
    Eigen::MatrixXd values(Eigen::Index(text.rows.size() - first), Eigen::Index(width - skipped));
    for (std::size_t i = first; i < text.rows.size(); ++i) {
        const TextRow& row = text.rows[i];
        if (row.words.size() != width)
            fail_at(path, row.line,
                    fmt::format("{} columns, but the first line has {}", row.words.size(), width));
        if (layout.first_number)
            require_number(row, i - first + *layout.first_number, text.rows[0].words[0], path);
        for (std::size_t c = skipped; c < width; ++c)
            values(Eigen::Index(i - first), Eigen::Index(c - skipped)) =
                cell(row, c, layout.kind, layout.words, path);
    }
    return values;
}

}  // namespace

ValueFile parse_text_values(std::string_view bytes, const std::string& path, ValueKind kind,
                            const TriangleMesh& mesh) {
    TextRows text = split_rows(bytes, path, kind == ValueKind::label ? Content::words : Content::numbers);
    join_name(text);
    if (kind == ValueKind::number) warn_of_decimal_commas(text, path);
    const auto& first = text.rows[0].words;
    const bool named = has_names(text, kind, mesh, path);
    TableLayout layout{"", {}, text.separator, kind, {}};
    if (named && first.size() > 1 && is_index_name(first[0]))
        layout.first_number = has_number(text.rows[1], 1) ? 1 : 0;
    if (named) layout.names = join(first, text.separator) + "\n";
    const std::string numbers = layout.first_number ? lower_case(first[0]) : "";
    ValueTable table{numbers == "face" ? Place::face : Place::vertex,
                     read_cells(text, named ? 1 : 0, path, layout)};
    table.says_place = numbers == "face" || numbers == "vertex";
    const auto write = [layout](const std::vector<ValueTable>& tables, const TriangleMesh&) {
        return to_text(tables[0].values, layout);
    };
    return {{std::move(table)}, write};
}

}  // namespace varimap
