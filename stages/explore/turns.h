#pragma once

#include <vector>

#include "stages/explore/finished_pool.h"

namespace varimap {

/// What a map becomes where one of the surfaces is turned in space before, or after: about a principal axis,
/// by an angle by which it comes to lie nearly on itself. Bolts, teeth and handles look nearly the same from
/// several sides; of their maps exploration finds one, which energies hardly tell from the right one, and
/// what is found of their self-maps is rough. The best few by their cues, which differ from each other and
/// from the map; none for surfaces that no turn brings near to themselves.
std::vector<PooledMap> turned_about_axes(const Appraised& map, const PairContext& context,
                                         const Appraisal& appraisal);

/// What a map becomes where the target is turned by a half about a principal axis, before: of bodies that are
/// much the same from front and back exploration may find the one map alone, and all it compares that with
/// are other ends of the same limbs. The best two by their cues.
std::vector<PooledMap> turned_by_halves(const Appraised& map, const PairContext& context,
                                        const Appraisal& appraisal);

}  // namespace varimap
