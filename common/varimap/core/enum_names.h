#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace varimap {

/// The names of an enumeration whose values are 0, 1, 2, ..., in that order: specialised beside it with
///   static constexpr std::array names{"...", ...};
template <class Enum>
struct EnumNames;

/// The name of one value, and those of all in their order.
template <class Enum>
std::string name_of(Enum value) {
    return EnumNames<Enum>::names[std::size_t(value)];
}

template <class Enum>
std::vector<std::string> names_of() {
    return {EnumNames<Enum>::names.begin(), EnumNames<Enum>::names.end()};
}

}  // namespace varimap
