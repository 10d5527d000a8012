#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "stages/transfer/text_rows.h"
#include "varimap/landmarks/landmark_points.h"

namespace varimap {

/// The text of a file of picked points (.mrk.json, .fcsv, .pp) with the positions of `points`, which are in
/// the file's order; nothing else changes, and nothing where a point is not defined.
std::string with_positions(const std::string& path, const std::string& bytes,
                           const std::vector<PickedPoint>& points);

/// Which columns hold x, y and z: those that the first row names so, or in each row three numbers beside
/// words that are none. Also the first row that holds a point. Throws InputError.
std::pair<std::array<std::size_t, 3>, std::size_t> coordinate_columns(const TextRows& rows,
                                                                      const std::string& path);
/// Throws InputError naming the line where a column is missing or no finite number.
Vec3 coordinates(const TextRow& row, const std::array<std::size_t, 3>& columns, const std::string& path);

}  // namespace varimap
