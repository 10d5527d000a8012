#include "stages/transfer/text_rows.h"

#include <algorithm>

#include "varimap/core/error.h"
#include "varimap/mesh/io/text_scanner.h"

namespace varimap {

namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == text.npos) return {};
    text = text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
    const bool quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
    return quoted ? text.substr(1, text.size() - 2) : text;
}

char separator_of(std::string_view line) {
    for (const char c : {',', ';', '\t'})
        if (line.find(c) != line.npos) return c;
    return ' ';
}

std::vector<std::string> words_of(std::string_view line, char separator) {
    std::vector<std::string> words;
    if (separator == ' ') {
        for (std::size_t at = line.find_first_not_of(blanks); at != line.npos;) {
            const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
            words.emplace_back(line.substr(at, end - at));
            at = line.find_first_not_of(blanks, end);
        }
        return words;
    }
    while (true) {
        const std::size_t end = line.find(separator);
        words.emplace_back(trimmed(line.substr(0, end)));
        if (end == line.npos) return words;
        line.remove_prefix(end + 1);
    }
}

}  // namespace

TextRows split_rows(std::string_view bytes, const std::string& path) {
    bytes = without_byte_order_mark(bytes, path);
    TextRows text;
    for (int number = 1; !bytes.empty(); ++number) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        std::string_view line = bytes.substr(0, end);
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        line = line.substr(0, line.find('#'));
        if (line.find_first_not_of(blanks) == line.npos) continue;
        if (text.rows.empty())
            text.separator = separator_of(line.substr(0, line.find_last_not_of(blanks) + 1));
        text.rows.push_back({number, words_of(line, text.separator)});
    }
    if (text.rows.empty()) throw InputError(path + ": holds no rows");
    return text;
}

bool is_number(std::string_view word) {
    double ignored;
    return to_number(word, ignored);
}

std::string join(const std::vector<std::string>& words, char separator) {
    std::string line;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) line += separator;
        line += words[i];
    }
    return line;
}

}  // namespace varimap
