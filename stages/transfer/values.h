#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "varimap/results/correspondence.h"

namespace varimap {

/// What a row of a table belongs to.
enum class Place : int { vertex, face };

/// Numbers of the vertices or the faces of a mesh, a row for each.
struct ValueTable {
    Place place = Place::vertex;  ///< of readers: what the file says
    Eigen::MatrixXd values;
    std::vector<int> label_columns = {};  ///< how many each label takes, such as a colour; empty: one each
    bool says_place = false;              ///< of readers: the file tells vertices from faces
};

/// How values are carried to places between those that have some.
enum class ValueKind : int {
    number,  ///< interpolated at vertices; of faces, the mean over the place
    label,   ///< never mixed: that with the largest share, each by itself where a row holds several
    weight   ///< as numbers; rows are scaled to a sum of 1, but for those that hold none
};

/// What a table of that many rows belongs to, where both are possible what it says of itself; nothing where
/// they are those of another mesh.
std::optional<Place> place_of(std::size_t rows, const TriangleMesh& mesh, Place said = Place::vertex);

/// The table for the other surface. A row without an image is NaN. For faces of `to`, seven of its inner
/// points are asked. Keeps the order of the columns.
ValueTable carry_values(const ValueTable& table, ValueKind kind, const Correspondence& map,
                        const PointCarrier& back);

/// Keeps the `count` largest weights of each row and scales the rest up to a sum of 1.
void keep_largest(Eigen::MatrixXd& weights, int count);

/// A file of values as it was read, and how to write one like it.
struct ValueFile {
    std::vector<ValueTable> tables;  ///< one; of a PLY file those of vertices and faces, if it has them
    /// The bytes of such a file with other rows, for the mesh `to` (which PLY holds).
    std::function<std::string(const std::vector<ValueTable>& tables, const TriangleMesh& to)> write;
};

/// Reads .npy (a row for each vertex or face), .ply (properties besides position and normal; those of a
/// polygon are those of each of its triangles; a mesh in another order is refused), or lines of numbers
/// (.csv, .txt and others: split by comma, semicolon, tab or blanks; the first line may hold names, and a
/// first column called vertex, face or index numbers the rows). Of labels, words are accepted, too. Rows are
/// those of vertices or faces by their number. Throws InputError (another number of rows, no number, weights
/// below 0), IoError.
ValueFile read_values(const std::string& path, ValueKind kind, const TriangleMesh& mesh,
                      const std::string& mesh_file);

// The readers of one format each.
ValueFile parse_npy_values(std::string_view bytes, const std::string& path, ValueKind kind);
ValueFile parse_ply_values(std::string_view bytes, const std::string& path, ValueKind kind,
                           const TriangleMesh& mesh, const std::string& mesh_file);
ValueFile parse_text_values(std::string_view bytes, const std::string& path, ValueKind kind,
                            const TriangleMesh& mesh);

}  // namespace varimap
