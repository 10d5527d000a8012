#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "varimap/mesh/io/polygon_soup.h"

namespace varimap {

/// What a file of a scene shows: the polygons of all its objects, each where its node puts it.
struct ImportedScene {
    PolygonSoup soup;
    std::vector<Eigen::Vector2d> uv;  ///< per entry of soup.corners, v upwards; empty: the file has none
    int objects = 0;
};

/// Reads a file in any format that assimp knows. Objects follow the order in which the file's tree names
/// them. Their vertices have the file's order and number: glTF and 3MF number those that they draw, FBX and
/// COLLADA have points besides, which many corners share (source_meshes.h). Of formats that tell neither,
/// corners of an object in the same place are one vertex, numbered as they first appear. Polygons stay
/// polygons; points and lines are left out; nodes that mirror turn polygons, so that outside stays outside.
/// Bones and animations are not looked at. Throws InputError that names `path`.
ImportedScene read_scene(const std::string& path);

/// OBJ with `v`, `vt` and `f`; coordinates are written so that they read back exactly.
std::string to_obj(const ImportedScene& scene);

/// Whether assimp reads files of that name's ending.
bool is_importable(const std::string& path);

}  // namespace varimap
