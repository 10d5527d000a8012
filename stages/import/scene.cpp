#include "stages/import/scene.h"

#include <assimp/config.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "stages/import/model_parts.h"
#include "stages/import/plain_gltf.h"
#include "stages/import/source_meshes.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/mesh/io/obj_model.h"

namespace varimap {
namespace {

std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& c : ending) c = char(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return ending;
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

/// The polygons of an object, which assimp parts by materials.
struct Object {
    PolygonSoup soup;
    std::vector<Eigen::Vector2d> uv;  ///< per corner, or none
    std::vector<unsigned> material;   ///< per polygon: assimp's
};

Vec3 to_vec3(const aiVector3D& v) {
    return {double(v.x), double(v.y), double(v.z)};
}

using Affine = Eigen::Matrix<double, 3, 4>;

Affine to_affine(const aiMatrix4x4& m) {
    Affine result;
    for (unsigned r = 0; r < 3; ++r)
        for (unsigned c = 0; c < 4; ++c) result(r, c) = double(m[r][c]);
    return result;
}

Affine composed(const Affine& outer, const Affine& inner) {
    Affine result;
    result.leftCols<3>() = outer.leftCols<3>() * inner.leftCols<3>();
    result.col(3) = outer.leftCols<3>() * inner.col(3) + outer.col(3);
    return result;
}

bool have_same_vertices(const aiMesh& a, const aiMesh& b) {
    return a.mNumVertices == b.mNumVertices &&
           std::equal(a.mVertices, a.mVertices + a.mNumVertices, b.mVertices,
                      [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; });
}

/// Where nodes stand, by their names.
using Places = std::map<std::string, Affine>;

void find_places(const aiNode& node, const Affine& parent, Places& places) {
    const Affine here = composed(parent, to_affine(node.mTransformation));
    places.emplace(node.mName.C_Str(), here);
    for (unsigned i = 0; i < node.mNumChildren; ++i) find_places(*node.mChildren[i], here, places);
}

std::vector<Vec3> vertices_of(const aiMesh& mesh) {
    std::vector<Vec3> points;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) points.push_back(to_vec3(mesh.mVertices[v]));
    return points;
}

/// Where the joints take the vertices of a skin; as they stand in the file if a joint is none of the nodes.
std::vector<Vec3> skinned_vertices_of(const aiMesh& mesh, const Places& joints) {
    const std::vector<Vec3> points = vertices_of(mesh);
    std::vector<Vec3> sum(points.size(), Vec3::Zero());
    std::vector<double> weights(points.size(), 0);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiBone& bone = *mesh.mBones[b];
        const auto joint = joints.find(bone.mName.C_Str());
        if (joint == joints.end()) return points;
        const Affine motion = composed(joint->second, to_affine(bone.mOffsetMatrix));
        for (unsigned w = 0; w < bone.mNumWeights; ++w) {
            const std::size_t v = bone.mWeights[w].mVertexId;
            if (v >= points.size()) throw InputError("a joint names a vertex that is not there");
            const auto weight = double(bone.mWeights[w].mWeight);
            sum[v] += weight * (motion * points[v].homogeneous());
            weights[v] += weight;
        }
    }
    for (std::size_t v = 0; v < points.size(); ++v) sum[v] = weights[v] > 0 ? sum[v] / weights[v] : points[v];
    return sum;
}

bool has_skin(const aiScene& scene, const aiNode& node) {
    return std::any_of(node.mMeshes, node.mMeshes + node.mNumMeshes,
                       [&](unsigned mesh) { return scene.mMeshes[mesh]->HasBones(); });
}

/// As assimp has them: vertices of several meshes one after the other; those that several share (primitives
/// of one accessor) once. Skins stand where `joints`, if there are any, take them.
Object object_of(const aiScene& scene, const aiNode& node, const Places& joints) {
    Object object;
    bool has_uv = true;
    const aiMesh* last = nullptr;
    long long first = 0;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
        has_uv = has_uv && mesh.HasTextureCoords(0);
        if (last == nullptr || !have_same_vertices(*last, mesh)) {
            first = static_cast<long long>(object.soup.points.size());
            const auto points = joints.empty() ? vertices_of(mesh) : skinned_vertices_of(mesh, joints);
            object.soup.points.insert(object.soup.points.end(), points.begin(), points.end());
        }
        last = &mesh;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices < 3) continue;
            for (unsigned k = 0; k < face.mNumIndices; ++k) {
                const unsigned v = face.mIndices[k];
                if (v >= mesh.mNumVertices) throw InputError("a face names a vertex that is not there");
                object.soup.corners.push_back(first + v);
                if (has_uv)
                    object.uv.emplace_back(double(mesh.mTextureCoords[0][v].x),
                                           double(mesh.mTextureCoords[0][v].y));
            }
            object.soup.end_polygon();
            object.material.push_back(mesh.mMaterialIndex);
        }
    }
    if (!has_uv) object.uv.clear();
    return object;
}

struct LessByCoordinates {
    bool operator()(const Vec3& a, const Vec3& b) const {
        return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    }
};

