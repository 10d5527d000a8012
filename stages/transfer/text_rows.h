#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace varimap {

/// One line of a table, its words without the blanks and quotes around them.
struct TextRow {
    int line = 0;  ///< from 1
    std::vector<std::string> words;
};

/// The lines of a table that hold something besides a comment (#).
struct TextRows {
    char separator = ' ';  ///< between the words: a comma, semicolon, tab, or blanks
    std::vector<TextRow> rows;
};

/// The first line tells the separator. Throws InputError for UTF-16 and where there are no rows.
TextRows split_rows(std::string_view bytes, const std::string& path);
bool is_number(std::string_view word);
std::string join(const std::vector<std::string>& words, char separator);

}  // namespace varimap
