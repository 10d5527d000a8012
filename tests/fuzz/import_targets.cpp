#include <stdexcept>

#include "fixtures/scenes.h"
#include "fuzz/target.h"
#include "stages/import/source_meshes.h"

namespace varimap::fuzz {
namespace {

void require_sound(const std::vector<PolygonSoup>& meshes) {
    for (const PolygonSoup& mesh : meshes) {
        for (const long long corner : mesh.corners)
            if (corner < 0 || corner >= static_cast<long long>(mesh.points.size()))
                throw std::logic_error("a corner is no point");
        if (!mesh.ends.empty() && mesh.ends.back() > mesh.corners.size())
            throw std::logic_error("a polygon ends behind the corners");
    }
}

}  // namespace

std::vector<Target> import_targets() {
    return {{"fbx",
             {scenes::binary_fbx(true), scenes::binary_fbx(false), scenes::text_fbx()},
             {"Geometry", "Vertices", "PolygonVertexIndex", "a:", "*21", "-1", "{", "}"},
             [](const std::string& bytes) { require_sound(fbx_meshes(bytes)); }},
            {"collada",
             {scenes::collada()},
             {"<p>", "</p>", "<vcount>", "offset=\"1\"", "POSITION", "VERTEX", "polylist", "triangles",
              "<!--", "-->", "stride=\"3\""},
             [](const std::string& bytes) { require_sound(collada_meshes(bytes)); }}};
}

}  // namespace varimap::fuzz
