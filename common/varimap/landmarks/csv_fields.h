#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace varimap {

/// Takes a field in quotes off the front of a line: what is between them, where two quotes stand for one.
/// None where the closing quote is missing.
std::optional<std::string> take_quoted(std::string_view& line);

/// The field in quotes that take_quoted takes.
std::string in_quotes(std::string_view field);

/// Which of comma, semicolon and tab, the first of these, the line holds outside of quotes and before its
/// last word; a blank where it holds none.
char separator_of(std::string_view line);

/// Takes what stands before the first comma that is not between quotes off the front of a line, and the
/// comma.
std::string_view take_raw_field(std::string_view& line);

/// What stands between the separators of a line, without blanks around it. As RFC 4180 says, a field in
/// quotes may hold them, and quotes as two of them. None where a quote has no end, or more than a separator
/// behind it.
std::optional<std::vector<std::string>> csv_fields(std::string_view line, char separator = ',');

/// Whether a field says that its value is missing, as tables do: nothing, NA, NaN, ? and the like.
bool is_missing(std::string_view field);

}  // namespace varimap
