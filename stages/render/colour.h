#pragma once

#include <array>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

using Colour = Vec3;  ///< linear red, green, blue, from 0 to 1

/// Colours the points of the source: from dark blue to yellow along its longest axis, with a checkerboard in
/// space that is faint on one half of the second axis, and stripes on one half of the third, such as the left
/// (pattern_axes.h). Lightness alone tells all of it apart, which holds for eyes that do not see red and
/// green as two.
class SourceColour {
  public:
    /// `cell` is the edge of the checkerboard's cells, in the mesh's unit.
    SourceColour(const TriangleMesh& source, double cell);
    Colour operator()(const Vec3& point) const;

  private:
    Vec3 middle_;
    std::array<int, 3> axes_;  ///< pattern_axes
    double reach_ = 1, cell_;
};

inline const Colour unmapped_colour(.35, .35, .35);
inline const Colour flipped_colour(1, 0, .45);

/// OkLab (Ottosson 2020) lightness, chroma and hue in radians to linear sRGB, clipped.
Colour from_oklch(double lightness, double chroma, double hue);
/// Linear to sRGB-encoded, 0 to 255.
unsigned char encode_channel(double linear);

}  // namespace varimap
