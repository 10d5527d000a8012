#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "stages/import/source_meshes.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {
namespace {

/// What stands in the way of understanding a file ends its reading.
struct FbxNotUnderstood {};

/// One Geometry, as far as it is read.
struct Geometry {
    std::vector<double> vertices;
    std::vector<long long> corners;  ///< the last one of a polygon is -1 - index

    PolygonSoup soup() const {
        PolygonSoup result;
        for (std::size_t i = 0; i + 2 < vertices.size(); i += 3)
            result.points.emplace_back(vertices[i], vertices[i + 1], vertices[i + 2]);
        std::vector<long long> polygon;
        for (const long long corner : corners) {
            const long long v = corner < 0 ? -1 - corner : corner;
            if (v >= static_cast<long long>(result.points.size())) throw FbxNotUnderstood();
            polygon.push_back(v);
            if (corner >= 0) continue;
            if (polygon.size() > 2) {  // others are points and lines
                result.corners.insert(result.corners.end(), polygon.begin(), polygon.end());
                result.end_polygon();
            }
            polygon.clear();
        }
        return result;
    }
};

/// Little-endian numbers of a file.
class Bytes {
  public:
    explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
    std::size_t at() const { return at_; }
    void go_to(std::size_t at) {
        if (at > bytes_.size()) throw FbxNotUnderstood();
        at_ = at;
    }
    std::string_view take(std::size_t count) {
        if (count > bytes_.size() - at_) throw FbxNotUnderstood();
        at_ += count;
        return bytes_.substr(at_ - count, count);
    }
    template <class T>
    T number() {
        static_assert(std::endian::native == std::endian::little);
        T value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }

  private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

std::string inflated(std::string_view bytes, std::size_t size) {
    // Deflate makes no more of it than 1032 times as much.
    if (size > 1040 * (bytes.size() + 1)) throw FbxNotUnderstood();
    std::string result(size, '\0');
    auto length = uLongf(size);
    if (uncompress(reinterpret_cast<Bytef*>(result.data()), &length,
                   reinterpret_cast<const Bytef*>(bytes.data()), uLong(bytes.size())) != Z_OK ||
        length != size)
        throw FbxNotUnderstood();
    return result;
}

template <class From, class To>
void copy_numbers(std::string_view raw, std::vector<To>& numbers) {
    for (std::size_t i = 0; i + sizeof(From) <= raw.size(); i += sizeof(From)) {
        From value;
        std::memcpy(&value, raw.data() + i, sizeof value);
        // A float beyond what an integer holds has no value as one.
        if (std::is_floating_point_v<From> && std::is_integral_v<To> && !(std::abs(double(value)) < 9e15))
            throw FbxNotUnderstood();
        numbers.push_back(To(value));
    }
}

/// The first property of a node, an array of numbers.
template <class T>
std::vector<T> array_property(Bytes& bytes) {
    const char type = bytes.take(1)[0];
    const std::size_t width = type == 'd' || type == 'l' ? 8 : type == 'f' || type == 'i' ? 4 : 0;
    if (width == 0) throw FbxNotUnderstood();
    const std::size_t count = bytes.number<std::uint32_t>();
    const bool is_deflated = bytes.number<std::uint32_t>() == 1;
    const std::string_view stored = bytes.take(bytes.number<std::uint32_t>());
    const std::string unpacked = is_deflated ? inflated(stored, count * width) : std::string(stored);
    std::vector<T> numbers;
    if (type == 'd') copy_numbers<double>(unpacked, numbers);
    if (type == 'f') copy_numbers<float>(unpacked, numbers);
    if (type == 'i') copy_numbers<std::int32_t>(unpacked, numbers);
    if (type == 'l') copy_numbers<std::int64_t>(unpacked, numbers);
    return numbers;
}

class BinaryFbx {
  public:
    explicit BinaryFbx(std::string_view bytes) : bytes_(bytes), size_(bytes.size()) {
        bytes_.take(23);
        is_wide_ = bytes_.number<std::uint32_t>() >= 7500;
    }
    std::vector<Geometry> read() {
        while (bytes_.at() < size_ && read_node(0)) {
        }
        return std::move(found_);
    }

