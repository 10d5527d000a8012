#pragma once

#include <cstddef>
#include <functional>

namespace varimap {

/// Calls body(begin, end) for ranges that make up [0, count), on several threads when there is enough work.
/// `grain` is the number of indices worth a task. Which ranges they are differs from run to run: bodies write
/// only what belongs to an index, and nothing that they compute may depend on where a range ends.
void parallel_for_each_range(std::size_t count, std::size_t grain,
                             const std::function<void(std::size_t begin, std::size_t end)>& body);

/// The same, index by index.
template <class Index, class Body>
void parallel_for_each_index(Index count, Index grain, const Body& body) {
    parallel_for_each_range(std::size_t(count), std::size_t(grain), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(Index(i));
    });
}

}  // namespace varimap
