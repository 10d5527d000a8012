#pragma once

#include <assimp/scene.h>

#include <map>
#include <string>

#include "stages/import/scene_object.h"

namespace varimap {

using Affine = Eigen::Matrix<double, 3, 4>;
Affine to_affine(const aiMatrix4x4& m);
Affine composed(const Affine& outer, const Affine& inner);

/// Where nodes stand, by their names.
using Places = std::map<std::string, Affine>;
Places places_of(const aiScene& scene);

bool has_skin(const aiScene& scene, const aiNode& node);

/// As assimp has them: vertices of several meshes one after the other; those that several share (primitives
/// of one accessor) once. Skins stand where `joints`, if there are any, take them. Throws InputError that
/// does not name the file.
SceneObject object_of(const aiScene& scene, const aiNode& node, const Places& joints);

}  // namespace varimap
