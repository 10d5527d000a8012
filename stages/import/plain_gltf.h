#pragma once

#include <string>
#include <vector>

namespace varimap {

/// A glTF file as assimp reads it right.
struct PlainGltf {
    std::string glb;                    ///< empty where the file may be read as it is: it is of glTF 1
    std::vector<std::string> left_out;  ///< what of the file is left out
};

/// Assimp takes all numbers of vertices for floats, the first set of texture coordinates for the one that is
/// meant, and passes over extensions that it does not know. So a file is first written anew, with floats
/// only, with TEXCOORD_0 as the base texture uses it, and without what the OBJ does not have. Nodes with a
/// skin get meshes of their own, and nodes names of their own, by which joints are found. Files that need
/// what is not read are refused. Throws InputError that names `path`.
PlainGltf plain_gltf(const std::string& path);

}  // namespace varimap
