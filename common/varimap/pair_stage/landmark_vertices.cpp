#include "varimap/pair_stage/landmark_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "varimap/core/error.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

bool is_at_vertex(const Surface& surface, InputVertex vertex) {
    return !surface.is_surface() || vertex_of(surface.mesh, surface.on_mesh[std::size_t(vertex.index)]) >= 0;
}

/// The mesh's vertices for the landmarks of one side, which have the numbers of their rows here. Those at
/// vertices take these at once.
class VertexChoice {
  public:
    VertexChoice(const Surface& surface, std::vector<InputVertex> landmarks, const char* which)
        : surface_(surface), landmarks_(std::move(landmarks)), which_(which) {
        vertices_.assign(landmarks_.size(), -1);
        for (std::size_t row = 0; row < landmarks_.size(); ++row) take_exact(row);
    }

    /// Whether the landmark gets a vertex of its own: that at it, or the nearest corner of the face around
    /// it that is free, or that another landmark can leave for another one.
    bool take(std::size_t row) {
        std::set<int> asked;
        return vertices_[row] >= 0 || take_corner(row, asked);
    }
    /// Or, where many are close together, the nearest free vertex around that face.
    bool take_around(std::size_t row) {
        constexpr int rings = 4;  // no farther: it is moved to the landmark, with its triangles
        const Adjacency& neighbours = this->neighbours();
        const auto corners = corners_by_distance(row);
        std::vector<int> seen(corners.begin(), corners.end());
        for (std::size_t first = 0, ring = 0; ring < rings; ++ring)
            for (const std::size_t end = seen.size(); first < end; ++first)
                for (const int v : neighbours[seen[first]]) {
                    if (std::ranges::find(seen, v) != seen.end()) continue;
                    seen.push_back(v);
                    if (!holder_.emplace(v, row).second) continue;
                    vertices_[row] = v;
                    return true;
                }
        return false;
    }
    void give_back(std::size_t row) {
        if (!is_inside_face(row)) return;
        holder_.erase(vertices_[row]);
        vertices_[row] = -1;
    }
    /// Where others take theirs, it may change until all have.
    MeshVertex vertex(std::size_t row) const { return {vertices_[row]}; }

    [[noreturn]] void refuse(std::size_t row) const {
        throw InputError(fmt::format(
            "landmark vertex {} of the {} is too near to others for the coarse mesh; keep fewer, or use "
            "--full-resolution or more coarsen.vertices",
            number(row), which_));
    }

  private:
    const SurfacePoint& at(std::size_t row) const {
        return surface_.on_mesh[std::size_t(landmarks_[row].index)];
    }
    bool is_inside_face(std::size_t row) const { return !is_at_vertex(surface_, landmarks_[row]); }
    int number(std::size_t row) const { return number_in_file(landmarks_[row].index, surface_.link); }

    /// A repair makes one vertex of several; a landmark each would ask it to go to several places.
    void take_exact(std::size_t row) {
        if (!surface_.is_surface()) {  // its points are the vertices
            vertices_[row] = landmarks_[row].index;
            return;
        }
        if (at(row).face < 0)
            throw InputError(
                fmt::format("landmark vertex {} of the {} belongs to no face; choose another vertex",
                            number(row), which_));
        const int vertex = vertex_of(surface_.mesh, at(row));
        if (vertex < 0) return;
        const auto [other, is_new] = holder_.emplace(vertex, row);
        if (!is_new)
            throw InputError(
                fmt::format("landmark vertices {} and {} of the {} became one when the mesh was repaired; "
                            "keep one of the two landmarks",
                            number(other->second), number(row), which_));
        vertices_[row] = vertex;
    }

