#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace varimap {

/// One line of a table, its words without the blanks and quotes around them.
struct TextRow {
    int line = 0;  ///< from 1
    std::vector<std::string> words;
    std::string before = {};  ///< empty lines and comments between the row before and this one, as they stand
    std::string comment = {};  ///< what stands behind the words, from its # on
};

/// What a table holds besides names.
enum class Content : int {
    numbers,
    words  ///< which may hold blanks and #
};

/// The lines of a table that hold something besides a comment (#).
struct TextRows {
    char separator = ' ';  ///< between the words: a comma, semicolon, tab, or blanks
    std::vector<TextRow> rows;
    std::string behind = {};  ///< the same behind the last row
    int passed_over = 0;      ///< lines that are no rows, behind the first one
};

/// The first line tells the separator; where it holds none, blanks separate, but in a .csv of words they
/// belong to these. Quotes are those of RFC 4180, within a line. A comment begins a line, or stands behind
/// numbers that blanks separate. Throws InputError for UTF-16, for files that are no text, for quotes that
/// are not closed, and where there are no rows.
TextRows split_rows(std::string_view bytes, const std::string& path, Content content);
/// Whether a column of that name numbers the rows, or holds numbers of vertices or faces.
bool is_index_name(std::string_view name);
/// The whole word as an integer, also where it is written as a float, as NumPy writes all numbers
/// (0.000000000000000000e+00); false if it is none, or too large for a float to tell it from the next.
bool to_index(std::string_view word, long long& index);
/// A line, without its end, of which split_rows makes these words, in quotes where they need some.
std::string join(const std::vector<std::string>& words, char separator);

}  // namespace varimap
