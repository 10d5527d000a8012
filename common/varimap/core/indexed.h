#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace varimap {

/// One value per element of a mesh, addressed by the int that numbers the element. `Kind` tells vertices from
/// faces, so that values of one kind are not taken for those of the other. One block of memory, as of
/// std::vector, which it converts from (moved in, or by an explicit copy) and to. A flag (T = bool) is a char
/// of its own, so that several threads may write different ones.
template <class Kind, class T>
class PerElement {
  public:
    using Value = std::conditional_t<std::is_same_v<T, bool>, char, T>;
    using value_type = Value;

    PerElement() = default;
    explicit PerElement(int count, const Value& value = Value()) : values_(std::size_t(count), value) {}
    PerElement(std::vector<Value>&& values) : values_(std::move(values)) {}
    explicit PerElement(const std::vector<Value>& values) : values_(values) {}

    int size() const { return int(values_.size()); }
    Value& operator[](int i) { return values_[std::size_t(i)]; }
    const Value& operator[](int i) const { return values_[std::size_t(i)]; }
    auto begin() { return values_.begin(); }
    auto begin() const { return values_.begin(); }
    auto end() { return values_.end(); }
    auto end() const { return values_.end(); }
    operator const std::vector<Value>&() const { return values_; }

    bool operator==(const PerElement&) const = default;

  private:
    std::vector<Value> values_;
};

/// One value per vertex, or per face, by its number.
template <class T>
using VertexData = PerElement<struct OfVertices, T>;
template <class T>
using FaceData = PerElement<struct OfFaces, T>;

}  // namespace varimap
