#pragma once

#include <string>
#include <utility>
#include <vector>

#include "varimap/landmarks/landmark_points.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/mesh/vertex_index.h"
#include "varimap/mesh_files/index_base.h"
#include "varimap/mesh_repair/file_link.h"

namespace varimap {

/// Vertices of the source and their partners on the target, each from a list (.vts, .pinned, .csv, plain),
/// matched as landmarks are (read_landmarks): a line is a vertex number, which x y z may follow; `#` starts a
/// comment. Here as in all lists, a line may be split by commas instead of blanks, and all lines by
/// semicolons or tabs where the first one is; then the first or last field may be a name, and the first line
/// may hold headings. Automatic base: where the lines carry coordinates, those of the mesh decide; else a 0,
/// or a number as large as there are vertices (`source_count`, where there is no source) in either list, as
/// in maps of vertices (map_file.h); else 0, with a warning. Returns 0-based numbers, in the source file's
/// order; a vertex may be that of several. Numbers are checked against the meshes that are given. Throws
/// IoError; InputError naming file and line (malformed, out of range), an empty file, or what has no partner.
std::vector<std::pair<int, int>> read_vertex_pairs(const std::string& source_list,
                                                   const std::string& target_list, IndexBase base,
                                                   const TriangleMesh* source, const TriangleMesh* target,
                                                   int source_count = 0);

/// How the numbers in files of landmarks are meant.
struct LandmarkReading {
    LandmarkSpace space = LandmarkSpace::stated;
    /// Of the first vertex; automatic: coordinates beside the numbers of a list decide, else 0.
    IndexBase base = IndexBase::automatic;

    template <class List>
    void describe(List& list) {
        list.add("landmark_space", space,
                 "axes of landmark points: stated by their file, as-is (those of the mesh), lps or ras");
        list.add("landmark_base", base,
                 "number of the first vertex in landmarks: 0, 1 or auto (coordinates beside the numbers of a "
                 "list decide, else 0)");
    }
};

/// A landmark of one surface.
struct PlacedLandmark {
    std::string name;  ///< empty where the file has none
    SurfacePoint point;
};
/// Those of a list for one surface, as read_landmarks reads it. Points that are switched off or not defined
/// are left out, with a warning; several may be in one place. Throws as read_landmarks does.
std::vector<PlacedLandmark> read_placed_landmarks(const std::string& path, const TriangleMesh& mesh,
                                                  const LandmarkReading& reading);

/// Whether a file holds points of one surface rather than numbers of vertices: picked points, or x y z in the
/// first row. Throws as the readers do.
bool holds_points(const std::string& path);

/// Landmarks of the source and the target, row by row.
struct Landmarks {
    VertexPairs<InputVertex> vertices;  ///< they are, or are nearest to the points
    PointPairs points;                  ///< where they are, if a file holds points; else empty
    int left_out = 0;                   ///< others, which one of the surfaces lacks
};

/// More landmarks than these are taken to decide the map (varimap-explore's default), so that the sketches,
/// on which other maps are looked for, need not hold all of them.
inline constexpr int few_landmarks = 10;

/// Where landmarks are on the meshes that they were read for, row by row: their points, or else those at
/// their vertices (face -1 at one that no face uses).
PointPairs as_points(const Landmarks& landmarks, const TriangleMesh& source, const TriangleMesh& target);

/// Whether a vertex may be that of two rows: not of landmarks, which would send it to two places, but of
/// known partners that a map is compared with.
enum class Repeats { refuse, allow };

/// Landmarks from one file of pairs, or from two lists matched row by row. Instead of vertices a file may
/// hold points in the mesh's coordinates: rows x y z x y z, or two lists of x y z or of picked points
/// (landmark_points.h). Lists are matched by name where all rows of both have distinct ones. A point stands
/// for the vertex nearest to where it lies on the surface where vertices are needed; its distance is logged.
/// Points that are switched off or not defined are left out with their partners. Throws as the readers do,
/// and InputError where most points lie far from the surface, naming the likely cause, for a different number
/// of rows, a vertex that no face uses or, unless that is allowed, that two rows name; UsageError for any
/// other number of files. `source_fates`, `target_fates`: of the vertices (FileLink), by which errors say why
/// one has no face; empty where the mesh has all faces of its file.
Landmarks read_landmarks(const std::vector<std::string>& files, const TriangleMesh& source_input,
                         const TriangleMesh& target_input, const LandmarkReading& reading = {},
                         Repeats repeats = Repeats::refuse, const std::vector<VertexFate>& source_fates = {},
                         const std::vector<VertexFate>& target_fates = {});

}  // namespace varimap
