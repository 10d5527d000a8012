#pragma once

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

namespace varimap {

static_assert(std::endian::native == std::endian::little, "binary files are read and written in place");

/// A type of numbers in binary files: its size, and how a number is read and written. Integers are rounded
/// and kept within what the type holds; what is no number is written as 0 there.
struct NumberType {
    int bytes = 0;
    double (*read)(const char*) = nullptr;
    void (*append)(double, std::string&) = nullptr;
};

/// Rounded, and kept within what T holds; 0 for NaN where T is an integer.
template <class T>
T nearest_of_type(double number) {
    if constexpr (std::is_integral_v<T>) {
        using Limits = std::numeric_limits<T>;
        if (std::isnan(number)) return 0;
        if (number <= double(Limits::lowest())) return Limits::lowest();
        return number >= double(Limits::max()) ? Limits::max() : T(std::round(number));
    } else {
        return T(number);
    }
}

/// T as it stands in memory.
template <class T>
NumberType number_type() {
    return {int(sizeof(T)),
            [](const char* at) {
                T value;
                std::memcpy(&value, at, sizeof value);
                return double(value);
            },
            [](double number, std::string& bytes) {
                const T value = nearest_of_type<T>(number);
                bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
            }};
}

}  // namespace varimap
