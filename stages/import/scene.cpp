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

#include "stages/import/source_meshes.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& c : ending) c = char(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return ending;
}

/// Formats whose vertices are the file's own; of others assimp may give every corner one.
bool has_vertices_of_its_own(const std::string& ending) {
    constexpr const char* endings[] = {".gltf", ".glb", ".vrm", ".3mf", ".ply", ".off", ".stl"};
    return std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
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

/// As assimp has them: vertices of several meshes one after the other; those that several share (primitives
/// of one accessor) once.
Object object_of(const aiScene& scene, const aiNode& node) {
    Object object;
    bool has_uv = true;
    const aiMesh* last = nullptr;
    long long first = 0;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
        has_uv = has_uv && mesh.HasTextureCoords(0);
        if (last == nullptr || !have_same_vertices(*last, mesh)) {
            first = static_cast<long long>(object.soup.points.size());
            for (unsigned v = 0; v < mesh.mNumVertices; ++v)
                object.soup.points.push_back(to_vec3(mesh.mVertices[v]));
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
        std::vector<Eigen::Vector2d> uv(object.uv.empty() ? 0 : mesh.corners.size());
        for (std::size_t p = 0; p < place.size() && !uv.empty(); ++p)
            std::copy(object.uv.begin() + std::ptrdiff_t(polygon_begin(object.soup, p)),
                      object.uv.begin() + std::ptrdiff_t(object.soup.ends[p]),
                      uv.begin() + std::ptrdiff_t(polygon_begin(mesh, place[p])));
        object = {mesh, std::move(uv)};
        return true;
    }
    return false;
}

class SceneReader {
  public:
    SceneReader(const aiScene& scene, const std::string& path)
        : scene_(scene), ending_(ending_of(path)), meshes_(source_meshes(ending_, path)) {}

    ImportedScene read() {
        add(*scene_.mRootNode, Affine::Identity());
        if (!has_uv_) result_.uv.clear();
        return std::move(result_);
    }

  private:
    void add(const aiNode& node, const Affine& parent) {
        const Affine here = composed(parent, to_affine(node.mTransformation));
        if (node.mNumMeshes > 0) {
            Object object = object_of(scene_, node);
            if (!has_vertices_of_its_own(ending_) && !take_from(meshes_, object) &&
                every_corner_has_a_vertex(object.soup))
                join_corners(object.soup);
            place(object, here);
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
                // The first corner stays the first: polygons are fanned from there.
                const std::size_t at = mirrors && k > begin ? begin + (end - k) : k;
                soup.corners.push_back(first + object.soup.corners[at]);
                if (has_uv_) result_.uv.push_back(object.uv[at]);
            }
            soup.end_polygon();
        }
    }

    const aiScene& scene_;
    std::string ending_;
    std::vector<PolygonSoup> meshes_;
    ImportedScene result_;
    bool has_uv_ = true;
};

}  // namespace

bool is_importable(const std::string& path) {
    const std::string ending = ending_of(path);
    return ending.size() > 1 && Assimp::Importer().IsExtensionSupported(ending);
}

ImportedScene read_scene(const std::string& path) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(path, 0);
    if (scene == nullptr || scene->mRootNode == nullptr)
        throw InputError(fmt::format("{}: cannot be read: {}", path, importer.GetErrorString()));
    ImportedScene result;
    try {
        result = SceneReader(*scene, path).read();
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
    if (result.soup.ends.empty()) throw InputError(path + ": the file holds no faces");
    return result;
}

std::string to_obj(const ImportedScene& scene) {
    const PolygonSoup& soup = scene.soup;
    fmt::memory_buffer text;
    const auto out = std::back_inserter(text);
    for (const Vec3& x : soup.points) fmt::format_to(out, "v {} {} {}\n", x[0], x[1], x[2]);
    for (const auto& uv : scene.uv) fmt::format_to(out, "vt {} {}\n", uv[0], uv[1]);
    std::size_t corner = 0;
    for (const std::size_t end : soup.ends) {
        fmt::format_to(out, "f");
        for (; corner < end; ++corner) {
            fmt::format_to(out, " {}", soup.corners[corner] + 1);
            if (!scene.uv.empty()) fmt::format_to(out, "/{}", corner + 1);
        }
        fmt::format_to(out, "\n");
    }
    return fmt::to_string(text);
}

}  // namespace varimap
