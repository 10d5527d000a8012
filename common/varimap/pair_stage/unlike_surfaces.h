#pragma once

#include "varimap/results/correspondences.h"
#include "varimap/surface/surface.h"

namespace varimap {

/// Warns where one surface is likely a part of the other: its largest component is open, as a limb that was
/// cut off, much wider than that of the other, both by their areas; a hole in a wall is no such opening
/// (boundary.h). A part is mapped onto the whole of the other all the same, and stretched for it. And where
/// both have several long loops, not as many, which are holes at other places then. Not where the whole
/// was cut to the part (part_region.h).
void warn_of_part(const Surface& A, const Surface& B);

/// Warns where the surfaces differ in genus: no map between them is one to one. Beyond 20 handles it is
/// noise.
void warn_of_genus(const Surface& A, const Surface& B);

/// Warns where one of two surfaces is inside out (one_is_inside_out).
void warn_of_inside_out(const Surface& A, const Surface& B);

/// Warns of points of A's input with images on B's (correspondences_of) that are no map to begin from: the
/// images gather in one place, or neighbours have places far from each other, as if drawn by lot, or most of
/// A is mirrored.
void warn_of_bad_initial_map(const PointPairs& from_A, const Surface& A, const Surface& B);

}  // namespace varimap
