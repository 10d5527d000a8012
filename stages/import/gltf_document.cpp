#include "stages/import/private/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string_view>

#include "stages/import/private/gltf_extensions.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/printable.h"
#include "varimap/mesh_files/number_type.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* damaged = "is a damaged glTF file (is it truncated?)";

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
    std::uint32_t value;
    if (at > bytes.size() || bytes.size() - at < sizeof value) throw InputError(damaged);
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

std::string_view part_of(std::string_view bytes, std::size_t begin, std::size_t size) {
    if (begin > bytes.size() || size > bytes.size() - begin) throw InputError(damaged);
    return bytes.substr(begin, size);
}

/// What a file consists of: its JSON, and the buffer that a .glb may hold besides.
struct Chunks {
    std::string_view json;
    std::optional<std::string_view> buffer;
};

Chunks chunks_of_glb(std::string_view bytes) {
    constexpr std::size_t header = 12, chunk_header = 8;
    constexpr std::uint32_t json_type = 0x4e4f534a, buffer_type = 0x004e4942;
    Chunks chunks;
    for (std::size_t at = header; at + chunk_header <= bytes.size();) {
        const std::uint32_t size = word_at(bytes, at), type = word_at(bytes, at + 4);
        const std::string_view chunk = part_of(bytes, at + chunk_header, size);
        if (type == json_type && chunks.json.empty()) chunks.json = chunk;
        if (type == buffer_type && !chunks.buffer) chunks.buffer = chunk;
        at += chunk_header + (std::size_t(size) + 3) / 4 * 4;
    }
    return chunks;
}

bool is_glb(std::string_view bytes) {
    return bytes.starts_with("glTF");
}

int hex_digit(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/// %20 is a blank.
std::string without_escapes(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
        text += low >= 0 ? char(16 * high + low) : uri[i];
        if (low >= 0) i += 2;
    }
    return text;
}

/// The name of a file that a URI means; as it stands where a program wrote it without escapes.
std::string file_name_of(const std::string& uri, const fs::path& folder) {
    std::error_code failure;
    return fs::is_regular_file(folder / uri, failure) ? uri : without_escapes(uri);
}

bool is_data(std::string_view uri) {
    return uri.starts_with("data:");
}

std::string from_base64(std::string_view text) {
    std::array<int, 256> value;
    value.fill(-1);
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i) value[static_cast<unsigned char>(digits[i])] = int(i);
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text.substr(0, text.find('='))) {
        const int digit = value[static_cast<unsigned char>(c)];
        if (digit < 0) throw InputError("a buffer's data: URI is not base64");
        bits = bits << 6 | unsigned(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += char(bits >> count & 0xff);
    }
    return bytes;
}

std::string bytes_of_uri(const std::string& uri, const fs::path& folder) {
    if (is_data(uri)) {
        const std::size_t begin = uri.find(";base64,");
        if (begin == uri.npos) throw InputError("a buffer's data: URI is not base64");
        return from_base64(std::string_view(uri).substr(begin + 8));
    }
    const std::string name = file_name_of(uri, folder);
    std::error_code failure;
    if (!fs::is_regular_file(folder / name, failure))
        throw InputError(fmt::format("its buffer {} is not there", printable(name)));
    return read_file((folder / name).string());
}

/// Puts all buffers into one, and lets bufferViews name it.
void join_buffers(GltfDocument& document, const std::optional<std::string_view>& own,
                  const fs::path& folder) {
    Json& json = document.json;
    std::vector<std::size_t> begin, size;
    const Json buffers = json.value("buffers", Json::array());
    json.erase("buffers");
    for (const Json& buffer : buffers) {
        const bool is_own = begin.empty() && own && !buffer.contains("uri");
        if (!is_own && !buffer.contains("uri")) throw InputError("a buffer is neither in the file nor named");
        const std::string bytes = is_own ? std::string(*own) : bytes_of_uri(buffer.at("uri"), folder);
        begin.push_back(document.bytes.size());
        size.push_back(buffer.at("byteLength").get<std::size_t>());
        if (size.back() > bytes.size())
            throw InputError(fmt::format("buffer {} has {} bytes, where {} are promised (is it truncated?)",
                                         size.size() - 1, bytes.size(), size.back()));
        document.bytes.append(bytes, 0, size.back());
        document.bytes.append((4 - document.bytes.size() % 4) % 4, '\0');
    }
    if (!json.contains("bufferViews")) return;
    for (Json& view : json["bufferViews"]) {
        const std::size_t buffer = view.at("buffer").get<std::size_t>();
        const std::size_t offset = view.value("byteOffset", std::size_t(0));
        if (buffer >= size.size() || offset > size[buffer] ||
            view.at("byteLength").get<std::size_t>() > size[buffer] - offset)
            throw InputError("a bufferView goes beyond its buffer (is the file truncated?)");
        view["buffer"] = 0;
        view["byteOffset"] = begin[buffer] + offset;
    }
}

void name_image_files(Json& json, const fs::path& folder) {
    if (!json.contains("images")) return;
    for (Json& image : json["images"])
        if (image.contains("uri") && !is_data(image["uri"].get<std::string>()))
            image["uri"] = file_name_of(image["uri"], folder);
}

NumberType type_of_components(int code) {
    switch (code) {
        case 5120:
            return number_type<std::int8_t>();
        case 5121:
            return number_type<std::uint8_t>();
        case 5122:
            return number_type<std::int16_t>();
        case 5123:
            return number_type<std::uint16_t>();
        case 5125:
            return number_type<std::uint32_t>();
        case 5126:
            return number_type<float>();
        default:
            throw InputError(fmt::format("an accessor has the unknown component type {}", code));
    }
}

