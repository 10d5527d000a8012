#pragma once

#include "varimap/relaxation/untangling.h"

namespace varimap {

/// untangle (untangling.h); and where it leaves a tube twisted, such as a shaft (quality/twist.h), which the
/// energy of an isometry hardly resists, once more from the maps with the twist taken out. Those that are
/// nearer to isometries are kept. Landmarks that hold the twist leave it.
UntanglingReports untangle_untwisted(MapPair& maps, const TriangleMesh& A, const TriangleMesh& B,
                                     const PinnedPair& pinned, const UntanglingOptions& options);

}  // namespace varimap
