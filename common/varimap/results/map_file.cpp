#include "varimap/results/map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "varimap/artifact/artifact.h"
#include "varimap/artifact/npy.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/whole_number.h"
#include "varimap/mesh/topology.h"
#include "varimap/mesh_files/npy_array.h"
#include "varimap/mesh_files/text_scanner.h"
#include "varimap/results/map_table.h"

namespace varimap {

namespace {

constexpr long long none = -1;  ///< no vertex

/// A vertex of the target for each of the source, as a file numbers them.
struct VertexMap {
    std::vector<long long> vertex;
    std::vector<int> line;        ///< of the file, where it has lines
    std::optional<int> own_base;  ///< that of the source's own numbers, where they stand beside
};

/// Where row i stands, for messages.
std::string place(const VertexMap& map, std::size_t i, const std::string& path) {
    return map.line.empty() ? fmt::format("{}: row {} (from 0)", path, i)
                            : fmt::format("{}:{}", path, map.line[i]);
}

/// `place`: called for where it stands, if it is none.
template <class Place>
long long to_vertex(double number, const Place& place) {
    if (std::isnan(number)) return none;
    if (!is_whole(number)) throw InputError(fmt::format("{}: {} is not a vertex number", place(), number));
    return number < 0 ? none : static_cast<long long>(number);
}

std::vector<double> numbers_of(std::string line) {
    for (char& c : line)
        if (c == ',' || c == ';' || c == '\t') c = ' ';
    TextScanner words(line, "");
    std::vector<double> numbers;
    if (!words.next_line()) return numbers;
    for (const auto word : words.words()) {
        double number;
        if (!to_number(word, number)) return {};
        numbers.push_back(number);
    }
    return numbers;
}

VertexMap parse_text(std::string_view bytes, const std::string& path) {
    VertexMap map;
    std::optional<std::size_t> columns;
    TextScanner lines(without_byte_order_mark(bytes, path), path);
    for (bool first = true; lines.next_line(); first = false) {
        std::string text;
        for (const auto word : lines.words()) text += std::string(word) + ' ';
        const std::vector<double> numbers = numbers_of(text);
        if (first && numbers.empty()) continue;  // names
        if (!columns) columns = numbers.size();
        const auto at = [&] { return fmt::format("{}:{}", path, lines.line()); };
        if (numbers.size() != *columns || numbers.empty() || numbers.size() > 2)
            throw InputError(at() +
                             ": expected a vertex of the target, for each vertex of the source, or the "
                             "table of varimap, whose first line is vertex,face,b0,b1,b2");
        if (numbers.size() == 2) {
            if (!map.own_base) map.own_base = numbers[0] == 1 ? 1 : 0;
            if (numbers[0] != double(map.vertex.size()) + *map.own_base)
                throw InputError(
                    fmt::format("{}: vertex {} where vertex {} should stand; rows must be in the "
                                "vertices' order",
                                at(), numbers[0], map.vertex.size() + std::size_t(*map.own_base)));
        }
        map.vertex.push_back(to_vertex(numbers.back(), at));
        map.line.push_back(lines.line());
    }
    return map;
}

VertexMap parse_list(const NpyArray& array, const std::string& path) {
    if (array.values.cols() != 1 && array.values.rows() != 1)
        throw InputError(path + ": expected a list of vertices of the target, one for each of the source");
    VertexMap map;
    const auto list = array.values.reshaped();
    for (Eigen::Index i = 0; i < list.size(); ++i)
        map.vertex.push_back(to_vertex(list[i], [&] { return place(map, std::size_t(i), path); }));
    return map;
}

/// Sum over the sides of the source's faces of the squared lengths of their images: small where neighbours
/// stay together.
double roughness(const VertexMap& map, int base, const TriangleMesh& source, const TriangleMesh& target) {
    double sum = 0;
    for (const auto face : source.faces.rowwise())
        for (int k = 0; k < 3; ++k) {
            const long long a = map.vertex[std::size_t(face[k])] - base;
            const long long b = map.vertex[std::size_t(face[(k + 1) % 3])] - base;
            if (a >= 0 && b >= 0) sum += (target.vertex(int(a)) - target.vertex(int(b))).squaredNorm();
        }
    return sum;
}

int first_number(const VertexMap& map, IndexBase base, const std::string& path, const TriangleMesh& target,
                 const TriangleMesh* source) {
    if (base != IndexBase::automatic) return number_of_first(base);
    if (map.own_base) return *map.own_base;
    const bool has_zero = std::find(map.vertex.begin(), map.vertex.end(), 0) != map.vertex.end();
    const bool has_last =
        std::find(map.vertex.begin(), map.vertex.end(), target.vertex_count()) != map.vertex.end();
    if (has_zero || has_last) return has_zero ? 0 : 1;
    if (std::any_of(map.vertex.begin(), map.vertex.end(),
                    [&](long long v) { return v > target.vertex_count(); }))
        return 0;  // refused in any case
    if (source == nullptr) {
        warn("{}: nothing tells whether its vertices are counted from 0 or from 1; taking 0", path);
        return 0;
    }
    const int smoother = roughness(map, 1, *source, target) < roughness(map, 0, *source, target) ? 1 : 0;
    log("{}: its vertices are counted from {}: so the map is smoother", path, smoother);
    return smoother;
}

PointMap at_vertices(const VertexMap& map, IndexBase base, const std::string& path,
                     const TriangleMesh& target, const TriangleMesh* source) {
    const int first = first_number(map, base, path, target, source);
    const PointMap vertices = points_at_vertices(target);
    PointMap points;
    for (std::size_t i = 0; i < map.vertex.size(); ++i) {
        const long long vertex = map.vertex[i];
        if (vertex != none && (vertex < first || vertex - first >= target.vertex_count()))
            throw InputError(
                fmt::format("{}: vertex {} is out of range: the target has {} vertices, numbered from {}",
                            place(map, i, path), vertex, target.vertex_count(), first));
        points.push_back(vertex == none ? SurfacePoint{} : vertices[std::size_t(vertex - first)]);
    }
    return points;
}

PointMap points_of_faces(const NpyArray& face, const NpyArray& barycentric, const std::string& path) {
    const Eigen::Index rows = face.values.size();
    if (face.values.cols() != 1 || barycentric.values.rows() != rows || barycentric.values.cols() != 3)
        throw InputError(path + ": expected a list `face` and `barycentric` with as many rows of three");
    PointMap map;
    for (Eigen::Index i = 0; i < rows; ++i) {
        const double f = face.values(i, 0);
        if (!is_whole(f)) throw InputError(fmt::format("{}: {} is not a face number", path, f));
        if (f < 0)
            map.emplace_back();
        else
            map.push_back({int(f), barycentric.values.row(i).transpose()});
    }
    return map;
}

const std::string* find(const std::map<std::string, std::string>& files, const std::string& name) {
    const auto found = files.find(name + ".npy");
    return found == files.end() ? nullptr : &found->second;
}

std::string_view list_of_vertices(const std::map<std::string, std::string>& files, const std::string& path) {
    for (const char* name : {"p2p", "nearest_vertex"})
        if (const std::string* found = find(files, name)) return *found;
    if (files.size() != 1)
        throw InputError(path + ": has neither face and barycentric, nor p2p, nor a single list of vertices");
    return files.begin()->second;
}

PointMap read(const std::string& bytes, const std::string& path, IndexBase base, const TriangleMesh& target,
              const TriangleMesh* source) {
    const auto require_rows = [&](std::size_t rows) {
        if (source != nullptr && int(rows) != source->vertex_count())
            throw InputError(
                fmt::format("{}: {} rows, but the source mesh has {} vertices; give the mesh the map starts "
                            "from first, then the one it leads to",
                            path, rows, source->vertex_count()));
    };
    const auto of_vertices = [&](const VertexMap& map) {
        require_rows(map.vertex.size());
        return at_vertices(map, base, path, target, source);
    };
    if (is_npy(bytes)) return of_vertices(parse_list(parse_npy(bytes, path), path));
    if (!is_zip(bytes) && !is_csv_map(bytes)) return of_vertices(parse_text(bytes, path));
    PointMap map;
    if (is_zip(bytes)) {
        const auto files = from_zip(bytes, path);
        const std::string *face = find(files, "face"), *barycentric = find(files, "barycentric");
        if (face == nullptr || barycentric == nullptr)
            return of_vertices(parse_list(parse_npy(list_of_vertices(files, path), path), path));
        map = points_of_faces(parse_npy(*face, path), parse_npy(*barycentric, path), path);
    } else {
        map = parse_csv_map(bytes, path);
    }
    require_rows(map.size());
    return map;
}

}  // namespace

PointMap read_map_file(const std::string& path, IndexBase base, const TriangleMesh& target,
                       const TriangleMesh* source) {
    const std::string bytes = read_file(path);
    const PointMap map = read(bytes, path, base, target, source);
    const bool has_lines = is_csv_map(bytes);
    for (std::size_t v = 0; v < map.size(); ++v)
        require_near_surface(
            map[v],
            has_lines ? fmt::format("{}:{}", path, v + 2) : fmt::format("{}: row {} (from 0)", path, v),
            target.face_count());
    return map;
}

}  // namespace varimap
