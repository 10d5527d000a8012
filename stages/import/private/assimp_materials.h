#pragma once

#include <assimp/scene.h>

#include <map>
#include <set>
#include <string>

#include "stages/import/scene.h"

namespace varimap {

/// The materials of a scene that its polygons have, numbered as they first appear, and their images.
class MaterialReader {
  public:
    /// `path`: of the scene's file, beside which images are looked for.
    MaterialReader(const aiScene& scene, const std::string& path, ImportedScene& result)
        : scene_(scene), path_(path), result_(result) {}

    /// -1 for assimp's own, which stands for none.
    int number_of(unsigned index);

  private:
    std::string own_name(std::string name);
    int image_of(const aiMaterial& material);
    SceneImage read_image(const char* name) const;

    const aiScene& scene_;
    const std::string& path_;
    ImportedScene& result_;
    std::map<unsigned, int> numbers_;
    std::map<std::string, int> images_;
    std::set<std::string> names_;
};

}  // namespace varimap
