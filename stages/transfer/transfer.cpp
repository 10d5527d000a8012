#include "stages/transfer/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <optional>
#include <set>

#include "stages/transfer/gltf.h"
#include "stages/transfer/points.h"
#include "stages/transfer/same_mesh.h"
#include "stages/transfer/seams.h"
#include "stages/transfer/shape.h"
#include "stages/transfer/values.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/counted.h"
#include "varimap/core/error.h"
#include "varimap/core/file_ending.h"
#include "varimap/core/log.h"
#include "varimap/core/printable.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_files/ply_columns.h"

namespace varimap {

namespace fs = std::filesystem;

namespace {

std::string name_of(const std::string& path) {
    return fs::path(path).filename().string();
}
std::string stem_of(const std::string& path) {
    return fs::path(path).stem().string();
}

/// Options that change nothing would hide that something else was meant.
void require_effect(const TransferRequest& request) {
    if (request.bake.pixels > 0 && request.texture.empty())
        throw UsageError("--bake draws what --texture carries: give --texture an OBJ of the source, too");
    if (!request.onto.empty() && request.bake.pixels == 0)
        throw UsageError("--onto says what to bake onto: give --bake a number of pixels, too");
    if (request.bake.padding >= 0 && request.bake.pixels == 0)
        throw UsageError("--padding is that of what is baked: give --bake a number of pixels, too");
    if (request.influences > 0 && request.weights.empty())
        throw UsageError("--influences says how many of --weights are kept: give a file of these, too");
    const LandmarkReading usual;
    if (request.reading.space != usual.space && request.points.empty())
        throw UsageError("--landmark-space says which axes --points have: give a file of these, too");
    if (request.reading.base != usual.base && request.points.empty())
        throw UsageError("--landmark-base says how --points count vertices: give a file of these, too");
}

/// Vertices without an image go where those near them went; that is a guess.
void warn_of_followers(const PointMap& map, const std::string& path) {
    const auto count =
        std::count_if(map.begin(), map.end(), [](const SurfacePoint& image) { return image.face < 0; });
    if (count > 0)
        warn("{}: {} the nearest vertices that have one", path,
             counted(count, "vertex has no image and follows", "vertices have no image; they follow"));
}

/// Materials that faces have and no library describes.
void warn_of_unknown_materials(const ObjModel& model, const Materials& materials, const std::string& path) {
    std::string names;
    for (const std::string& name : model.materials)
        if (materials.find(name) == nullptr) names += (names.empty() ? "" : ", ") + printable(name);
    if (!names.empty()) warn("{}: no library (mtllib) describes the materials {}", path, names);
}

/// Of those that the OBJ names: a library may hold others.
bool any_transparent(const Texture& texture) {
    const std::vector<std::string>& names = texture.model.materials;
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        const Material* material = texture.materials.find(name);
        return material && (material->opacity < 1 ||
                            (!material->texture.empty() && read_gltf_image(material->texture).transparent));
    });
}

/// One run: what is asked for, between what, and what came of it so far.
class Transfer {
  public:
    Transfer(const TransferRequest& request, const Correspondence& map, bool reverse)
        : request_(request),
          map_(map),
          reverse_(reverse),
          there_(map.from, map.there, map.to),
          back_(map.to, map.back, map.from) {}

    NamedFiles run() {
        for (const auto& path : request_.points)
            add(name_of(path), carry_points(path, request_.reading, map_, there_));
        for (const auto& path : request_.regions) add(name_of(path), carry_region(path, map_, back_));
        for (const auto& path : request_.values) add_values(path, ValueKind::number);
        for (const auto& path : request_.labels) add_values(path, ValueKind::label);
        for (const auto& path : request_.weights) add_values(path, ValueKind::weight);
        for (const auto& path : request_.shapes) add_shape(path);
        if (!request_.mesh.empty()) add_mesh(request_.mesh);
        if (!request_.texture.empty()) add_texture(request_.texture);
        return std::move(files_);
    }

