#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "stages/transfer/same_mesh.h"
#include "stages/transfer/values.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/printable.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/mesh_files/ply_columns.h"
#include "varimap/mesh_files/text_scanner.h"

namespace varimap {

namespace {

/// Geometry, which the other mesh has of its own.
bool is_geometry(const std::string& name) {
    static const std::array names{"x", "y", "z", "nx", "ny", "nz"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_colour(const std::string& name) {
    static const std::array names{"red", "green", "blue", "alpha"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// A colour is one label: its channels, elected each by itself, would make one that nowhere was.
std::vector<int> label_columns(const std::vector<PlyColumn>& columns) {
    std::vector<int> widths;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const bool goes_on = c > 0 && is_colour(columns[c].name) && is_colour(columns[c - 1].name);
        if (goes_on)
            ++widths.back();
        else
            widths.push_back(1);
    }
    return widths;
}

/// Lists, which are not carried, besides the corners of faces.
void warn_of_lists(std::string_view bytes, const std::string& path) {
    std::string names;
    TextScanner header(bytes.substr(0, bytes.find("end_header")), path, LineStyle::plain);
    while (header.next_line()) {
        const auto& words = header.words();
        const std::string_view name = words.back();
        if (words.size() != 5 || words[0] != "property" || words[1] != "list") continue;
        if (name == "vertex_indices" || name == "vertex_index") continue;
        names += (names.empty() ? "" : ", ") + printable(std::string(name));
    }
    if (!names.empty()) warn("{}: lists are not carried: {}", path, names);
}

/// What a polygon has, each of the triangles has that the meshes hold in its place.
void spread_over_triangles(PlyColumns& columns) {
    if (columns.corners.empty()) return;
    for (PlyColumn& column : columns.face) {
        std::vector<double> values;
        for (std::size_t f = 0; f < columns.corners.size(); ++f)
            values.insert(values.end(), std::max<std::size_t>(columns.corners[f], 2) - 2, column.values[f]);
        column.values = std::move(values);
    }
}

Points positions_in(const PlyColumns& columns) {
    const std::size_t count = columns.vertex.empty() ? 0 : columns.vertex[0].values.size();
    Points positions = Points::Zero(Eigen::Index(count), 3);
    for (const PlyColumn& column : columns.vertex)
        for (int axis = 0; axis < 3; ++axis)
            if (column.name == std::string(1, "xyz"[axis]))
                positions.col(axis) =
                    Eigen::Map<const Eigen::VectorXd>(column.values.data(), positions.rows());
    return positions;
}

/// Values go by the numbers of vertices and faces, which another program may have changed. A mesh in another
/// pose has the same faces, a cloud of points none.
void require_same_order(const PlyColumns& columns, std::string_view bytes, const std::string& path,
                        const TriangleMesh& mesh, const std::string& mesh_file) {
    TriangleMesh own{positions_in(columns), {}};
    if (own.vertex_count() != mesh.vertex_count()) return;  // of faces, or of another mesh
    if (!columns.corners.empty()) {
        own = parse_mesh(bytes, path);
        if (own.face_count() != mesh.face_count() && columns.face.empty()) own.faces.resize(0, 3);
    }
    if (same_faces(own, mesh) || (columns.face.empty() && same_vertices(own, mesh))) return;
    require_same_mesh(own.face_count() == 0, path, own, mesh_file, mesh);
    warn("{}: its vertices lie elsewhere than those of {}; its values are taken in its order of vertices",
         path, mesh_file);
}

ValueTable to_table(const std::vector<PlyColumn>& columns, Place place) {
    const Eigen::Index rows = Eigen::Index(columns[0].values.size());
    ValueTable table{place, Eigen::MatrixXd(rows, Eigen::Index(columns.size())), label_columns(columns),
                     true};
    for (std::size_t c = 0; c < columns.size(); ++c)
        table.values.col(Eigen::Index(c)) = Eigen::Map<const Eigen::VectorXd>(columns[c].values.data(), rows);
    return table;
}

bool holds_fractions(const std::string& type) {
    return type.starts_with("float") || type == "double";
}

std::vector<PlyColumn> to_columns(const std::vector<PlyColumn>& like, const ValueTable& table,
                                  ValueKind kind) {
    std::vector<PlyColumn> columns = like;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (kind == ValueKind::weight && !holds_fractions(columns[c].type)) columns[c].type = "double";
        const auto column = table.values.col(Eigen::Index(c));
        columns[c].values.assign(column.begin(), column.end());
    }
    return columns;
}

}  // namespace

ValueFile parse_ply_values(std::string_view bytes, const std::string& path, ValueKind kind,
                           const TriangleMesh& mesh, const std::string& mesh_file) {
    PlyColumns columns = parse_ply_columns(bytes, path);
    require_same_order(columns, bytes, path, mesh, mesh_file);
    warn_of_lists(bytes, path);
    std::erase_if(columns.vertex, [](const PlyColumn& column) { return is_geometry(column.name); });
    spread_over_triangles(columns);
    ValueFile file;
    if (!columns.vertex.empty()) file.tables.push_back(to_table(columns.vertex, Place::vertex));
    if (!columns.face.empty()) file.tables.push_back(to_table(columns.face, Place::face));
    if (file.tables.empty())
        throw InputError(path + ": holds no properties besides positions, normals and faces");
    file.write = [columns, kind, format = ply_format(bytes)](const std::vector<ValueTable>& tables,
                                                             const TriangleMesh& to) {
        PlyColumns out;
        auto next = tables.begin();
        if (!columns.vertex.empty()) out.vertex = to_columns(columns.vertex, *next++, kind);
        if (!columns.face.empty()) out.face = to_columns(columns.face, *next, kind);
        return to_ply(to, out, format);
    };
    return file;
}

}  // namespace varimap
