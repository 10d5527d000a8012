#pragma once

#include <string>
#include <vector>

#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// A landmark as a program that picks points on a surface writes it.
struct PickedPoint {
    int line = 0;                  ///< of the file, from 1; where the format has no lines, the point's number
    std::string name;              ///< empty where the format has none
    Vec3 position = Vec3::Zero();  ///< in the mesh file's coordinates
};

/// Whether the file's ending is that of picked points: .pp, .json, .fcsv.
bool is_picked_points(const std::string& path);

/// Reads MeshLab's .pp, 3D Slicer's .mrk.json or .fcsv; points that are switched off are left out.
/// Throws IoError; InputError naming the file for anything malformed and for a file without points.
std::vector<PickedPoint> read_picked_points(const std::string& path);

/// Where picked points lie on a mesh.
struct Snapped {
    PointMap points;                ///< the closest points of the surface
    std::vector<int> vertices;      ///< of their faces, the nearest corner
    std::vector<double> distances;  ///< from the positions to the points, units of sqrt(area)
};
Snapped snap(const std::vector<PickedPoint>& picked, const TriangleMesh& mesh);

}  // namespace varimap
