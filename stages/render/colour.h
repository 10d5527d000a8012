#pragma once

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

using Colour = Vec3;  ///< linear red, green, blue, from 0 to 1

/// Colours the points of the source: hue runs along its longest axis, with lightness and chroma along the
/// others, modulated by a checkerboard in space.
class SourceColour {
  public:
    /// `cell` is the edge of the checkerboard's cells, in the mesh's unit.
    SourceColour(const TriangleMesh& source, double cell);
    Colour operator()(const Vec3& point) const;

  private:
    Vec3 low_, extent_;
    int first_, second_, third_;  ///< axes, from the longest to the shortest
    double cell_;
};

inline const Colour unmapped_colour(.35, .35, .35);
inline const Colour flipped_colour(1, 0, .45);

/// OkLab (Ottosson 2020) lightness, chroma and hue in radians to linear sRGB, clipped.
Colour from_oklch(double lightness, double chroma, double hue);
/// Linear to sRGB-encoded, 0 to 255.
unsigned char encode_channel(double linear);

}  // namespace varimap
