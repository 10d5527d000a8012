#include "stages/import/private/gltf_extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "varimap/core/error.h"
#include "varimap/core/printable.h"

namespace varimap {

using Json = nlohmann::json;

const Json& member(const Json& json, const char* name) {
    static const Json none = Json::object();
    const auto found = json.find(name);
    return found == json.end() ? none : *found;
}

const Json& extension(const Json& json, const char* name) {
    return member(member(json, "extensions"), name);
}

namespace {

/// Those that change nothing of what is read here, or that are read.
bool is_understood(std::string_view name) {
    constexpr std::string_view families[] = {
        "KHR_materials_", "EXT_materials_", "ADOBE_materials_", "KHR_xmp",
        "KHR_audio",      "KHR_lights_",    "EXT_lights_",      "VRM"};
    constexpr std::string_view names[] = {
        draco_extension,    transform_extension, "KHR_mesh_quantization", "KHR_texture_basisu",
        "EXT_texture_webp", "EXT_texture_avif",  "MSFT_texture_dds",      "KHR_animation_pointer"};
    return std::ranges::find(names, name) != std::end(names) ||
           std::ranges::any_of(families, [&](std::string_view family) { return name.starts_with(family); });
}

}  // namespace

void require_understood_extensions(const Json& gltf) {
    for (const Json& item : member(gltf, "extensionsRequired")) {
        const std::string name = item.get<std::string>();
        if (name.ends_with("_meshopt_compression"))
            throw InputError(fmt::format(
                "its meshes are compressed ({}), which is not read; save it without, for example by gltfpack "
                "without -c",
                name));
        if (!is_understood(name))
            throw InputError(fmt::format(
                "needs the extension {}, which is not read; save it without, or from Blender as OBJ or PLY",
                printable(name)));
    }
}

}  // namespace varimap
