#include <algorithm>
#include <map>

#include "stages/import/source_meshes.h"
#include "varimap/mesh_files/text_scanner.h"
#include "varimap/mesh_files/xml_tags.h"

namespace varimap {
namespace {

struct ColladaNotUnderstood {};

template <class T, class Convert>
std::vector<T> numbers(std::string_view text, Convert convert) {
    std::vector<T> result;
    for (std::size_t at = text.find_first_not_of(" \t\r\n"); at < text.size();
         at = text.find_first_not_of(" \t\r\n", at)) {
        const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
        T value;
        if (!convert(text.substr(at, end - at), value)) throw ColladaNotUnderstood();
        result.push_back(value);
        at = end;
    }
    return result;
}

std::vector<long long> integers(std::string_view text) {
    return numbers<long long>(text, to_integer);
}

long long integer_or(std::string_view text, long long fallback) {
    long long value;
    return to_integer(text, value) ? value : fallback;
}

std::string_view without_mark(std::string_view reference) {
    return reference.starts_with('#') ? reference.substr(1) : reference;
}

/// What is read of one <mesh>.
class MeshReader {
  public:
    void read(const XmlTag& tag) {
        const std::string_view name = tag.name;
        if (name == "source") {
            source_ = tag.attribute("id");
        } else if (name == "float_array") {
            floats_[source_] = numbers<double>(tag.text, to_number);
        } else if (name == "accessor" && !source_.empty()) {
            stride_[source_] = std::size_t(std::clamp(integer_or(tag.attribute("stride"), 3), 1LL, 64LL));
        } else if (name == "vertices" || name == "/vertices") {
            in_vertices_ = name[0] != '/';
        } else if (name == "triangles" || name == "polylist" || name == "polygons") {
            primitive_ = name;
            vertex_offset_ = width_ = 0;
            sizes_.clear();
        } else if (name == "input") {
            read_input(tag);
        } else if (name == "vcount") {
            sizes_ = integers(tag.text);
        } else if (name == "p" && !primitive_.empty()) {
            add(integers(tag.text));
        } else if (!primitive_.empty() && name.starts_with('/') && name.substr(1) == primitive_) {
            primitive_ = {};
        }
    }
    PolygonSoup soup() {
        const std::vector<double>& x = floats_[positions_];
        const std::size_t stride = stride_.count(positions_) ? stride_[positions_] : 3;
        for (std::size_t i = 0; i + 2 < x.size(); i += stride)
            soup_.points.emplace_back(x[i], x[i + 1], x[i + 2]);
        for (const long long v : soup_.corners)
            if (v < 0 || v >= static_cast<long long>(soup_.points.size())) throw ColladaNotUnderstood();
        return std::move(soup_);
    }

  private:
    void read_input(const XmlTag& tag) {
        const std::string_view semantic = tag.attribute("semantic");
        if (in_vertices_ && semantic == "POSITION") positions_ = without_mark(tag.attribute("source"));
        if (in_vertices_ || primitive_.empty()) return;
        const auto offset = std::size_t(std::clamp(integer_or(tag.attribute("offset"), 0), 0LL, 64LL));
        width_ = std::max(width_, offset + 1);
        if (semantic == "VERTEX") vertex_offset_ = offset;
    }
    void add(const std::vector<long long>& indices) {
        if (width_ == 0) throw ColladaNotUnderstood();
        const std::size_t count = indices.size() / width_;
        std::size_t next = 0;
        const auto polygon = [&](std::size_t size) {
            if (size > count - next) throw ColladaNotUnderstood();
            for (std::size_t k = 0; k < size; ++k)
                if (size > 2) soup_.corners.push_back(indices[(next + k) * width_ + vertex_offset_]);
            if (size > 2) soup_.end_polygon();
            next += size;
        };
        if (primitive_ == "polygons") {
            polygon(count);
        } else if (primitive_ == "triangles") {
            while (next + 3 <= count) polygon(3);
        } else {
            for (const long long size : sizes_) polygon(size < 0 ? count + 1 : std::size_t(size));
        }
    }

    std::map<std::string_view, std::vector<double>> floats_;
    std::map<std::string_view, std::size_t> stride_;
    std::string_view source_, positions_, primitive_;
    bool in_vertices_ = false;
    std::size_t vertex_offset_ = 0, width_ = 0;
    std::vector<long long> sizes_;
    PolygonSoup soup_;
};

}  // namespace

std::vector<PolygonSoup> collada_meshes(std::string_view text) {
    std::vector<PolygonSoup> result;
    XmlTags tags(text);
    XmlTag tag;
    while (tags.next(tag)) {
        if (tag.name != "mesh" || tag.closes_itself) continue;
        MeshReader mesh;
        try {
            while (tags.next(tag) && tag.name != "/mesh") mesh.read(tag);
            result.push_back(mesh.soup());
        } catch (const ColladaNotUnderstood&) {
        }
    }
    return result;
}

}  // namespace varimap
