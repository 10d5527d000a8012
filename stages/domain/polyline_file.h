#pragma once

#include <string>

#include "stages/domain/domain_file.h"

namespace varimap {

/// Points in their order, from rows of coordinates; closed where the last is the first. Edges are without
/// lengths. Throws IoError and InputError naming file and line.
DomainFile polyline_from_rows(const std::string& path);
/// The v and l lines of an OBJ.
DomainFile polyline_from_obj(const std::string& path);

}  // namespace varimap
