#pragma once

#include <nlohmann/json.hpp>

namespace varimap {

inline constexpr const char* draco_extension = "KHR_draco_mesh_compression";
inline constexpr const char* transform_extension = "KHR_texture_transform";

/// An object's member, or an empty object.
const nlohmann::json& member(const nlohmann::json& json, const char* name);
const nlohmann::json& extension(const nlohmann::json& json, const char* name);

/// Throws InputError, which does not name the file, where a glTF file says that it cannot be read without an
/// extension that is not read here.
void require_understood_extensions(const nlohmann::json& gltf);

}  // namespace varimap
