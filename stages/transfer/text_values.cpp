#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>

#include "stages/transfer/text_rows.h"
#include "stages/transfer/values.h"
#include "varimap/core/error.h"
#include "varimap/core/printable.h"
#include "varimap/mesh/io/text_scanner.h"

namespace varimap {

namespace {

bool is_index_name(std::string_view name) {
    std::string lower(name);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return lower == "vertex" || lower == "face" || lower == "index" || lower == "id" || lower.empty();
}

/// Words stand for numbers where values are labels.
class Dictionary {
  public:
    double number_of(std::string_view word) {
        const auto [entry, added] = numbers_.try_emplace(std::string(word), words_.size());
        if (added) words_.push_back(entry->first);
        return double(entry->second);
    }
    std::string word_of(double number) const { return std::isnan(number) ? "" : words_[std::size_t(number)]; }

  private:
    std::map<std::string, std::size_t> numbers_;
    std::vector<std::string> words_;
};

/// The first line names the columns where none of its words is a number, but one of the next line's is; of
/// labels, which may be words, where it names what the rows belong to.
bool has_names(const TextRows& rows, ValueKind kind) {
    if (rows.rows.size() < 2) return false;
    const auto& first = rows.rows[0].words;
    if (is_index_name(first[0])) return true;
    if (std::any_of(first.begin(), first.end(), is_number)) return false;
    const auto& second = rows.rows[1].words;
    return kind != ValueKind::label || std::any_of(second.begin(), second.end(), is_number);
}

double cell(const TextRow& row, std::size_t column, ValueKind kind, Dictionary& words,
            const std::string& path) {
    const std::string_view word = row.words[column];
    if (kind == ValueKind::label) return words.number_of(word);
    double value;
    if (!to_number(word, value))
        throw InputError(fmt::format("{}:{}: '{}' is not a number; give words as --labels", path, row.line,
                                     excerpt(word)));
    return value;
}

/// Rows of a numbered table stand in the order of their numbers, from 0.
void require_number(const TextRow& row, std::size_t number, const std::string& path) {
    long long found;
    if (!to_integer(row.words[0], found) || found != static_cast<long long>(number))
        throw InputError(
            fmt::format("{}:{}: number '{}' where {} should stand; rows must be in their order, "
                        "from 0",
                        path, row.line, excerpt(row.words[0]), number));
}

std::string shortest(double value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

/// What a file looks like besides its values.
struct Layout {
    std::string names;  ///< the first line, if it names columns
    bool numbered = false;
    char separator = ' ';
    ValueKind kind;
    Dictionary words;
};

std::string to_text(const Eigen::MatrixXd& values, const Layout& layout) {
    std::string text = layout.names;
    for (Eigen::Index row = 0; row < values.rows(); ++row) {
        if (layout.numbered) text += fmt::format("{}{}", row, layout.separator);
        for (Eigen::Index c = 0; c < values.cols(); ++c) {
            if (c > 0) text += layout.separator;
            text += layout.kind == ValueKind::label ? layout.words.word_of(values(row, c))
                                                    : shortest(values(row, c));
        }
        text += '\n';
    }
    return text;
}

/// The rows behind `first`, without the column that numbers them.
Eigen::MatrixXd read_cells(const TextRows& text, std::size_t first, const std::string& path, Layout& layout) {
    const std::size_t width = text.rows[0].words.size(), skipped = layout.numbered ? 1 : 0;
    Eigen::MatrixXd values(Eigen::Index(text.rows.size() - first), Eigen::Index(width - skipped));
    for (std::size_t i = first; i < text.rows.size(); ++i) {
        const TextRow& row = text.rows[i];
        if (row.words.size() != width)
            throw InputError(fmt::format("{}:{}: {} columns, but the first line has {}", path, row.line,
                                         row.words.size(), width));
        if (layout.numbered) require_number(row, i - first, path);
        for (std::size_t c = skipped; c < width; ++c)
            values(Eigen::Index(i - first), Eigen::Index(c - skipped)) =
                cell(row, c, layout.kind, layout.words, path);
    }
    return values;
}

}  // namespace

ValueFile parse_text_values(std::string_view bytes, const std::string& path, ValueKind kind) {
    const TextRows text = split_rows(bytes, path);
    const auto& first = text.rows[0].words;
    const bool named = has_names(text, kind);
    Layout layout{"", named && first.size() > 1 && is_index_name(first[0]), text.separator, kind, {}};
    if (named) layout.names = join(first, text.separator) + "\n";
    ValueTable table{Place::vertex, read_cells(text, named ? 1 : 0, path, layout)};
    const auto write = [layout](const std::vector<ValueTable>& tables, const TriangleMesh&) {
        return to_text(tables[0].values, layout);
    };
    return {{std::move(table)}, write};
}

}  // namespace varimap
