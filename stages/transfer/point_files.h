#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stages/transfer/text_rows.h"
#include "varimap/landmarks/landmark_points.h"

namespace varimap {

/// The text of a file of picked points (.mrk.json, .fcsv, .pp, .pts) with the positions of `points`, which
/// are in the file's order; nothing else changes, and nothing where a point is not defined.
std::string with_positions(const std::string& path, const std::string& bytes,
                           const std::vector<PickedPoint>& points);

/// Whether three columns of headings are those of x, y and z.
bool names_coordinates(const std::vector<std::string>& headings);
/// Whether a column of that name holds a coordinate of normals: nx, normal_x, or Normals:0 as ParaView writes
/// it.
bool names_normal(std::string_view heading);

/// The first row in which nothing is missing (csv_fields.h), which tells what columns hold; else the first.
const TextRow& first_complete(const TextRows& rows);
/// Which columns hold x, y and z: those that the first row names so, or in each row three numbers beside
/// words that are none. Also the first row of points. Throws InputError.
std::pair<std::array<std::size_t, 3>, std::size_t> coordinate_columns(const TextRows& rows,
                                                                      const std::string& path);
/// Whether the row names a point and says that it is missing ("NA", "?" or nothing; csv_fields.h).
bool lacks_point(const TextRow& row, const std::array<std::size_t, 3>& columns);
/// Throws InputError naming the line where a column is missing or no finite number.
Vec3 coordinates(const TextRow& row, const std::array<std::size_t, 3>& columns, const std::string& path);

}  // namespace varimap
