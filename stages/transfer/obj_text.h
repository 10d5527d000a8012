#pragma once

#include <string>
#include <string_view>

namespace varimap {

/// The text that with_vertices (obj_model.h) makes, with the corners of every polygon in the opposite order,
/// the first in front.
std::string with_turned_polygons(std::string_view obj);

}  // namespace varimap
