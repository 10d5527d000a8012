#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stages/transfer/bake.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/results/correspondence.h"

namespace varimap {

/// What to carry; lists of files, empty where there is nothing of the kind.
struct TransferRequest {
    std::vector<std::string> points, values, labels, weights, regions, shapes;
    std::string texture;           ///< OBJ of the source with texture coordinates
    std::string onto;              ///< OBJ of the target with its own, to bake onto; empty: the target's mesh
    std::string mesh;              ///< OBJ of the source whose polygons are wanted on the target
    LandmarkReading reading = {};  ///< of points
    BakeSize bake = {};            ///< where nothing is baked, coordinates are cut at seams
    int influences = 0;            ///< weights kept in each row; 0: all
    /// Where the results go: no image takes the place of another that lies there; empty: nothing lies there.
    std::string folder;

    bool empty() const {
        return points.empty() && values.empty() && labels.empty() && weights.empty() && regions.empty() &&
               shapes.empty() && texture.empty() && mesh.empty();
    }
};

/// Names and bytes of files.
using NamedFiles = std::vector<std::pair<std::string, std::string>>;

/// Carries everything, or nothing: throws InputError, IoError, UsageError (two results of one name, or what
/// would have no effect) before anything is written.
NamedFiles transfer(const TransferRequest& request, const Correspondence& map, bool reverse);

}  // namespace varimap