bool every_corner_has_a_vertex(const PolygonSoup& soup) {
    std::vector<char> used(soup.points.size(), 0);
    for (const long long v : soup.corners)
        if (std::exchange(used[std::size_t(v)], 1)) return false;
    return true;
}

/// Corners in the same place become one vertex.
void join_corners(PolygonSoup& soup) {
    std::map<Vec3, long long, LessByCoordinates> number;
    std::vector<Vec3> points;
    for (long long& corner : soup.corners) {
        const Vec3& place = soup.points[std::size_t(corner)];
        if (!place.allFinite()) {  // equal to nothing
            points.push_back(place);
            corner = static_cast<long long>(points.size()) - 1;
            continue;
        }
        const auto [entry, added] = number.try_emplace(place, static_cast<long long>(points.size()));
        if (added) points.push_back(place);
        corner = entry->second;
    }
    soup.points = std::move(points);
}

/// Assimp's numbers are of single precision, and it reads decimal ones in a way of its own.
bool same_place(const Vec3& a, const Vec3& b) {
    if (!a.allFinite() || !b.allFinite()) return a.allFinite() == b.allFinite();
    return (a - b).cwiseAbs().maxCoeff() <= 1e-5 * std::max(a.cwiseAbs().maxCoeff(), 1e-30);
}

std::size_t polygon_begin(const PolygonSoup& soup, std::size_t polygon) {
    return polygon == 0 ? 0 : soup.ends[polygon - 1];
}

bool same_polygon(const PolygonSoup& a, std::size_t i, const PolygonSoup& b, std::size_t j) {
    const std::size_t at = polygon_begin(a, i), other = polygon_begin(b, j), size = a.ends[i] - at;
    if (b.ends[j] - other != size) return false;
    for (std::size_t k = 0; k < size; ++k)
        if (!same_place(a.points[std::size_t(a.corners[at + k])],
                        b.points[std::size_t(b.corners[other + k])]))
            return false;
    return true;
}

/// Which polygon of the file's mesh each of the object's is: those of one material after those of another,
/// each in the file's order. Empty where they are not the same.
std::vector<std::size_t> polygons_in(const PolygonSoup& file, const PolygonSoup& object) {
    if (file.ends.size() != object.ends.size()) return {};
    std::vector<char> taken(file.ends.size(), 0);
    std::vector<std::size_t> result;
    std::size_t next = 0, passes = 0;
    for (std::size_t p = 0; p < object.ends.size(); ++p) {
        while (next < taken.size() && (taken[next] || !same_polygon(object, p, file, next))) ++next;
        if (next == taken.size()) {  // another material begins
            constexpr std::size_t most_materials = 1000;
            if (++passes > most_materials) return {};
            next = 0;
            while (next < taken.size() && (taken[next] || !same_polygon(object, p, file, next))) ++next;
            if (next == taken.size()) return {};
        }
        taken[next] = 1;
        result.push_back(next++);
    }
    return result;
}

/// The object with the points and polygons of the file's mesh that it is; false where it is none of these.
bool take_from(const std::vector<PolygonSoup>& meshes, Object& object) {
    for (const PolygonSoup& mesh : meshes) {
        const std::vector<std::size_t> place = polygons_in(mesh, object.soup);
        if (place.empty()) continue;
        std::vector<unsigned> material(place.size());
        for (std::size_t p = 0; p < place.size(); ++p) material[place[p]] = object.material[p];
        std::vector<Eigen::Vector2d> uv(object.uv.empty() ? 0 : mesh.corners.size());
        for (std::size_t p = 0; p < place.size() && !uv.empty(); ++p)
            std::copy(object.uv.begin() + std::ptrdiff_t(polygon_begin(object.soup, p)),
                      object.uv.begin() + std::ptrdiff_t(object.soup.ends[p]),
                      uv.begin() + std::ptrdiff_t(polygon_begin(mesh, place[p])));
        object = {mesh, std::move(uv), std::move(material)};
        return true;
    }
    return false;
}

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

/// The materials of a scene that its polygons have, numbered as they first appear.
class MaterialReader {
  public:
    MaterialReader(const aiScene& scene, const std::string& path, ImportedScene& result)
        : scene_(scene), path_(path), result_(result) {}

