#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// What an OBJ file says of its faces beyond the mesh that read_mesh makes of it.
struct ObjModel {
    std::vector<Vec2> uv;       ///< texture coordinates; v runs upwards
    Faces uv_of;                ///< per triangle: those of its corners; -1 where a face has none
    std::vector<int> material;  ///< per triangle: of `materials`; -1: none
    std::vector<std::string> materials;
    std::vector<std::string> libraries;  ///< files of materials, as the OBJ names them

    bool has_uv() const { return uv_of.size() > 0 && uv_of.minCoeff() >= 0; }
};

/// `path` is for messages. Throws InputError naming the line.
ObjModel parse_obj_model(std::string_view bytes, const std::string& path);

/// The same file with other vertices: polygons, texture coordinates, materials, groups and all orders stay.
/// Normals, which would be wrong, are left out; materials are read from `library` (none where it is empty),
/// and the axes that are stated are those of `space`. `turned`: with the corners of every polygon in the
/// opposite order, the first in front. Throws InputError where there are not as many vertices.
std::string with_vertices(std::string_view obj, const Points& vertices, Space space,
                          const std::string& library, const std::string& path, bool turned = false);

/// A surface with texture coordinates.
struct TexturedMesh {
    TriangleMesh mesh;
    ObjModel model;
};
/// Faces without a material stand first, else all in their order.
std::string to_obj(const TexturedMesh& textured, const std::string& library);

/// A material as far as it is looked at.
struct Material {
    std::string name;
    Vec3 colour = Vec3::Constant(.8);
    double opacity = 1;
    std::string texture;  ///< path of the image; empty: none
    /// Where texture coordinates lie on the image: times the scale, plus the offset.
    Vec2 texture_scale = Vec2::Ones(), texture_offset = Vec2::Zero();
};

/// The libraries of an OBJ file.
struct Materials {
    std::vector<Material> list;
    std::string text;  ///< one MTL file of all; images are named without folders
    std::vector<std::pair<std::string, std::string>> images;  ///< that it names: name there, path

    /// None where no library holds it.
    const Material* find(const std::string& name) const;
};
/// Whether the image of that path may be called so beside the MTL file.
using ImageNameCheck = std::function<bool(const std::string& name, const std::string& path)>;
/// Keywords count in either case. A library whose name is no file may be several, split by blanks. Images
/// whose name is another's, or not free, get a number behind it. Throws IoError where a library or an image
/// is missing, naming who wants it.
Materials read_materials(
    const ObjModel& model, const std::string& obj_path,
    const ImageNameCheck& is_free = [](const std::string&, const std::string&) { return true; });

/// "image/png" or "image/jpeg", by an image's first bytes; empty for other formats.
std::string media_type(std::string_view image);

}  // namespace varimap
