#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

namespace varimap {

/// A line of a list of vertices or points, without what they mean.
struct ListRow {
    int line = 0;                 ///< of the file, from 1
    std::vector<double> numbers;  ///< NaN: missing (csv_fields.h)
    std::string name = {};        ///< of a line of a table, where it holds one
};

/// The lines of a file that hold something, without comments and the headings of a table; at least one. In
/// the fields of a table decimals may have commas. Throws IoError; InputError naming file and line for what
/// is neither a finite number nor missing, and for a file without lines.
std::vector<ListRow> read_list_rows(const std::string& path);

/// Throws InputError naming file and line where a row has none of these counts of numbers; `expected` says in
/// words what should be there.
void require_count(const std::vector<ListRow>& rows, const std::string& path,
                   std::initializer_list<std::size_t> counts, const char* expected);

}  // namespace varimap
