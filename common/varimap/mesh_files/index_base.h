#pragma once

#include <array>

#include "varimap/core/enum_names.h"

namespace varimap {

/// Number of a file's first vertex. automatic: what else is in the file decides.
enum class IndexBase : int { zero = 0, one = 1, automatic = 2 };
template <>
struct EnumNames<IndexBase> {
    static constexpr std::array names{"0", "1", "auto"};
};
/// That number, where nothing else decides: automatic is 0.
inline int number_of_first(IndexBase base) {
    return base == IndexBase::one ? 1 : 0;
}

}  // namespace varimap
