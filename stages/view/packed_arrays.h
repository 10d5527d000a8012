#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace varimap {

/// Where an array is: its first byte, how many numbers it has, and JavaScript's name of such an array.
struct ArrayPlace {
    std::size_t at, count;
    const char* type;
};

/// Arrays one after the other, each from a multiple of four bytes on.
class PackedArrays {
  public:
    template <class T>
    ArrayPlace add(const std::vector<T>& values, const char* type) {
        bytes_.append((4 - bytes_.size() % 4) % 4, '\0');
        const std::size_t at = bytes_.size();
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return {at, values.size(), type};
    }
    /// All of them, deflated (RFC 1950), in base64.
    std::string text() const;

  private:
    std::string bytes_;
};

std::string base64(std::string_view bytes);

}  // namespace varimap
