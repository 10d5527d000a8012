#include "stages/import/plain_gltf.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "stages/import/private/gltf_document.h"
#include "stages/import/private/gltf_extensions.h"
#include "varimap/core/error.h"
#include "varimap/core/printable.h"

namespace varimap {
namespace {

using Json = nlohmann::json;

/// Where the file lists no scenes, all its nodes are one.
void require_scene(Json& json) {
    if (member(json, "scenes").empty()) {
        std::set<std::size_t> children;
        for (const Json& node : member(json, "nodes"))
            for (const Json& child : member(node, "children")) children.insert(child.get<std::size_t>());
        Json roots = Json::array();
        for (std::size_t node = 0; node < member(json, "nodes").size(); ++node)
            if (children.count(node) == 0) roots.push_back(node);
        json["scenes"] = Json::array({{{"nodes", roots}}});
    }
    if (!json.contains("scene")) json["scene"] = 0;
}

/// Which texture coordinates a material's base texture uses, and what they are turned into.
struct UvUse {
    int set = 0;
    std::array<double, 2> offset{0, 0}, scale{1, 1};
    double rotation = 0;

    bool is_plain() const { return offset == std::array{0., 0.} && scale == std::array{1., 1.} && !rotation; }
    /// In the file's order, v downwards.
    void apply(std::vector<double>& uv) const {
        const double c = std::cos(rotation), s = std::sin(rotation);
        for (std::size_t i = 0; i + 1 < uv.size(); i += 2) {
            const double u = scale[0] * uv[i], v = scale[1] * uv[i + 1];
            uv[i] = offset[0] + c * u + s * v;
            uv[i + 1] = offset[1] - s * u + c * v;
        }
    }
};

UvUse uv_use_of(const Json& material) {
    const Json& glossy = extension(material, "KHR_materials_pbrSpecularGlossiness");
    const Json& texture = glossy.contains("diffuseTexture")
                              ? glossy["diffuseTexture"]
                              : member(member(material, "pbrMetallicRoughness"), "baseColorTexture");
    const Json& transform = extension(texture, transform_extension);
    UvUse use;
    use.set = transform.value("texCoord", texture.value("texCoord", 0));
    use.offset = transform.value("offset", use.offset);
    use.scale = transform.value("scale", use.scale);
    use.rotation = transform.value("rotation", 0.);
    return use;
}

class Writer {
  public:
    explicit Writer(GltfDocument& document) : document_(document), json_(document.json) {}

    std::set<std::string> write() {
        require_scene(json_);
        json_.erase("animations");
        note_unread_images();
        if (json_.contains("meshes"))
            for (Json& mesh : json_["meshes"]) {
                mesh.erase("weights");
                for (Json& primitive : mesh.at("primitives")) make_plain(primitive);
            }
        if (json_.contains("skins")) {
            part_skinned_meshes();
            write_bind_matrices();
        }
        return std::move(left_out_);
    }

  private:
    void note_unread_images() {
        for (const Json& texture : member(json_, "textures"))
            if (!texture.contains("source"))
                for (const auto& item : member(texture, "extensions").items())
                    left_out_.insert(fmt::format("a texture has only an image that is not read ({})",
                                                 printable(item.key())));
    }