  private:
    std::size_t offset() {
        return is_wide_ ? std::size_t(bytes_.number<std::uint64_t>()) : bytes_.number<std::uint32_t>();
    }
    /// False behind the last node of a list.
    bool read_node(int depth) {
        const std::size_t end = offset();
        offset();  // how many properties
        const std::size_t length = offset();
        const std::string_view name = bytes_.take(bytes_.number<std::uint8_t>());
        if (end == 0) return false;
        if (end < bytes_.at() || end > size_) throw FbxNotUnderstood();
        const std::size_t properties = bytes_.at();
        const bool is_geometry = depth == 1 && name == "Geometry";
        if (is_geometry) found_.emplace_back();
        if (depth == 2 && in_geometry_ && name == "Vertices")
            found_.back().vertices = array_property<double>(bytes_);
        if (depth == 2 && in_geometry_ && name == "PolygonVertexIndex")
            found_.back().corners = array_property<long long>(bytes_);
        bytes_.go_to(properties + std::min(length, size_));
        if ((depth == 0 && name == "Objects") || is_geometry) {
            in_geometry_ = is_geometry;
            while (bytes_.at() < end && read_node(depth + 1)) {
            }
            in_geometry_ = false;
        }
        bytes_.go_to(end);
        return true;
    }

    Bytes bytes_;
    std::size_t size_;
    bool is_wide_ = false, in_geometry_ = false;
    std::vector<Geometry> found_;
};

std::vector<Geometry> binary_geometries(std::string_view bytes) {
    try {
        return BinaryFbx(bytes).read();
    } catch (const FbxNotUnderstood&) {
        return {};
    }
}

/// The numbers behind `name: *count { a: ...}`, or, as old files have it, `name: ...`.
template <class Add>
void read_ascii_array(std::string_view text, Add add) {
    std::size_t at = text.find(':') + 1;
    const std::size_t line_end = text.find('\n', at);
    const std::size_t brace = text.substr(at, line_end - at).find('{');
    if (brace != text.npos) at = text.find("a:", at + brace) + 2;
    for (at = text.find_first_not_of(" \t\r\n", at); at < text.size();
         at = text.find_first_not_of(" \t\r\n,", at)) {
        const std::size_t end = std::min(text.find_first_of(" \t\r\n,}", at), text.size());
        if (!add(text.substr(at, end - at))) return;
        at = end;
    }
}

/// Quoted names may hold anything; lines of these tell the rest.
std::vector<Geometry> ascii_geometries(std::string_view text) {
    std::vector<Geometry> found;
    for (std::size_t line = 0; line < text.size();) {
        const std::size_t end = std::min(text.find('\n', line), text.size());
        const std::size_t word = std::min(text.find_first_not_of(" \t\r", line), end);
        const std::string_view here = text.substr(word, end - word);
        if (here.starts_with("Geometry:")) found.emplace_back();
        if (here.starts_with("Vertices:") && !found.empty() && found.back().vertices.empty())
            read_ascii_array(text.substr(word), [&](std::string_view number) {
                double value;
                if (!to_number(number, value)) return false;
                found.back().vertices.push_back(value);
                return true;
            });
        if (here.starts_with("PolygonVertexIndex:") && !found.empty() && found.back().corners.empty())
            read_ascii_array(text.substr(word), [&](std::string_view number) {
                long long value;
                if (!to_integer(number, value)) return false;
                found.back().corners.push_back(value);
                return true;
            });
        line = end + 1;
    }
    return found;
}

}  // namespace

std::vector<PolygonSoup> fbx_meshes(std::string_view bytes) {
    std::vector<PolygonSoup> result;
    const bool is_binary = bytes.starts_with("Kaydara FBX Binary");
    for (const Geometry& geometry : is_binary ? binary_geometries(bytes) : ascii_geometries(bytes)) {
        try {
            result.push_back(geometry.soup());
        } catch (const FbxNotUnderstood&) {
        }
    }
    return result;
}

}  // namespace varimap