    /// Augments a bipartite matching. `asked`: corners that nobody can leave, or is leaving.
    bool take_corner(std::size_t row, std::set<int>& asked) {
        const std::array<int, 3> corners = corners_by_distance(row);
        for (const int corner : corners)
            if (holder_.emplace(corner, row).second) {
                vertices_[row] = corner;
                return true;
            }
        for (const int corner : corners) {
            const std::size_t other = holder_.at(corner);
            if (!is_inside_face(other) || !asked.insert(corner).second || !take_corner(other, asked))
                continue;
            holder_.at(corner) = row;
            vertices_[row] = corner;
            return true;
        }
        return false;
    }
    const Adjacency& neighbours() {
        if (!neighbours_) neighbours_ = vertex_neighbours(surface_.mesh);
        return *neighbours_;
    }
    std::array<int, 3> corners_by_distance(std::size_t row) const {
        std::array<int, 3> corner{0, 1, 2};
        std::sort(corner.begin(), corner.end(),
                  [&](int i, int k) { return at(row).barycentric[i] > at(row).barycentric[k]; });
        for (int& c : corner) c = surface_.mesh.faces(at(row).face, c);
        return corner;
    }

    const Surface& surface_;
    std::vector<InputVertex> landmarks_;
    const char* which_;
    std::vector<int> vertices_;          ///< per landmark; -1: none yet
    std::map<int, std::size_t> holder_;  ///< of a vertex, the landmark
    std::optional<Adjacency> neighbours_;
};

/// Those of both sides.
struct VertexChoices {
    VertexChoice A, B;
    VertexChoices(const VertexPairs<InputVertex>& landmarks, const Surface& on_A, const Surface& on_B)
        : A(on_A, side(landmarks, &VertexPairs<InputVertex>::value_type::first), "source"),
          B(on_B, side(landmarks, &VertexPairs<InputVertex>::value_type::second), "target") {}
    std::pair<MeshVertex, MeshVertex> pair(std::size_t row) const { return {A.vertex(row), B.vertex(row)}; }

  private:
    template <class Member>
    static std::vector<InputVertex> side(const VertexPairs<InputVertex>& landmarks, Member member) {
        std::vector<InputVertex> vertices;
        for (const auto& pair : landmarks) vertices.push_back(pair.*member);
        return vertices;
    }
};

Landmarks of_rows(const Landmarks& landmarks, const std::vector<std::size_t>& rows) {
    Landmarks chosen;
    for (const std::size_t row : rows) {
        chosen.vertices.push_back(landmarks.vertices[row]);
        if (!landmarks.points.empty()) chosen.points.push_back(landmarks.points[row]);
    }
    return chosen;
}

/// All over the list, if they are more than exploration has any use for: with 500 it took minutes.
Landmarks at_most_a_hundred(const Landmarks& landmarks) {
    constexpr std::size_t most = 100;
    const std::size_t given = landmarks.vertices.size(), count = std::min(given, most);
    std::vector<std::size_t> rows;
    for (std::size_t k = 0; k < count; ++k) rows.push_back(k * given / count);
    return of_rows(landmarks, rows);
}

}  // namespace

HeldApart held_apart(const Landmarks& given, const Surface& A, const Surface& B) {
    const Landmarks landmarks = at_most_a_hundred(given);
    VertexChoices choices(landmarks.vertices, A, B);
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < landmarks.vertices.size(); ++row) {
        if (!choices.A.take(row)) continue;
        if (choices.B.take(row))
            rows.push_back(row);
        else
            choices.A.give_back(row);
    }
    HeldApart held{of_rows(landmarks, rows), {}};
    for (const std::size_t row : rows) held.vertices.push_back(choices.pair(row));
    return held;
}

VertexPairs<MeshVertex> to_mesh_vertices(const VertexPairs<InputVertex>& landmarks, const Surface& A,
                                         const Surface& B) {
    VertexChoices choices(landmarks, A, B);
    for (std::size_t row = 0; row < landmarks.size(); ++row) {
        if (!choices.A.take(row) && !choices.A.take_around(row)) choices.A.refuse(row);
        if (!choices.B.take(row) && !choices.B.take_around(row)) choices.B.refuse(row);
    }
    VertexPairs<MeshVertex> result;
    for (std::size_t row = 0; row < landmarks.size(); ++row) result.push_back(choices.pair(row));
    return result;
}

PointPairs landmark_points(const Landmarks& landmarks, const Surface& A, const Surface& B) {
    const auto is_exact = [&](const auto& pair) {
        return is_at_vertex(A, pair.first) && is_at_vertex(B, pair.second);
    };
    if (landmarks.points.empty() && std::ranges::all_of(landmarks.vertices, is_exact)) return {};
    return as_points(landmarks, A.input, B.input);
}

}  // namespace varimap
