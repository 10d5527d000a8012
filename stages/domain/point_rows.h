#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

/// The whole file, with commas and semicolons as blanks. Throws IoError.
std::string read_rows(const std::string& path);

/// Rows of numbers, from the second on where the first are names.
class Rows {
  public:
    /// Keeps references.
    Rows(std::string_view text, const std::string& path) : scanner(text, path) {}
    bool next();

    TextScanner scanner;
    std::vector<std::string> headings;  ///< in lower case, without quotes; empty where there are none

  private:
    bool first_ = true;
};

/// A word as a finite number; InputError naming file, line and `what` if it is none.
double finite(const TextScanner& row, std::size_t word, const char* what);
/// Three coordinates at most, from a word on; missing ones are 0.
Vec3 point_from(const TextScanner& row, std::size_t first_word);
Points to_points(const std::vector<Vec3>& list);

/// Points of rows of two or three coordinates, or of columns x, y and z. Coordinates along axes that a row
/// does not name are 0.
std::vector<Vec3> rows_of_points(const std::string& path);

}  // namespace varimap
