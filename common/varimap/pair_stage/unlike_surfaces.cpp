#include "varimap/pair_stage/unlike_surfaces.h"

#include <algorithm>
#include <cmath>

#include "varimap/core/log.h"
#include "varimap/mesh/handles.h"
#include "varimap/mesh/topology.h"
#include "varimap/spectral/local_shape.h"

namespace varimap {

namespace {

/// In units of sqrt(area). A person cut at the waist has .9, a head .8, a leg or an arm .3; holes of scans
/// mostly less than .2.
constexpr double long_loop = 0.25;
/// Of that loop: where the other's longest is no longer, it has no such opening.
constexpr double much_shorter = 0.5;

double opening(const Surface& surface) {
    return longest_boundary(surface.input) / std::sqrt(surface_area(surface.input));
}

void warn_of_part(double own, double other, const char* which, const char* whole) {
    if (own < long_loop || other > much_shorter * own) return;
    warn(
        "the {} looks like a part of the {}: it ends at a loop of {:.2f} sqrt(area), where the {} has none "
        "beyond {:.2f}; "
        "a part is stretched over the whole, so cut the {} to the same part",
        which, whole, own, whole, other, whole);
}

}  // namespace

void warn_of_part(const Surface& A, const Surface& B) {
    if (!A.is_surface() || !B.is_surface()) return;
    const double a = opening(A), b = opening(B);
    warn_of_part(a, b, "source", "target");
    warn_of_part(b, a, "target", "source");
}

void warn_of_genus(const Surface& A, const Surface& B) {
    if (!A.is_surface() || !B.is_surface()) return;
    const int a = summarise_topology(A.mesh).genus, b = summarise_topology(B.mesh).genus;
    if (a == b || std::max(a, b) > most_handles) return;  // of noise some is left by preprocessing
    warn(
        "the source has genus {}, the target {}: every map between them folds or leaves something out; "
        "handles and tunnels that are noise are cut by --cut-handles LENGTH",
        a, b);
}

void warn_of_inside_out(const Surface& A, const Surface& B) {
    if (!A.is_surface() || !B.is_surface() || A.mirrored || B.mirrored) return;
    if (!is_closed(A.mesh) || !is_closed(B.mesh)) return;
    const bool A_is = looks_inward(A), B_is = looks_inward(B);
    if (A_is != B_is)
        warn(
            "the {} is inside out: its faces look inward, so that it counts as a mirror image; reverse its "
            "faces, or give --mirror",
            A_is ? "source" : "target");
}

}  // namespace varimap
