#pragma once

#include "varimap/quality/rings.h"

namespace varimap {

/// A tube (a shaft, a trunk, a limb) whose ends a map turns against each other.
struct Twist {
    double degrees = 0;
    int vertex = -1;  ///< of the source, about the middle of the tube; -1: none is twisted
    double area = 0;  ///< share of the source's
};

/// A tube and how it is twisted.
struct TwistedTube {
    Tube rings;
    Twist twist;
};

/// The most twisted of the source's tubes that are large (.15 of the area) and whose shear a twist explains.
/// An isometry's energy hardly resists: a shaft of length l and radius r that is twisted once around is
/// sheared by 2 pi r / l.
///
/// With u the distance along the source from one of its ends, e = grad u / |grad u|, n the normal and J the
/// map's differential on a triangle, a ring is a closed component of the triangles whose u lies in a band of
/// width h (rings.h). Of area a it is a / h around, and the map shears it by s, the mean of J e . J(n x e) /
/// |J(n x e)|, which turns its ends by s h / r against each other, r = a / (2 pi h) times the mean of |J(n x
/// e)|. Summed over rings behind each other that is the twist; it explains the shear where the rings' means
/// make up a quarter of the mean square or more: what shapes that differ need is of another sign on the other
/// side.
TwistedTube most_twisted(const Rings& rings);
Twist measure_twist(const PointMap& map, const TriangleMesh& source, const TriangleMesh& target);

}  // namespace varimap
