#include "stages/transfer/gltf.h"

#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/image/png_file.h"

namespace varimap {

namespace {

using Json = nlohmann::ordered_json;
constexpr int float_type = 5126, index_type = 5125;

/// The parts of a file: a description, and the numbers and images that it points into.
class Glb {
  public:
    Glb() { json_["asset"] = {{"version", "2.0"}, {"generator", "varimap"}}; }
    Json& json() { return json_; }

    template <class T>
    int add_view(const std::vector<T>& values) {
        return add_view({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
    }
    int add_view(std::string_view bytes) {
        json_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", bytes.size()}});
        data_ += bytes;
        data_.append((4 - data_.size() % 4) % 4, '\0');
        return int(json_["bufferViews"].size()) - 1;
    }
    int add_accessor(int view, int component, std::size_t count, const char* type) {
        json_["accessors"].push_back(
            {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
        return int(json_["accessors"].size()) - 1;
    }
    std::string bytes() {
        json_["buffers"] = Json::array({Json{{"byteLength", data_.size()}}});
        // Names in another encoding than UTF-8 would make the file invalid.
        std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
        text.append((4 - text.size() % 4) % 4, ' ');
        std::string out = "glTF" + word(2) + word(12 + 8 + text.size() + 8 + data_.size());
        out += word(text.size()) + "JSON" + text;
        return out + word(data_.size()) + std::string("BIN\0", 4) + data_;
    }

  private:
    static std::string word(std::size_t value) {
        if (value > std::numeric_limits<std::uint32_t>::max())
            throw IoError("the result is larger than a .glb may be (4 GB): choose another format");
        const auto number = std::uint32_t(value);
        return {reinterpret_cast<const char*>(&number), sizeof number};
    }
    Json json_;
    std::string data_;
};

/// The materials of a file and their images.
class MaterialList {
  public:
    MaterialList(Glb& glb, const GltfImageSource& image_of) : glb_(glb), image_of_(image_of) {}

    void add(const std::string& name, const Material* material) {
        Json surface{{"metallicFactor", 0}, {"roughnessFactor", .8}};
        Json entry{{"name", name}, {"doubleSided", true}};
        const Texture texture = material == nullptr ? Texture{} : texture_of(material->texture);
        const double opacity = material == nullptr ? 1 : material->opacity;
        if (texture.index >= 0) surface["baseColorTexture"] = placed(texture.index, *material);
        if (material != nullptr && (texture.index < 0 || opacity < 1)) {
            const Vec3 c = texture.index < 0 ? material->colour : Vec3(1, 1, 1);
            surface["baseColorFactor"] = {c[0], c[1], c[2], opacity};
        }
        if (texture.transparent || opacity < 1) entry["alphaMode"] = "BLEND";
        entry["pbrMetallicRoughness"] = surface;
        glb_.json()["materials"].push_back(entry);
    }

  private:
    struct Texture {
        int index = -1;
        bool transparent = false;
    };
    /// The texture where the material puts it; glTF counts v downwards.
    Json placed(int texture, const Material& material) {
        Json json{{"index", texture}};
        const Vec2 &scale = material.texture_scale, &offset = material.texture_offset;
        if (scale == Vec2::Ones() && offset == Vec2::Zero()) return json;
        const char* extension = "KHR_texture_transform";
        glb_.json()["extensionsUsed"] = {extension};
        json["extensions"][extension] = {{"offset", {offset[0], 1 - scale[1] - offset[1]}},
                                         {"scale", {scale[0], scale[1]}}};
        return json;
    }
    /// Of an image that several materials have, the same.
    Texture texture_of(const std::string& path) {
        if (path.empty()) return {};
        const auto [known, added] = textures_.try_emplace(path);
        if (added) known->second = add_texture(path);
        return known->second;
    }
    Texture add_texture(const std::string& path) {
        const GltfImage image = image_of_(path);
        const std::string type = media_type(image.bytes);
        if (type.empty()) {
            warn("{}: glTF takes PNG and JPEG images only; the .glb has the material's colour instead", path);
            return {};
        }
        const int view = glb_.add_view(image.bytes);
        glb_.json()["images"].push_back({{"bufferView", view}, {"mimeType", type}});
        glb_.json()["textures"].push_back({{"source", glb_.json()["images"].size() - 1}});
        return {int(glb_.json()["textures"].size()) - 1, image.transparent};
    }

    Glb& glb_;
    const GltfImageSource& image_of_;
    std::map<std::string, Texture> textures_;  ///< by the images' paths
};

/// One primitive: the faces of one material, a vertex for each pair of position and texture coordinates.
struct Primitive {
    std::vector<float> positions, uv;
    std::vector<std::uint32_t> corners;
    std::map<std::pair<int, int>, std::uint32_t> known;

    void add_corner(const TexturedMesh& textured, int f, int k) {
        const int v = textured.mesh.faces(f, k), t = textured.model.uv_of(f, k);
        const auto [entry, added] = known.try_emplace({v, t}, std::uint32_t(positions.size() / 3));
        corners.push_back(entry->second);
        if (!added) return;
        for (int axis = 0; axis < 3; ++axis) positions.push_back(float(textured.mesh.vertices(v, axis)));
        const Vec2 at = t < 0 ? Vec2(0, 1) : textured.model.uv[std::size_t(t)];
        uv.push_back(float(at[0]));
        uv.push_back(float(1 - at[1]));  // glTF counts v downwards
    }
};

Json primitive_json(Glb& glb, const Primitive& primitive, int material) {
    const std::size_t vertices = primitive.positions.size() / 3;
    const int positions = glb.add_accessor(glb.add_view(primitive.positions), float_type, vertices, "VEC3");
    const Eigen::Map<const Eigen::Matrix<float, 3, Eigen::Dynamic>> points(primitive.positions.data(), 3,
                                                                           Eigen::Index(vertices));
    const Eigen::Vector3f low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
    Json& accessor = glb.json()["accessors"][std::size_t(positions)];
    accessor["min"] = {low[0], low[1], low[2]};
    accessor["max"] = {high[0], high[1], high[2]};
    const int uv = glb.add_accessor(glb.add_view(primitive.uv), float_type, vertices, "VEC2");
    const int corners =
        glb.add_accessor(glb.add_view(primitive.corners), index_type, primitive.corners.size(), "SCALAR");
    Json json{{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uv}}}, {"indices", corners}};
    if (material >= 0) json["material"] = material;
    return json;
}

}  // namespace

GltfImage read_gltf_image(const std::string& path) {
    std::string bytes = read_file(path);
    const bool transparent = has_transparent_pixels(bytes);
    return {std::move(bytes), transparent};
}

std::string to_glb(const TexturedMesh& textured, const Materials& materials,
                   const GltfImageSource& image_of) {
    Glb glb;
    glb.json()["scene"] = 0;
    glb.json()["scenes"] = Json::array({Json{{"nodes", Json::array({0})}}});
    glb.json()["nodes"] = Json::array({Json{{"mesh", 0}}});
    MaterialList list_of_materials(glb, image_of);
    for (const std::string& name : textured.model.materials)
        list_of_materials.add(name, materials.find(name));
    std::map<int, Primitive> primitives;
    for (int f = 0; f < textured.mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k)
            primitives[textured.model.material[std::size_t(f)]].add_corner(textured, f, k);
    Json list = Json::array();
    for (const auto& [material, primitive] : primitives)
        list.push_back(primitive_json(glb, primitive, material));
    glb.json()["meshes"] = Json::array({Json{{"primitives", list}}});
    return glb.bytes();
}

}  // namespace varimap
