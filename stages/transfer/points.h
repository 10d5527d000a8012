#pragma once

#include <string>

#include "varimap/landmarks/vertex_list.h"
#include "varimap/results/correspondence.h"

namespace varimap {

/// A file of points of one surface as it is for the other: the same text with other positions, so that names,
/// order, colours and what else the program wrote stay. Reads 3D Slicer's .mrk.json and .fcsv, MeshLab's .pp,
/// Landmark Editor's .pts, and lines (.txt, .csv and others) that hold a vertex number and perhaps a name
/// (the first may name them, or a column `vertex`), or x y z and perhaps names, or whose first line names
/// columns x, y and z; columns of normals are left out, with a warning. A vertex number becomes that of the
/// nearest vertex. Axes and the first vertex's number (0 unless it is said to be 1) are those of `reading` on
/// either side. Points that are not defined stay as they are. Throws InputError, also where most points lie
/// far from the surface; IoError.
std::string carry_points(const std::string& path, const LandmarkReading& reading, const Correspondence& map,
                         const PointCarrier& there);

/// A list of faces (a number from 0 in each line, of which the first may name them) as that of the other
/// mesh's faces whose centroids lie on them. Throws InputError, IoError.
std::string carry_region(const std::string& path, const Correspondence& map, const PointCarrier& back);

}  // namespace varimap