    void make_plain(Json& primitive) {
        const Json& given = primitive.at("attributes");
        for (const auto& item : given.items())
            if (item.key().starts_with("COLOR_")) left_out_.insert("colours of vertices are left out");
        if (primitive.erase("targets") > 0) left_out_.insert("blend shapes are left out");
        const UvUse use = uv_use_of(material_of(primitive));
        if (is_packed(primitive)) return leave_packed(primitive, use);
        primitive.erase("extensions");
        Json attributes = Json::object();
        for (const char* name : {"POSITION", "JOINTS_0", "WEIGHTS_0"})
            if (given.contains(name)) attributes[name] = given[name];
        for (const char* name : {"POSITION", "WEIGHTS_0"})
            if (attributes.contains(name)) attributes[name] = floats(attributes[name], {});
        const std::string uv = fmt::format("TEXCOORD_{}", use.set);
        if (given.contains(uv))
            attributes["TEXCOORD_0"] = floats(given[uv], use);
        else if (use.set != 0)
            left_out_.insert("a mesh lacks the texture coordinates that its material uses");
        primitive["attributes"] = std::move(attributes);
        require_vertices(primitive);
    }
    /// Assimp leaves out faces that name others.
    void require_vertices(const Json& primitive) const {
        const Json& attributes = primitive["attributes"];
        if (!primitive.contains("indices") || !attributes.contains("POSITION")) return;
        const Json& positions = json_.at("accessors").at(attributes["POSITION"].get<std::size_t>());
        const double count = positions.at("count");
        for (const double v : accessor_numbers(document_, primitive["indices"]))
            if (!(v < count)) throw InputError("a face names a vertex that is not there");
    }
    Json material_of(const Json& primitive) const {
        return primitive.contains("material")
                   ? json_.at("materials").at(primitive["material"].get<std::size_t>())
                   : Json::object();
    }
    /// Files may hold the numbers unpacked besides.
    bool is_packed(const Json& primitive) const {
        if (extension(primitive, draco_extension).empty()) return false;
        const auto positions = primitive["attributes"].at("POSITION").get<std::size_t>();
        return !json_.at("accessors").at(positions).contains("bufferView");
    }
    /// Assimp unpacks such meshes by itself: their numbers are not to be had here.
    void leave_packed(const Json& primitive, const UvUse& use) {
        if (use.set != 0 || !use.is_plain())
            left_out_.insert(
                fmt::format("texture coordinates are the first set as it stands, since meshes are "
                            "compressed ({}): {} and texCoord are not honoured",
                            draco_extension, transform_extension));
        if (primitive.contains("indices"))
            narrow_indices(primitive["indices"], primitive["attributes"].at("POSITION"));
    }
    /// Assimp 5.2 loses unpacked indices of four bytes, but writes them with two where that is asked for.
    void narrow_indices(std::size_t indices, std::size_t positions) {
        constexpr int of_words = 5125, of_ushorts = 5123, most_vertices = 65535;
        Json& accessors = json_.at("accessors");
        if (accessors.at(indices).at("componentType") != of_words) return;
        if (accessors.at(positions).at("count") > most_vertices)
            throw InputError(fmt::format(
                "its meshes are compressed ({}), which is read up to {} vertices; save it without",
                draco_extension, most_vertices));
        accessors[indices]["componentType"] = of_ushorts;
    }

    /// The accessor itself, or one with its numbers as floats, turned into what `use` makes of them.
    std::size_t floats(std::size_t accessor, const UvUse& use) {
        constexpr int of_floats = 5126;
        if (json_.at("accessors").at(accessor).at("componentType") == of_floats && use.is_plain())
            return accessor;
        const auto [entry, added] =
            written_.try_emplace({accessor, use.offset, use.scale, use.rotation}, std::size_t(0));
        if (!added) return entry->second;
        std::vector<double> numbers = accessor_numbers(document_, accessor);
        const auto count = json_.at("accessors").at(accessor).at("count").get<std::size_t>();
        const std::size_t components = count > 0 ? numbers.size() / count : 1;
        if (!use.is_plain() && components != 2) throw InputError("texture coordinates are not VEC2");
        if (!use.is_plain()) use.apply(numbers);
        return entry->second = append_accessor(document_, numbers, components);
    }

    /// Assimp hangs a skin on the mesh, which other nodes may show without it, and finds joints by their
    /// names, which may be the same.
    void part_skinned_meshes() {
        Json& nodes = json_.at("nodes");
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            nodes[i]["name"] = fmt::format("node {}", i);
            if (!nodes[i].contains("skin") || !nodes[i].contains("mesh")) continue;
            Json mesh = json_.at("meshes").at(nodes[i]["mesh"].get<std::size_t>());
            json_["meshes"].push_back(std::move(mesh));
            nodes[i]["mesh"] = json_["meshes"].size() - 1;
        }
    }

    /// A skin may leave out identities; assimp crashes where they are not there.
    void write_bind_matrices() {
        constexpr std::size_t size = 16, diagonal = 5;
        for (Json& skin : json_["skins"]) {
            if (skin.contains("inverseBindMatrices")) continue;
            std::vector<double> identities(size * skin.at("joints").size());
            for (std::size_t i = 0; i < identities.size(); ++i) identities[i] = i % size % diagonal == 0;
            skin["inverseBindMatrices"] = append_accessor(document_, identities, size);
        }
    }

    GltfDocument& document_;
    Json& json_;
    std::set<std::string> left_out_;
    std::map<std::tuple<std::size_t, std::array<double, 2>, std::array<double, 2>, double>, std::size_t>
        written_;
};

}  // namespace

PlainGltf plain_gltf(const std::string& path) {
    try {
        auto document = read_gltf(path);
        if (!document) return {};
        const std::set<std::string> left_out = Writer(*document).write();
        return {to_glb(*document), {left_out.begin(), left_out.end()}};
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", path, error.what()));
    } catch (const Json::exception&) {
        throw InputError(path + ": its JSON is not that of a glTF file");
    }
}

}  // namespace varimap