  private:
    void add(const std::string& name, std::string bytes) {
        if (!names_.insert(name).second)
            throw UsageError("two results would be called " + name + "; carry one of them on its own");
        files_.emplace_back(name, std::move(bytes));
    }
    bool is_free(const std::string& name, const std::string& image) const;
    Materials read_materials_of(const ObjModel& model, const std::string& path) const;
    void add_values(const std::string& path, ValueKind kind);
    void add_shape(const std::string& path);
    void add_mesh(const std::string& path);
    void add_texture(const std::string& path);
    void add_cut(const Texture& texture, const std::string& name);
    void add_baked(const Texture& texture, const std::string& name);
    std::string add_materials(const Materials& materials, const std::string& name);
    std::string add_materials_of_shape(const ObjModel& model, const std::string& path,
                                       const std::string& name);
    TextureImage baked(const Texture& texture, const ObjModel& target, const std::string& target_file) const;

    const TransferRequest& request_;
    const Correspondence& map_;
    bool reverse_;
    PointCarrier there_, back_;
    NamedFiles files_;
    std::set<std::string> names_;
};

/// Whether nothing else is called so, in this run or where its results go.
bool Transfer::is_free(const std::string& name, const std::string& image) const {
    for (const auto& [other, bytes] : files_)
        if (other == name) return bytes == read_file(image);
    const fs::path there = fs::path(request_.folder) / name;
    std::error_code ignored;  // whoever writes there finds out
    if (request_.folder.empty() || !fs::exists(there, ignored)) return true;
    return fs::is_regular_file(there, ignored) && read_file(there.string()) == read_file(image);
}

Materials Transfer::read_materials_of(const ObjModel& model, const std::string& path) const {
    const auto free = [this](const std::string& name, const std::string& image) {
        return is_free(name, image);
    };
    Materials materials = read_materials(model, path, free);
    warn_of_unknown_materials(model, materials, path);
    return materials;
}

void Transfer::add_values(const std::string& path, ValueKind kind) {
    const ValueFile file = read_values(path, kind, map_.from, map_.from_file);
    std::vector<ValueTable> carried;
    for (const ValueTable& table : file.tables) {
        carried.push_back(carry_values(table, kind, map_, back_));
        if (kind == ValueKind::weight && request_.influences > 0)
            keep_largest(carried.back().values, request_.influences);
        const auto missing =
            (carried.back().values.array() != carried.back().values.array()).rowwise().all().count();
        if (missing > 0)
            warn("{}: {} rows have no values: no image, or values that are not numbers there", path, missing);
    }
    add(name_of(path), file.write(carried, map_.to));
}

void Transfer::add_shape(const std::string& path) {
    const TriangleMesh shape = read_mesh(path);
    require_same_mesh(same_faces(shape, map_.from), path, shape, map_.from_file, map_.from);
    const std::optional<LaidShape> laid = laid_onto(map_.from, shape.vertices);
    if (laid && laid->is_mirror_image)
        throw InputError(
            fmt::format("{}: is a mirror image of {}, or has two axes exchanged: mirror it back, or save "
                        "both with the same axes",
                        path, map_.from_file));
    if (laid)
        warn("{}: lies elsewhere than {}, or in other axes or units, and is laid onto it first", path,
             map_.from_file);
    const Points moved = carry_shape(map_, laid ? laid->vertices : shape.vertices);
    warn_of_followers(map_.back, map_.to_file);
    if (has_ending(map_.to_file, ".obj"))
        add(stem_of(path) + ".obj",
            with_vertices(read_file(map_.to_file), moved, map_.to.space, "", map_.to_file));
    else
        add(stem_of(path) + ".ply", to_ply({moved, map_.to.faces, map_.to.space}));
}

void Transfer::add_mesh(const std::string& path) {
    if (!has_ending(path, ".obj")) throw UsageError("--mesh " + path + ": give an OBJ file");
    const std::string bytes = read_file(path);
    const TriangleMesh mesh = parse_mesh(bytes, path);
    require_same_mesh(same_faces(mesh, map_.from) || same_vertices(mesh, map_.from), path, mesh,
                      map_.from_file, map_.from);
    const std::string name = reverse_ ? "target_on_source" : "source_on_target";
    const std::string library = add_materials_of_shape(parse_obj_model(bytes, path), path, name);
    warn_of_followers(map_.there, path);
    add(name + ".obj", with_vertices(bytes, carried_vertices(map_), map_.to.space, library, path,
                                     reverses_orientation(map_)));
}

