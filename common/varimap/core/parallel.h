#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace varimap {

/// Calls body(i) for i in [0, count), on several threads when there is enough work. `grain` is the number of
/// indices worth a task. Bodies write only what belongs to their index, so results do not depend on threads.
template <class Index, class Body>
void parallel_for_each_index(Index count, Index grain, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<Index>(0, count, grain),
                      [&](const tbb::blocked_range<Index>& range) {
                          for (Index i = range.begin(); i < range.end(); ++i) body(i);
                      });
}

}  // namespace varimap