/// What stands for 1 in integers that are normalized.
double largest_of_components(int code) {
    return code == 5120 ? 127 : code == 5121 ? 255 : code == 5122 ? 32767 : code == 5123 ? 65535 : 1;
}

std::size_t components_of(const std::string& type) {
    constexpr std::array names{"SCALAR", "VEC2", "VEC3", "VEC4"};
    const auto found = std::find(names.begin(), names.end(), type) - names.begin();
    if (found == std::ssize(names)) throw InputError(fmt::format("an accessor has the type '{}'", type));
    return std::size_t(found) + 1;
}

/// `count` elements, of which `source` names the bufferView and where they begin in it.
std::vector<double> elements(const GltfDocument& document, const Json& source, int component_type,
                             std::size_t components, std::size_t count) {
    const NumberType type = type_of_components(component_type);
    const Json& view = document.json.at("bufferViews").at(source.at("bufferView").get<std::size_t>());
    std::string_view bytes =
        part_of(document.bytes, view.at("byteOffset").get<std::size_t>(), view.at("byteLength"));
    const std::size_t offset = source.value("byteOffset", std::size_t(0));
    bytes = part_of(bytes, offset, bytes.size() - std::min(offset, bytes.size()));
    const std::size_t width = components * std::size_t(type.bytes);
    const std::size_t stride = view.value("byteStride", width);
    if (stride < width ||
        (count > 0 && (bytes.size() < width || count - 1 > (bytes.size() - width) / stride)))
        throw InputError("an accessor goes beyond its bufferView (is the file truncated?)");
    std::vector<double> numbers;
    numbers.reserve(count * components);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < components; ++k)
            numbers.push_back(type.read(bytes.data() + i * stride + k * std::size_t(type.bytes)));
    return numbers;
}

/// Elements that an accessor gives by their numbers.
void put_sparse(const GltfDocument& document, const Json& sparse, int component_type, std::size_t components,
                std::vector<double>& numbers) {
    const auto count = sparse.at("count").get<std::size_t>();
    const Json& places = sparse.at("indices");
    const auto place = elements(document, places, places.at("componentType"), 1, count);
    const auto values = elements(document, sparse.at("values"), component_type, components, count);
    for (std::size_t i = 0; i < count; ++i) {
        if (!(place[i] >= 0 && place[i] < double(numbers.size() / components)))
            throw InputError("a sparse accessor goes beyond its count");
        const auto begin = std::size_t(place[i]) * components;
        std::copy_n(values.begin() + std::ptrdiff_t(i * components), components,
                    numbers.begin() + std::ptrdiff_t(begin));
    }
}

}  // namespace

std::optional<GltfDocument> read_gltf(const std::string& path) {
    const std::string bytes = read_file(path);
    if (is_glb(bytes) && word_at(bytes, 4) == 1) return {};
    const Chunks chunks = is_glb(bytes) ? chunks_of_glb(bytes) : Chunks{bytes, {}};
    GltfDocument document;
    document.json = Json::parse(chunks.json, nullptr, false);
    if (!document.json.is_object()) throw InputError("is not a glTF file, or a damaged one");
    if (document.json.at("asset").at("version").get<std::string>().starts_with("1.")) return {};
    require_understood_extensions(document.json);
    const fs::path folder = fs::path(path).parent_path();
    join_buffers(document, chunks.buffer, folder);
    name_image_files(document.json, folder);
    return document;
}

std::vector<double> accessor_numbers(const GltfDocument& document, std::size_t index) {
    const Json& accessor = document.json.at("accessors").at(index);
    const int type = accessor.at("componentType").get<int>();
    const std::size_t components = components_of(accessor.at("type"));
    const auto count = accessor.at("count").get<std::size_t>();
    std::vector<double> numbers = accessor.contains("bufferView")
                                      ? elements(document, accessor, type, components, count)
                                      : std::vector<double>(count * components, 0);
    if (accessor.contains("sparse")) put_sparse(document, accessor["sparse"], type, components, numbers);
    if (accessor.value("normalized", false))
        for (double& number : numbers) number = std::max(number / largest_of_components(type), -1.0);
    return numbers;
}

std::size_t append_accessor(GltfDocument& document, const std::vector<double>& numbers,
                            std::size_t components) {
    const std::map<std::size_t, const char*> names{
        {1, "SCALAR"}, {2, "VEC2"}, {3, "VEC3"}, {4, "VEC4"}, {16, "MAT4"}};
    constexpr int of_floats = 5126;
    const std::size_t begin = document.bytes.size();
    for (const double number : numbers) number_type<float>().append(number, document.bytes);
    Json &views = document.json["bufferViews"], &accessors = document.json["accessors"];
    views.push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", document.bytes.size() - begin}});
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", of_floats},
                         {"count", numbers.size() / components},
                         {"type", names.at(components)}});
    return accessors.size() - 1;
}

std::string to_glb(const GltfDocument& document) {
    Json json = document.json;
    if (!document.bytes.empty()) json["buffers"] = Json::array({{{"byteLength", document.bytes.size()}}});
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.append((4 - text.size() % 4) % 4, ' ');
    const std::size_t size = 12 + 8 + text.size() + 8 + document.bytes.size();
    if (size > UINT32_MAX) throw InputError("more than 4 GB are not read; save it as OBJ or PLY");
    std::string glb = "glTF";
    const auto append_word = [&](std::size_t value) {
        const auto word = std::uint32_t(value);
        glb.append(reinterpret_cast<const char*>(&word), sizeof word);
    };
    append_word(2);
    append_word(size);
    append_word(text.size());
    glb += "JSON" + text;
    append_word(document.bytes.size());
    glb += std::string("BIN\0", 4) + document.bytes;
    return glb;
}

}  // namespace varimap
