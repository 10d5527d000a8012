#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "varimap/core/enum_names.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// A landmark as a program that picks points on a surface writes it.
struct PickedPoint {
    int line = 0;                  ///< of the file, from 1; where the format has no lines, the point's number
    std::string name;              ///< empty where the format has none
    Vec3 position = Vec3::Zero();  ///< as the file says it
    Space space = Space::unstated;  ///< the axes that the file says it uses
    bool defined = true;  ///< false: missing, switched off or never placed, and position means nothing
};

/// Whether the file's ending is that of picked points: .pp, .json, .fcsv, or .pts, if that does not begin
/// with a number as lists of vertices do.
bool is_picked_points(const std::string& path);

/// Reads MeshLab's .pp, 3D Slicer's .mrk.json or .fcsv, Landmark Editor's .pts.
/// Throws IoError; InputError naming the file for anything malformed and for a file without points.
std::vector<PickedPoint> read_picked_points(const std::string& path);
/// The same from the bytes of such a file; `path` tells the format, and is named in messages.
std::vector<PickedPoint> parse_picked_points(std::string_view bytes, const std::string& path);

/// Which axes the coordinates of landmarks use: those that their file states; those of the mesh, whatever
/// either file says; LPS; or RAS.
enum class LandmarkSpace : int { stated = 0, as_is = 1, lps = 2, ras = 3 };
template <>
struct EnumNames<LandmarkSpace> {
    static constexpr std::array names{"stated", "as-is", "lps", "ras"};
};

/// Where a point is in the mesh's coordinates: x and y are negated where one of the two is LPS and the other
/// RAS. A mesh that states nothing then counts as LPS, as in 3D Slicer.
Vec3 in_axes_of(const TriangleMesh& mesh, const PickedPoint& point, LandmarkSpace space);

/// Where points lie on a mesh.
struct Snapped {
    PointMap points;                ///< the closest points of the surface
    std::vector<int> vertices;      ///< of their faces, the nearest corner
    std::vector<double> distances;  ///< from the positions to the points, units of sqrt(area)
};
Snapped snap(const std::vector<Vec3>& positions, const TriangleMesh& mesh);

/// A point farther than this from its surface, in units of sqrt(area), was not picked on it: it is an edge of
/// a mesh with 2500 vertices.
inline constexpr double far_from_surface = .02;
/// Throws InputError where most of some positions lie so far from the surface they were snapped to: they are
/// read wrongly, or belong elsewhere. The message begins with `place`, the file or a line of it, and names
/// the likely cause; `what`: the positions' name in it, "landmarks".
void require_near(const Snapped& snapped, const std::vector<Vec3>& positions, const TriangleMesh& mesh,
                  const std::string& place, const char* what);
/// Why most positions may lie far from a surface, as the end of a message: other axes, other units, or
/// another mesh.
std::string likely_cause(const std::vector<Vec3>& positions, const TriangleMesh& mesh);

}  // namespace varimap
