#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "varimap/landmarks/landmark_points.h"
#include "varimap/landmarks/list_rows.h"
#include "varimap/mesh_files/index_base.h"

namespace varimap {

// What the lists of vertex_list.h name, before it becomes landmarks. All throw InputError naming file and
// line.

inline constexpr int no_vertex = -1;  ///< of a landmark that is missing, or switched off

/// A vertex that a line of a file names, or a point of one without lines.
struct Named {
    int line, vertex;
    std::string name = {};                   ///< by which it is matched; empty: by its row
    std::optional<SurfacePoint> point = {};  ///< where it was picked, if not at the vertex
    int first = 0;                           ///< number of the file's first vertex

    int number_in_file() const { return vertex + first; }
};

/// Where a landmark stands in its file: JSON counts points instead of lines.
struct Row {
    const char* unit;  ///< what is counted
    std::string place;
};
Row row_of(const std::string& path, int line);

/// The number in a column of a row, from 0, checked against the mesh where it is given; no_vertex where it is
/// missing. `first`: that of the file's first vertex.
int to_vertex(const ListRow& row, std::size_t column, int first, const std::string& path,
              const TriangleMesh* mesh);
/// Rows of vertex numbers, which x y z may follow.
std::vector<Named> vertices_of_list(const std::vector<ListRow>& rows, const std::string& path, IndexBase base,
                                    const TriangleMesh* mesh);

/// Picked points as the vertices nearest to where they lie on the surface. Those that are not defined keep
/// their place in the list, so that rows still match, without a vertex.
std::vector<Named> snapped_list(const std::vector<PickedPoint>& picked, const std::string& path,
                                const TriangleMesh& mesh, LandmarkSpace space);

/// Those of both sides, and how many only one side has.
struct MatchedLists {
    std::vector<std::pair<Named, Named>> pairs;
    int left_out = 0;
};
/// The lists of both sides, matched row by row, or by name where all have one. Names that only one list has,
/// and landmarks that are missing on a side, are left out with a note.
MatchedLists matched(const std::vector<Named> (&lists)[2], const std::vector<std::string>& files);

}  // namespace varimap
