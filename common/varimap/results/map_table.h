#pragma once

#include <string>
#include <string_view>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// One direction of a map as a table: `vertex,face,b0,b1,b2`, one row per vertex; numbers read back exactly,
/// in any locale.
std::string to_csv(const PointMap& map);
/// Throws InputError naming file and line.
PointMap read_csv_map(const std::string& path);
/// Whether the first line is that of such a table.
bool is_csv_map(std::string_view bytes);
/// The same of the bytes of such a table; `path` is named in messages.
PointMap parse_csv_map(std::string_view bytes, const std::string& path);
/// Throws InputError, beginning with `place`, for a point that is neither nowhere nor has barycentric
/// coordinates in [0, 1] of sum 1, to the few digits of other programs; `faces`: their number, if known.
void require_near_surface(const SurfacePoint& point, const std::string& place, int faces = -1);

}  // namespace varimap
