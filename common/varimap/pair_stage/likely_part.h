#pragma once

#include "varimap/mesh/surface.h"

namespace varimap {

/// Warns where one surface is likely a part of the other: it is open along a loop much longer than any of the
/// other, both by their areas. A part is mapped onto the whole of the other all the same, and stretched for
/// it.
void warn_of_part(const Surface& A, const Surface& B);

}  // namespace varimap
