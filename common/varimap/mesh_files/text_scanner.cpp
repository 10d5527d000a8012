#include "varimap/mesh_files/text_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "varimap/core/error.h"
#include "varimap/core/parse_number.h"
#include "varimap/core/printable.h"

namespace varimap {
namespace {

constexpr std::string_view blanks = " \t\v\f";

/// parse_number takes no leading plus.
std::string_view without_plus(std::string_view word) {
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    return plus ? word.substr(1) : word;
}

/// Every other byte of the first few is 0: text of two bytes a letter, also without a mark.
bool looks_like_utf16(std::string_view bytes) {
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) return true;
    if (bytes.size() < 4) return false;
    const bool high_first = !bytes[0] && bytes[1] && !bytes[2] && bytes[3];
    return high_first || (bytes[0] && !bytes[1] && bytes[2] && !bytes[3]);
}

}  // namespace

void fail_at(const std::string& path, int line, const std::string& message) {
    throw InputError(fmt::format("{}:{}: {}", path, line, message));
}

std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + (text.substr(end, 2) == "\r\n" ? 2 : 1), text.size()));
    return line;
}

void add_words(std::string_view line, std::vector<std::string_view>& words) {
    for (std::size_t begin = line.find_first_not_of(blanks); begin != line.npos;) {
        const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        begin = line.find_first_not_of(blanks, end);
    }
}

std::string_view split_off_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::string_view without_byte_order_mark(std::string_view bytes, const std::string& path) {
    if (looks_like_utf16(bytes)) throw InputError(path + ": is UTF-16 text; save it as UTF-8 or ASCII");
    constexpr std::string_view mark = "\xef\xbb\xbf";
    return bytes.starts_with(mark) ? bytes.substr(mark.size()) : bytes;
}

namespace {

/// Of a number out of range: whether it is below the least one, not above the largest.
bool is_tiny(std::string_view word) {
    const std::size_t exponent = word.find_first_of("eE");
    if (exponent != word.npos) return word.substr(exponent).find('-') != word.npos;
    return word.substr(0, word.find('.')).find_first_of("123456789") == word.npos;
}

}  // namespace

bool to_number(std::string_view word, double& value) {
    word = without_plus(word);
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || word.empty()) return false;
    if (error == std::errc::result_out_of_range) {
        value = is_tiny(word) ? 0 : std::numeric_limits<double>::infinity();
        if (word.front() == '-') value = -value;
        return true;
    }
    return error == std::errc();
}

bool to_integer(std::string_view word, long long& value) {
    return parse_number(without_plus(word), value);
}

bool is_number(std::string_view word) {
    double ignored;
    return to_number(word, ignored);
}

bool TextScanner::next_line() {
    words_.clear();
    bool joined = false;
    while (position_ < text_.size() && (words_.empty() || joined)) {
        std::string_view rest = text_.substr(position_), line = take_line(rest);
        position_ = text_.size() - rest.size();
        ++line_;
        if (words_.empty()) uncut_ = line;
        if (style_ == LineStyle::code) line = line.substr(0, line.find('#'));
        joined = style_ == LineStyle::code && !line.empty() && line.back() == '\\';
        if (joined) line.remove_suffix(1);
        add_words(line, words_);
    }
    return !words_.empty();
}

std::string_view TextScanner::line_text() const {
    return {uncut_.data(), std::size_t(words_.back().data() + words_.back().size() - uncut_.data())};
}

std::string_view TextScanner::rest_of_line() const {
    const std::size_t end_of_word = std::size_t(words_[0].data() + words_[0].size() - uncut_.data());
    std::string_view rest = uncut_.substr(end_of_word);
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    return rest.substr(0, rest.find_last_not_of(blanks) + 1);
}

double TextScanner::number(std::size_t i, const char* what) const {
    double value;
    if (i >= words_.size()) fail(fmt::format("{} is missing", what));
    if (!to_number(words_[i], value)) fail(fmt::format("{} '{}' is not a number", what, excerpt(words_[i])));
    return value;
}

long long TextScanner::integer(std::size_t i, const char* what) const {
    long long value;
    if (i >= words_.size()) fail(fmt::format("{} is missing", what));
    if (!to_integer(words_[i], value))
        fail(fmt::format("{} '{}' is not an integer", what, excerpt(words_[i])));
    return value;
}

void TextScanner::fail(const std::string& message) const {
    fail_at(path_, line_, message);
}

}  // namespace varimap