    /// -1 for assimp's own, which stands for none.
    int number_of(unsigned index) {
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

  private:
    std::string own_name(std::string name) {
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
    static Vec3 colour_of(const aiMaterial& material) {
        aiColor3D colour(1, 1, 1);
        material.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
        return {double(colour.r), double(colour.g), double(colour.b)};
    }
    int image_of(const aiMaterial& material) {
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
    SceneImage read_image(const char* name) const {
        if (const aiTexture* embedded = scene_.GetEmbeddedTexture(name)) {
            if (embedded->mHeight > 0) return {};  // pixels, of formats that nobody writes any more
            std::string bytes(reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth);
            return {image_ending(bytes, embedded->achFormatHint), std::move(bytes)};
        }
        const std::string file = find_image(path_, name);
        if (file.empty()) return {};
        std::string bytes = read_file(file), ending = ending_of(file);
        return {image_ending(bytes, std::string_view(ending).substr(std::min<std::size_t>(1, ending.size()))),
                std::move(bytes)};
    }

    const aiScene& scene_;
    const std::string& path_;
    ImportedScene& result_;
    std::map<unsigned, int> numbers_;
    std::map<std::string, int> images_;
    std::set<std::string> names_;
};

class SceneReader {
  public:
    SceneReader(const aiScene& scene, const std::string& path)
        : scene_(scene),
          ending_(ending_of(path)),
          meshes_(source_meshes(ending_, path)),
          materials_(scene, path, result_) {}

    ImportedScene read() {
        if (is_gltf(ending_)) find_places(*scene_.mRootNode, Affine::Identity(), places_);
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
            Object object = object_of(scene_, node, is_skin ? places_ : Places());
            if (!has_vertices_of_its_own(ending_) && !take_from(meshes_, object) &&
                every_corner_has_a_vertex(object.soup))
                join_corners(object.soup);
            place(object, is_skin ? Affine(Affine::Identity()) : here);
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], here);
    }

    void place(const Object& object, const Affine& here) {
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

}  // namespace

bool is_importable(const std::string& path) {
    const std::string ending = ending_of(path);
    return ending.size() > 1 && Assimp::Importer().IsExtensionSupported(ending);
}

namespace {

/// Assimp's, which lives as long as `importer`; as assimp reads it right.
const aiScene* assimp_scene(const std::string& path, Assimp::Importer& importer,
                            std::vector<std::string>& warnings) {
    // Else a file of nodes alone gets a mesh that stands for them.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    if (!is_gltf(ending_of(path))) return importer.ReadFile(path, 0);
    PlainGltf plain = plain_gltf(path);
    warnings = std::move(plain.warnings);
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

}  // namespace

ImportedScene read_scene(const std::string& path) {
    refuse_other_parts(path);
    Assimp::Importer importer;
    std::vector<std::string> warnings;
    const aiScene* scene = assimp_scene(path, importer, warnings);
    if (scene == nullptr || scene->mRootNode == nullptr)
        throw InputError(fmt::format("{}: cannot be read: {}", path, importer.GetErrorString()));
    if (has_colours(*scene)) warnings.emplace_back("colours of vertices are left out");
    ImportedScene result;
    try {
        result = SceneReader(*scene, path).read();
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
    result.warnings = std::move(warnings);
    if (result.soup.ends.empty()) throw InputError(path + ": the file holds no faces");
    return result;
}

namespace {

std::string image_name(const ImportedScene& scene, int image, const std::string& name) {
    return fmt::format("{}.{}{}", name, image, scene.images[std::size_t(image)].ending);
}

std::string to_mtl(const ImportedScene& scene, const std::string& name) {
    std::string text;
    for (const SceneMaterial& material : scene.materials) {
        text += fmt::format("newmtl {}\nKd {} {} {}\n", material.name, material.colour[0], material.colour[1],
                            material.colour[2]);
        if (material.image >= 0) text += fmt::format("map_Kd {}\n", image_name(scene, material.image, name));
    }
    return text;
}

/// Polygons without a material go to one of their own: behind a `usemtl` every polygon has one.
std::string to_obj(const ImportedScene& scene, const std::string& name) {
    const PolygonSoup& soup = scene.soup;
    fmt::memory_buffer text;
    const auto out = std::back_inserter(text);
    if (!scene.materials.empty()) fmt::format_to(out, "mtllib {}.mtl\n", name);
    for (const Vec3& x : soup.points) fmt::format_to(out, "v {} {} {}\n", x[0], x[1], x[2]);
    for (const auto& uv : scene.uv) fmt::format_to(out, "vt {} {}\n", uv[0], uv[1]);
    std::size_t corner = 0;
    int material = -1;
    for (std::size_t p = 0; p < soup.ends.size(); ++p) {
        const int now = scene.material[p];
        if (now != material)
            fmt::format_to(out, "usemtl {}\n", now < 0 ? "" : scene.materials[std::size_t(now)].name);
        material = now;
        fmt::format_to(out, "f");
        for (; corner < soup.ends[p]; ++corner) {
            fmt::format_to(out, " {}", soup.corners[corner] + 1);
            if (!scene.uv.empty()) fmt::format_to(out, "/{}", corner + 1);
        }
        fmt::format_to(out, "\n");
    }
    return fmt::to_string(text);
}

}  // namespace

SceneFiles to_files(const ImportedScene& scene, const std::string& name) {
    SceneFiles files{{name + ".obj", to_obj(scene, name)}};
    if (scene.materials.empty()) return files;
    files.emplace_back(name + ".mtl", to_mtl(scene, name));
    for (int image = 0; image < int(scene.images.size()); ++image)
        files.emplace_back(image_name(scene, image, name), scene.images[std::size_t(image)].bytes);
    return files;
}

}  // namespace varimap
