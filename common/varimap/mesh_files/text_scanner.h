#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace varimap {

/// What is special in a line: in `code`, `#` starts a comment and a backslash at the end joins the next line;
/// `plain` has neither.
enum class LineStyle { code, plain };

/// Splits a text into lines of words. A word is what stands between blanks; lines end with \n, \r\n or \r;
/// lines without words are passed over.
class TextScanner {
  public:
    TextScanner(std::string_view text, std::string path, LineStyle style = LineStyle::code)
        : text_(text), path_(std::move(path)), style_(style) {}

    /// Goes to the next line with words; false at the end of the text.
    bool next_line();
    const std::vector<std::string_view>& words() const { return words_; }
    /// The line up to the end of its last word, as it stands there.
    std::string_view line_text() const;
    /// What stands behind the first word up to the end of its line, without the blanks around it, as names
    /// do: they may hold blanks and `#`.
    std::string_view rest_of_line() const;
    /// Number of the current line, from 1.
    int line() const { return line_; }
    /// Where the next line starts.
    std::size_t position() const { return position_; }
    /// Word i of the current line as a number. Throws InputError naming file, line and `what`.
    double number(std::size_t i, const char* what) const;
    long long integer(std::size_t i, const char* what) const;
    /// Throws InputError "<path>:<line>: <message>".
    [[noreturn]] void fail(const std::string& message) const;

  private:
    std::string_view text_;
    std::string path_;
    LineStyle style_;
    std::size_t position_ = 0;  ///< where the next line starts
    int line_ = 0;
    std::vector<std::string_view> words_;
    std::string_view uncut_;  ///< the line that holds the first word, with what `#` starts
};

/// Throws InputError "<path>:<line>: <message>".
[[noreturn]] void fail_at(const std::string& path, int line, const std::string& message);

/// Takes the first line off the text; lines end with \n, \r\n or \r, which it is without.
std::string_view take_line(std::string_view& text);
/// Adds what stands between the blanks of a line.
void add_words(std::string_view line, std::vector<std::string_view>& words);
/// Takes the first line off the text; lines end with \n or \r\n, which it is without.
std::string_view split_off_line(std::string_view& text);

/// The text behind a UTF-8 byte order mark, where there is one. Throws InputError for UTF-16.
std::string_view without_byte_order_mark(std::string_view bytes, const std::string& path);

/// The whole word as a number, the same in every locale; false if it is not one. "nan" and "inf" are numbers.
bool to_number(std::string_view word, double& value);
bool to_integer(std::string_view word, long long& value);
bool is_number(std::string_view word);

}  // namespace varimap
