#include "stages/import/scene.h"

#include <assimp/config.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <iterator>

#include "stages/import/model_parts.h"
#include "stages/import/plain_gltf.h"
#include "stages/import/private/assimp_materials.h"
#include "stages/import/private/assimp_object.h"
#include "stages/import/source_meshes.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/lower_case.h"

namespace varimap {
namespace {

std::string ending_of(const std::string& path) {
    return lower_case(std::filesystem::path(path).extension().string());
}

bool is_gltf(const std::string& ending) {
    return ending == ".gltf" || ending == ".glb" || ending == ".vrm";
}

/// Formats whose vertices are the file's own; of others assimp may give every corner one.
bool has_vertices_of_its_own(const std::string& ending) {
    constexpr const char* endings[] = {".3mf", ".ply", ".off", ".stl"};
    return is_gltf(ending) || std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
}

std::vector<PolygonSoup> source_meshes(const std::string& ending, const std::string& path) {
    if (ending == ".fbx") return fbx_meshes(read_file(path));
    if (ending == ".dae") return collada_meshes(read_file(path));
    return {};
}

class SceneReader {
  public:
    SceneReader(const aiScene& scene, const std::string& path)
        : scene_(scene),
          ending_(ending_of(path)),
          meshes_(source_meshes(ending_, path)),
          materials_(scene, path, result_) {}

    ImportedScene read() {
        if (is_gltf(ending_)) places_ = places_of(scene_);
        add(*scene_.mRootNode, Affine::Identity());
        if (!has_uv_) result_.uv.clear();
        return std::move(result_);
    }

  private:
    void add(const aiNode& node, const Affine& parent) {
        const Affine here = composed(parent, to_affine(node.mTransformation));
        if (node.mNumMeshes > 0) {
            // The joints of a glTF's skin alone say where it stands.
            const bool is_skin = is_gltf(ending_) && has_skin(scene_, node);
            SceneObject object = object_of(scene_, node, is_skin ? places_ : Places());
            if (!has_vertices_of_its_own(ending_)) share_vertices(meshes_, object);
            place(object, is_skin ? Affine(Affine::Identity()) : here);
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], here);
    }

    void place(const SceneObject& object, const Affine& here) {
        if (object.soup.ends.empty()) return;
        ++result_.objects;
        PolygonSoup& soup = result_.soup;
        const auto first = static_cast<long long>(soup.points.size());
        const bool is_placed = here != Affine::Identity();
        for (const Vec3& x : object.soup.points)
            soup.points.push_back(is_placed ? Vec3(here * x.homogeneous()) : x);
        const bool mirrors = here.leftCols<3>().determinant() < 0;
        has_uv_ = has_uv_ && !object.uv.empty();
        for (std::size_t p = 0; p < object.soup.ends.size(); ++p) {
            const std::size_t begin = polygon_begin(object.soup, p), end = object.soup.ends[p];
            for (std::size_t k = begin; k < end; ++k) {
                // The first corner stays the first: polygons are cut from there.
                const std::size_t at = mirrors && k > begin ? begin + (end - k) : k;
                soup.corners.push_back(first + object.soup.corners[at]);
                if (has_uv_) result_.uv.push_back(object.uv[at]);
            }
            soup.end_polygon();
            result_.material.push_back(materials_.number_of(object.material[p]));
        }
    }

    const aiScene& scene_;
    std::string ending_;
    std::vector<PolygonSoup> meshes_;
    Places places_;  ///< of all nodes, where skins may need them
    ImportedScene result_;
    MaterialReader materials_;
    bool has_uv_ = true;
};

/// Assimp's, which lives as long as `importer`; as assimp reads it right.
const aiScene* assimp_scene(const std::string& path, Assimp::Importer& importer,
                            std::vector<std::string>& left_out) {
    // Else a file of nodes alone gets a mesh that stands for them.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    if (!is_gltf(ending_of(path))) return importer.ReadFile(path, 0);
    PlainGltf plain = plain_gltf(path);
    left_out = std::move(plain.left_out);
    if (plain.glb.empty()) return importer.ReadFile(path, 0);
    return importer.ReadFileFromMemory(plain.glb.data(), plain.glb.size(), 0, "glb");
}

bool has_colours(const aiScene& scene) {
    return std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes,
                       [](const aiMesh* mesh) { return mesh->HasVertexColors(0); });
}

/// Assimp would look for such parts among those of the same number in the one file that it reads.
void refuse_other_parts(const std::string& path) {
    if (ending_of(path) == ".3mf" && model_parts_in_3mf(read_file(path)) > 1)
        throw InputError(path +
                         ": it has parts in files of their own inside it (the production extension of 3MF), "
                         "which are not read; export it as STL or OBJ");
}

bool has_texture_coordinates(const aiScene& scene) {
    return std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes,
                       [](const aiMesh* mesh) { return mesh->HasTextureCoords(0); });
}

}  // namespace

bool is_importable(const std::string& path) {
    const std::string ending = ending_of(path);
    return ending.size() > 1 && Assimp::Importer().IsExtensionSupported(ending);
}

ImportedScene read_scene(const std::string& path) {
    refuse_other_parts(path);
    Assimp::Importer importer;
    std::vector<std::string> left_out;
    const aiScene* scene = assimp_scene(path, importer, left_out);
    if (scene == nullptr || scene->mRootNode == nullptr)
        throw InputError(fmt::format("{}: cannot be read: {}", path, importer.GetErrorString()));
    if (has_colours(*scene)) left_out.emplace_back("colours of vertices are left out");
    ImportedScene result;
    try {
        result = SceneReader(*scene, path).read();
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
    if (result.uv.empty() && has_texture_coordinates(*scene))
        left_out.emplace_back(
            "texture coordinates are left out, since a part of the scene has none; give it some, or export "
            "it without that part");
    result.left_out = std::move(left_out);
    if (result.soup.ends.empty()) throw InputError(path + ": the file holds no faces");
    return result;
}

}  // namespace varimap
