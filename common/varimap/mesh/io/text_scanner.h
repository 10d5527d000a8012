#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace varimap {

/// Splits a text into lines of words. A word is what stands between blanks; `#` starts a comment; lines end
/// with \n, \r\n or \r; lines without words are passed over.
class TextScanner {
  public:
    TextScanner(std::string_view text, std::string path) : text_(text), path_(std::move(path)) {}

    /// Goes to the next line with words; false at the end of the text. A backslash at a line's end joins the
    /// next.
    bool next_line();
    const std::vector<std::string_view>& words() const { return words_; }
    /// Word i of the current line as a number. Throws InputError naming file, line and `what`.
    double number(std::size_t i, const char* what) const;
    long long integer(std::size_t i, const char* what) const;
    /// Throws InputError "<path>:<line>: <message>".
    [[noreturn]] void fail(const std::string& message) const;

  private:
    std::string_view take_line();
    std::string_view text_;
    std::string path_;
    std::size_t position_ = 0;
    int line_ = 0;
    std::vector<std::string_view> words_;
};

/// The whole word as a number, the same in every locale; false if it is not one. "nan" and "inf" are numbers.
bool to_number(std::string_view word, double& value);
bool to_integer(std::string_view word, long long& value);

}  // namespace varimap
