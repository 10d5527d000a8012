#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace varimap {

/// Arrays one after the other, each from a multiple of four bytes on, and where each is.
class PackedArrays {
  public:
    /// Returns where it is: {"at": byte, "count": of numbers, "type": name of JavaScript's array}.
    template <class T>
    nlohmann::ordered_json add(const std::vector<T>& values, const char* type) {
        bytes_.append((4 - bytes_.size() % 4) % 4, '\0');
        const std::size_t at = bytes_.size();
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return {{"at", at}, {"count", values.size()}, {"type", type}};
    }
    /// All of them, deflated (RFC 1950), in base64.
    std::string text() const;

  private:
    std::string bytes_;
};

std::string base64(std::string_view bytes);

}  // namespace varimap
