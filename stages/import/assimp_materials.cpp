#include "stages/import/private/assimp_materials.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "varimap/artifact/artifact.h"
#include "varimap/core/lower_case.h"
#include "varimap/mesh_files/obj_model.h"

namespace varimap {

namespace {

/// An image's first bytes tell its format; else a word of the file, if it can end a name.
std::string image_ending(const std::string& bytes, std::string_view word) {
    const std::string type = media_type(bytes);
    if (!type.empty()) return type == "image/png" ? ".png" : ".jpg";
    const bool is_plain = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    });
    return is_plain ? fmt::format(".{}", word) : ".image";
}

/// Where an image is that a scene names, perhaps as it was called on the machine that wrote it; or "".
std::string find_image(const std::string& scene_path, std::string name) {
    namespace fs = std::filesystem;
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path folder = fs::path(scene_path).parent_path();
    std::error_code failure;
    for (const fs::path& path : {folder / name, folder / fs::path(name).filename()})
        if (fs::is_regular_file(path, failure)) return path.string();
    return "";
}

Vec3 colour_of(const aiMaterial& material) {
    aiColor3D colour(1, 1, 1);
    material.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    return {double(colour.r), double(colour.g), double(colour.b)};
}

}  // namespace

int MaterialReader::number_of(unsigned index) {
    const auto [entry, added] = numbers_.try_emplace(index, -1);
    if (!added || index >= scene_.mNumMaterials) return entry->second;
    const aiMaterial& material = *scene_.mMaterials[index];
    aiString name;
    material.Get(AI_MATKEY_NAME, name);
    if (std::string_view(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME) return -1;
    entry->second = int(result_.materials.size());
    result_.materials.push_back({own_name(name.C_Str()), colour_of(material), image_of(material)});
    return entry->second;
}

std::string MaterialReader::own_name(std::string name) {
    // OBJ files know neither blanks at the ends of names nor empty ones; # begins a comment there.
    for (char& c : name)
        if (static_cast<unsigned char>(c) < ' ' || c == '#' || c == '\\') c = ' ';
    name.erase(0, std::min(name.find_first_not_of(' '), name.size()));
    name.erase(name.find_last_not_of(' ') + 1);
    if (name.empty()) name = "material";
    const std::string stem = name;
    for (int number = 2; !names_.insert(name).second;) name = fmt::format("{}.{}", stem, number++);
    return name;
}

int MaterialReader::image_of(const aiMaterial& material) {
    aiString name;
    if (material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != AI_SUCCESS &&
        material.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != AI_SUCCESS)
        return -1;
    const auto [entry, added] = images_.try_emplace(name.C_Str(), -1);
    if (!added) return entry->second;
    SceneImage image = read_image(name.C_Str());
    if (image.bytes.empty()) {
        result_.missing_images.emplace_back(name.C_Str());
        return -1;
    }
    entry->second = int(result_.images.size());
    result_.images.push_back(std::move(image));
    return entry->second;
}

SceneImage MaterialReader::read_image(const char* name) const {
    if (const aiTexture* embedded = scene_.GetEmbeddedTexture(name)) {
        if (embedded->mHeight > 0) return {};  // pixels, of formats that nobody writes any more
        std::string bytes(reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth);
        return {image_ending(bytes, embedded->achFormatHint), std::move(bytes)};
    }
    const std::string file = find_image(path_, name);
    if (file.empty()) return {};
    std::string bytes = read_file(file), word = lower_case(std::filesystem::path(file).extension().string());
    word.erase(0, 1);  // the dot
    return {image_ending(bytes, word), std::move(bytes)};
}

}  // namespace varimap
