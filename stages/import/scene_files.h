#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stages/import/scene.h"

namespace varimap {

/// A scene as files beside each other, of which the first is the OBJ.
using SceneFiles = std::vector<std::pair<std::string, std::string>>;  ///< name, bytes

/// NAME.obj with `v`, `vt` and `f`, whose coordinates read back exactly; and, where the scene has materials,
/// NAME.mtl and its images NAME.0.png, ...
SceneFiles to_files(const ImportedScene& scene, const std::string& name);

}  // namespace varimap
