#pragma once

#include <string>
#include <vector>

#include "varimap/mesh_files/polygon_soup.h"

namespace varimap {

/// A material as far as OBJ files tell it.
struct SceneMaterial {
    std::string name;
    Vec3 colour = Vec3::Ones();  ///< diffuse
    int image = -1;              ///< of the scene's images; -1: none
};

/// An image that the file holds or names.
struct SceneImage {
    std::string ending;  ///< ".png"
    std::string bytes;
};

/// What a file of a scene shows: the polygons of all its objects, each where its node puts it.
struct ImportedScene {
    PolygonSoup soup;
    std::vector<Eigen::Vector2d>
        uv;                     ///< per entry of soup.corners, v upwards; empty unless all polygons have some
    std::vector<int> material;  ///< per polygon: of `materials`; -1: none
    std::vector<SceneMaterial> materials;  ///< with names of their own
    std::vector<SceneImage> images;
    std::vector<std::string> missing_images;  ///< as the file names them
    std::vector<std::string> left_out;        ///< what else is left out, in words
    int objects = 0;
};

/// Reads a file in any format that assimp knows. Objects follow the order in which the file's tree names
/// them. Their vertices have the file's order and number: glTF and 3MF number those that they draw, FBX and
/// COLLADA have points besides, which many corners share (source_meshes.h). Of formats that tell neither,
/// corners of an object in the same place are one vertex, numbered as they first appear. Polygons stay
/// polygons, with their materials' names, colours and base textures; points and lines are left out; nodes
/// that mirror turn polygons, so that outside stays outside. Skins of glTF stand as their joints do, since
/// that format says so; else bones and animations are not looked at. Throws InputError that names `path`.
ImportedScene read_scene(const std::string& path);

/// Whether assimp reads files of that name's ending.
bool is_importable(const std::string& path);

}  // namespace varimap
