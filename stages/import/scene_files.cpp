#include "stages/import/scene_files.h"

#include <fmt/format.h>

#include <iterator>

namespace varimap {

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
