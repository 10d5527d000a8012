#pragma once

#include <vector>

#include "stages/render/panels.h"

namespace varimap {

/// Marks points of the panel's figure with white dots and numbers from 1, where nothing hides them. `letter`:
/// pixels per dot of the letters.
void draw_dots(const std::vector<Vec3>& points, const Panel& panel, int letter, Image& image);

}  // namespace varimap