void Transfer::add_texture(const std::string& path) {
    if (!has_ending(path, ".obj")) throw UsageError("--texture " + path + ": give an OBJ file");
    const std::string bytes = read_file(path);
    const TriangleMesh mesh = parse_mesh(bytes, path);
    require_same_mesh(same_faces(mesh, map_.from), path, mesh, map_.from_file, map_.from);
    const ObjModel model = parse_obj_model(bytes, path);
    if (!model.has_uv()) throw InputError(path + ": has faces without texture coordinates (vt)");
    const Materials materials = read_materials_of(model, path);
    const std::string name = stem_of(map_.to_file) + "_textured";
    if (request_.bake.pixels > 0)
        add_baked({model, materials}, name);
    else
        add_cut({model, materials}, name);
}

/// A shape does without what colours it. Returns what the OBJ names as its library.
std::string Transfer::add_materials_of_shape(const ObjModel& model, const std::string& path,
                                             const std::string& name) {
    if (model.libraries.empty()) return "";
    try {
        return add_materials(read_materials_of(model, path), name);
    } catch (const IoError& missing) {
        warn("{}; {}.obj is written without materials", missing.what(), name);
        return "";
    }
}

/// Returns what the OBJ names as its library: nothing where no material is described.
std::string Transfer::add_materials(const Materials& materials, const std::string& name) {
    if (materials.text.empty()) return "";
    add(name + ".mtl", materials.text);
    for (const auto& [image, path] : materials.images)
        if (!names_.contains(image)) add(image, read_file(path));
    return name + ".mtl";
}

void Transfer::add_cut(const Texture& texture, const std::string& name) {
    const TexturedMesh textured = cut_at_seams(map_, back_, texture.model);
    log("texture: {} vertices and {} faces, of {} and {}: faces are cut at seams",
        textured.mesh.vertex_count(), textured.mesh.face_count(), map_.to.vertex_count(),
        map_.to.face_count());
    const std::string library = add_materials(texture.materials, name);
    add(name + ".obj", to_obj(textured, library));
    add(name + ".glb", to_glb(textured, texture.materials));
}

TextureImage Transfer::baked(const Texture& texture, const ObjModel& target,
                             const std::string& target_file) const {
    try {
        return bake(map_, back_, texture, target, target_file, request_.bake);
    } catch (const std::bad_alloc&) {
        throw IoError(fmt::format("out of memory; use a smaller --bake than {}, or a machine with more",
                                  request_.bake.pixels));
    }
}

void Transfer::add_baked(const Texture& texture, const std::string& name) {
    const std::string& onto = request_.onto.empty() ? map_.to_file : request_.onto;
    const std::string lacks_coordinates = fmt::format(
        "{}: has no texture coordinates to bake onto; leave out --bake to have the source's cut onto it, or "
        "give --onto an OBJ that has some",
        onto);
    if (!has_ending(onto, ".obj")) throw UsageError(lacks_coordinates);
    const std::string bytes = read_file(onto);
    const TriangleMesh mesh = parse_mesh(bytes, onto);
    require_same_mesh(same_faces(mesh, map_.to), onto, mesh, map_.to_file, map_.to);
    TexturedMesh target{map_.to, parse_obj_model(bytes, onto)};
    if (!target.model.has_uv()) throw InputError(lacks_coordinates);
    const std::string image = to_png(baked(texture, target.model, onto));
    target.model.materials = {"baked"};
    std::fill(target.model.material.begin(), target.model.material.end(), 0);
    const Material material{.name = "baked", .texture = name + ".png"};
    // The image is transparent beside the patches as well, where nothing is drawn.
    const auto drawn = [&](const std::string&) { return GltfImage{image, any_transparent(texture)}; };
    add(name + ".obj", to_obj(target, name + ".mtl"));
    add(name + ".mtl", fmt::format("newmtl baked\nKd 1 1 1\nmap_Kd {}.png\n", name));
    add(name + ".glb", to_glb(target, {.list = {material}, .text = {}, .images = {}}, drawn));
    add(name + ".png", image);
}

}  // namespace

NamedFiles transfer(const TransferRequest& request, const Correspondence& map, bool reverse) {
    require_effect(request);
    return Transfer(request, map, reverse).run();
}

}  // namespace varimap
