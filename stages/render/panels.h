#pragma once

#include "stages/render/figure.h"
#include "stages/render/render.h"
#include "stages/render/view.h"

namespace varimap {

/// Lays out and traces both figures, each from its view (moved as the parameters say) and from the opposite
/// one.
Image draw_panels(const Figure& source, const View& source_view, const Figure& target,
                  const View& target_view, const RenderParams& params);

}  // namespace varimap
