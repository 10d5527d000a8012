#include "stages/view/texture.h"

#include <fmt/format.h>

#include <array>
#include <map>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/parallel.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_files/obj_model.h"

namespace varimap {

namespace {

constexpr std::size_t most_bytes = 6 << 20;  ///< of an image: pages stay below 15 MB

Vec2 coordinates(const ObjModel& model, int face, const Vec3& barycentric) {
    Vec2 uv = Vec2::Zero();
    for (int k = 0; k < 3; ++k) uv += barycentric[k] * model.uv[std::size_t(model.uv_of(face, k))];
    return uv;
}

/// Barycentric coordinates on a face's plane of the point below p.
Vec3 on_plane(const TriangleMesh& mesh, int face, const Vec3& p) {
    const Vec3 a = mesh.vertex(mesh.faces(face, 0)), u = mesh.vertex(mesh.faces(face, 1)) - a,
               v = mesh.vertex(mesh.faces(face, 2)) - a, w = p - a, n = u.cross(v);
    if (!(n.squaredNorm() > 0)) return Vec3::Constant(1 / 3.);
    const double second = w.cross(v).dot(n) / n.squaredNorm(), third = u.cross(w).dot(n) / n.squaredNorm();
    return {1 - second - third, second, third};
}

using Corners = std::array<Vec2, 3>;
const Corners nowhere{Vec2(-1, -1), Vec2(-1, -1), Vec2(-1, -1)};

/// Of a face of the target: where its corners lie in the texture. Across a seam they would lie far from each
/// other: there the texture goes on beyond its rim as it is under the face's middle.
Corners carried_corners(const Correspondence& map, const PointCarrier& back, const ObjModel& model,
                        int face) {
    const SurfacePoint middle = back({face, Vec3::Constant(1 / 3.)});
    if (middle.face < 0) return nowhere;
    const Vec2 centre = coordinates(model, middle.face, middle.barycentric);
    Corners corners;
    for (int k = 0; k < 3; ++k) {
        const SurfacePoint& image = map.back[std::size_t(map.to.faces(face, k))];
        if (image.face < 0) return nowhere;
        const Vec2 own = coordinates(model, image.face, image.barycentric);
        const Vec2 beyond =
            coordinates(model, middle.face, on_plane(map.from, middle.face, position(map.from, image)));
        const double reach = (beyond - centre).norm();
        corners[std::size_t(k)] = (own - beyond).norm() <= 2 * reach ? own : beyond;
    }
    return corners;
}

std::vector<float> flat(const std::vector<Corners>& faces) {
    std::vector<float> numbers;
    for (const Corners& corners : faces)
        for (const Vec2& uv : corners) numbers.push_back(float(uv[0])), numbers.push_back(float(uv[1]));
    return numbers;
}

/// The image of the material that most faces have and that has one.
const Material* commonest(const ObjModel& model, const Materials& materials) {
    std::map<int, int> count;
    for (const int m : model.material) ++count[m];
    const Material* best = nullptr;
    int most = 0;
    for (const auto& [m, faces] : count) {
        const Material* material = m < 0 ? nullptr : materials.find(model.materials[std::size_t(m)]);
        if (material != nullptr && !material->texture.empty() && faces > most) best = material, most = faces;
    }
    return best;
}

}  // namespace

std::optional<PageTexture> read_texture(const std::string& obj, const Correspondence& map) {
    const std::string bytes = read_file(obj);
    const ObjModel model = parse_obj_model(bytes, obj);
    if (!model.has_uv()) return {};
    const Materials materials = read_materials(model, obj);
    const Material* material = commonest(model, materials);
    if (material == nullptr) return {};
    if (parse_mesh(bytes, obj).faces != map.from.faces)
        throw InputError(
            fmt::format("{}: has other faces than {}, which the map starts from", obj, map.from_file));
    PageTexture texture;
    texture.image = read_file(material->texture);
    texture.type = media_type(texture.image);
    if (texture.type.empty())
        throw InputError(material->texture +
                         ": neither PNG nor JPEG, which pages show; save the texture as one");
    if (texture.image.size() > most_bytes)
        throw InputError(fmt::format("{}: {} MB are too much for a page; make it smaller than 6",
                                     material->texture, texture.image.size() >> 20));
    std::vector<Corners> source(std::size_t(map.from.face_count())), target(std::size_t(map.to.face_count()));
    for (int f = 0; f < map.from.face_count(); ++f)
        for (int k = 0; k < 3; ++k)
            source[std::size_t(f)][std::size_t(k)] = coordinates(model, f, Vec3::Unit(k));
    const PointCarrier back(map.to, map.back, map.from);
    parallel_for_each_index(map.to.face_count(), 256,
                            [&](int f) { target[std::size_t(f)] = carried_corners(map, back, model, f); });
    texture.source_uv = flat(source);
    texture.target_uv = flat(target);
    return texture;
}

}  // namespace varimap
