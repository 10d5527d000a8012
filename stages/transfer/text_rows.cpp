#include "stages/transfer/text_rows.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/core/lower_case.h"
#include "varimap/core/trimmed.h"
#include "varimap/landmarks/csv_fields.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

namespace {

constexpr std::string_view blanks = " \t\r";
constexpr std::string_view separators = ",;\t";  ///< besides blanks

/// A tab that separates is no blank.
std::string_view blanks_beside(char separator) {
    return separator == '\t' ? " \r" : blanks;
}

/// Splits one line.
class LineSplitter {
  public:
    LineSplitter(std::string_view line, int number, const std::string& path)
        : rest_(line), number_(number), path_(path) {}

    std::vector<std::string> words(char separator, Content content) {
        std::vector<std::string> words;
        const bool comments = separator == ' ' && content == Content::numbers;
        while (true) {
            rest_ = trimmed(rest_, blanks_beside(separator));
            if (comments && rest_.starts_with('#')) return words;
            words.push_back(take_word(separator));
            if (rest_.empty()) return words;
            rest_.remove_prefix(1);
        }
    }

    /// A comment that the words end at.
    std::string_view rest() const { return rest_; }

  private:
    /// Up to the separator, which stays.
    std::string take_word(char separator) {
        const bool is_quoted = rest_.starts_with('"');
        const std::optional<std::string> word = is_quoted ? take_quoted(rest_) : "";
        if (!word) fail("a quote is not closed");
        const std::string_view ends = separator == ' ' ? blanks : std::string_view(&separator, 1);
        const std::size_t end = std::min(rest_.find_first_of(ends), rest_.size());
        const std::string_view plain = trimmed(rest_.substr(0, end), blanks_beside(separator));
        if (is_quoted && !plain.empty()) fail("text stands behind a quote");
        rest_.remove_prefix(end);
        return is_quoted ? *word : std::string(plain);
    }
    [[noreturn]] void fail(const std::string& what) const {
        fail_at(path_, number_, what + "; put the word in quotes, and double those within it");
    }

    std::string_view rest_;
    int number_;
    const std::string& path_;
};

/// Whether the word alone would be read as something else.
bool needs_quotes(std::string_view word, char separator) {
    return word.starts_with('#') || word.find('"') != word.npos ||
           word.find_first_of(separators) != word.npos || trimmed(word) != word ||
           (separator == ' ' && (word.empty() || word.find(' ') != word.npos));
}

/// A comment behind numbers that blanks separate may hold any separator.
std::string_view without_comment(std::string_view line, Content content) {
    const std::string_view before = line.substr(0, line.find(" #"));
    if (content != Content::numbers || before == line) return line;
    for (std::string_view rest = trimmed(before); !rest.empty(); rest = trimmed(rest)) {
        const std::size_t end = std::min(rest.find_first_of(blanks), rest.size());
        if (!is_number(rest.substr(0, end))) return line;
        rest.remove_prefix(end);
    }
    return before;
}

}  // namespace

TextRows split_rows(std::string_view bytes, const std::string& path, Content content) {
    bytes = without_byte_order_mark(bytes, path);
    // Such as .npz and .xlsx, whose bytes could not be told from words.
    if (bytes.find('\0') != bytes.npos)
        throw InputError(path + ": is no text; save it as .csv or .txt (values may be .npy or .ply, too)");
    const bool blanks_belong = content == Content::words && has_ending(path, ".csv");
    TextRows text;
    std::vector<int> empty;  // lines since the last row
    for (int number = 1; !bytes.empty(); ++number) {
        const std::string_view line = split_off_line(bytes);
        const std::string_view start = trimmed(line);
        if (start.empty()) empty.push_back(number);
        if (start.empty() || start.starts_with('#')) {
            text.behind += std::string(line) + '\n';
            text.passed_over += text.rows.empty() ? 0 : 1;
            continue;
        }
        // Between the words of one column they are words left empty, as tables have them.
        if (blanks_belong && !text.rows.empty() && text.rows[0].words.size() == 1) {
            for (const int blank : empty) text.rows.push_back({blank, {""}});
            text.passed_over -= int(empty.size());
        }
        empty.clear();
        LineSplitter splitter(line, number, path);
        if (text.rows.empty()) text.separator = separator_of(without_comment(line, content));
        if (text.separator == ' ' && blanks_belong) text.separator = ',';
        std::vector<std::string> words = splitter.words(text.separator, content);
        text.rows.push_back({number, std::move(words), std::exchange(text.behind, {}),
                             std::string(trimmed(splitter.rest(), blanks))});
    }
    if (text.rows.empty()) throw InputError(path + ": holds no rows");
    return text;
}

bool is_index_name(std::string_view name) {
    const std::string lower = lower_case(name);
    return lower == "vertex" || lower == "face" || lower == "index" || lower == "id" || lower.empty();
}

bool to_index(std::string_view word, long long& index) {
    constexpr double exact = 9007199254740992;  // 2^53
    if (to_integer(word, index)) return true;
    double value;
    if (!to_number(word, value) || std::abs(value) >= exact || value != std::floor(value)) return false;
    index = static_cast<long long>(value);
    return true;
}

std::string join(const std::vector<std::string>& words, char separator) {
    std::string line;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) line += separator;
        // A line with nothing on it is none.
        const bool lost = words.size() == 1 && words[i].empty();
        line += lost || needs_quotes(words[i], separator) ? in_quotes(words[i]) : words[i];
    }
    return line;
}

}  // namespace varimap
