#include "varimap/pair_stage/pair_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "varimap/core/log.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/topology.h"
#include "varimap/spectral/spectral_check.h"
#include "varimap/surface/input_locator.h"

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

Landmarks some(const Landmarks& landmarks, const std::vector<std::size_t>& rows) {
    Landmarks chosen;
    for (const std::size_t row : rows) {
        chosen.vertices.push_back(landmarks.vertices[row]);
        if (!landmarks.points.empty()) chosen.points.push_back(landmarks.points[row]);
    }
    return chosen;
}

/// All over the list, if they are more than exploration has any use for: with 500 it took minutes.
Landmarks some_for_sketch(const Landmarks& landmarks) {
    constexpr std::size_t most = 100;
    const std::size_t given = landmarks.vertices.size(), count = std::min(given, most);
    std::vector<std::size_t> rows;
    for (std::size_t k = 0; k < count; ++k) rows.push_back(k * given / count);
    return some(landmarks, rows);
}

/// Landmarks that a sketch can hold apart, and their vertices there.
struct HeldApart {
    Landmarks landmarks;
    VertexPairs<MeshVertex> vertices;
};
HeldApart held_apart(const Landmarks& landmarks, const Surface& A, const Surface& B) {
    VertexChoices choices(landmarks.vertices, A, B);
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < landmarks.vertices.size(); ++row) {
        if (!choices.A.take(row)) continue;
        if (choices.B.take(row))
            rows.push_back(row);
        else
            choices.A.give_back(row);
    }
    HeldApart held{some(landmarks, rows), {}};
    for (const std::size_t row : rows) held.vertices.push_back(choices.pair(row));
    return held;
}

/// Moves vertices, in space and in the eigenbasis, to points of the input.
void move_vertices(SurfaceData& data, const std::vector<int>& vertices,
                   const std::vector<SurfacePoint>& points) {
    const MeshLocator locate(data.surface);
    TriangleMesh& mesh = data.surface.mesh;
    RowMatrix& functions = data.basis.functions;
    PointMap at;
    for (const SurfacePoint& point : points) at.push_back(locate(point));
    functions(vertices, Eigen::all) = pulled_back(functions, mesh, at);
    mesh.vertices(vertices, Eigen::all) = positions(mesh, at);
}

/// What the surface was coarsened from, or itself.
std::string finer_surface(const Header& surface) {
    const std::string finer = surface.input_hash("fine");
    return finer.empty() ? surface.payload_hash : finer;
}

/// Content hashes of what candidates were found with on one side: on the surfaces themselves where
/// varimap-explore was given these, too (--surfaces), or else on their sketches.
struct RecordedSide {
    std::string surface, basis, hierarchy;
};

RecordedSide recorded_side(const Header& candidates, const std::string& side) {
    const auto in_list = [&](int k) {
        return candidates.input_hash(std::string("surfaces.") + char((side == "A" ? 'A' : 'D') + k));
    };
    const auto of_sketch = [&](const char* what) { return candidates.input_hash(side + ".sketch." + what); };
    if (!in_list(0).empty()) return {in_list(0), in_list(1), in_list(2)};
    return {of_sketch("surface"), of_sketch("basis"), of_sketch("hierarchy")};
}

}  // namespace

Artifact<Surface> read_surface_or_domain(Stage& stage, const std::string& role, const std::string& path) {
    if (read_header(path).kind != ArtifactType<Domain>::kind) return stage.read<Surface>(role, path);
    Artifact<Domain> domain = stage.read<Domain>(role, path);
    Artifact<Surface> surface{std::move(domain.header), {}};
    static_cast<Domain&>(surface.value) = std::move(domain.value);
    surface.value.input = surface.value.mesh;
    return surface;
}

PairInputs::PairInputs(Stage& stage, const std::string& kind)
    : kind_(kind), A_(declare(stage, "A." + kind)), B_(declare(stage, "B." + kind)) {}

PairInputs::Paths PairInputs::declare(Stage& stage, const std::string& role) {
    const std::string& surface = stage.input(
        role + "surface", "surface of varimap-coarsen or varimap-preprocess, or domain of varimap-domain");
    const std::string& basis = stage.input(role + "basis", "basis of varimap-eigen");
    const std::string& hierarchy = stage.input(role + "hierarchy", "hierarchy of varimap-hierarchy");
    return {surface, basis, hierarchy};
}

SurfaceData PairInputs::read(Stage& stage, const std::string& side, const Paths& paths) {
    const std::string role = side + "." + kind_;
    auto surface = read_surface_or_domain(stage, role + "surface", paths.surface);
    auto basis = stage.read<Basis>(role + "basis", paths.basis);
    auto hierarchy = stage.read<Hierarchy>(role + "hierarchy", paths.hierarchy);
    Stage::require_lineage(basis.header, paths.basis, "surface", surface.header, paths.surface);
    Stage::require_lineage(hierarchy.header, paths.hierarchy, "surface", surface.header, paths.surface);
    Stage::require_lineage(hierarchy.header, paths.hierarchy, "basis", basis.header, paths.basis);
    headers_[side] = {surface.header, basis.header, hierarchy.header};
    SurfaceData data{std::move(surface.value), std::move(basis.value), std::move(hierarchy.value)};
    require_fit(data);
    return data;
}

void PairInputs::require_same(const Header& plan, const std::string& plan_path) const {
    for (const auto& [side, headers] : headers_)
        Stage::require_lineage(plan, plan_path, side + "." + kind_ + "hierarchy", headers.hierarchy,
                               paths(side).hierarchy);
}

std::string PairInputs::sketched(const std::string& side) const {
    return finer_surface(headers_.at(side).surface);
}

void PairInputs::require_sketched(const std::string& side, const Header& surface,
                                  const std::string& path) const {
    if (sketched(side) != surface.payload_hash)
        throw ArtifactError(
            fmt::format("'{}' is not the surface that was sketched; rerun varimap-coarsen", path));
}

void PairInputs::require_sketches(const Artifact<Candidates>& candidates, const std::string& path) const {
    for (const auto& [side, headers] : headers_) {
        const std::string& of = side == "A" ? candidates.value.sketched_A : candidates.value.sketched_B;
        if (of != headers.surface.payload_hash && of != finer_surface(headers.surface))
            throw ArtifactError(
                fmt::format("'{}' was found on a sketch of another surface than '{}'; rerun varimap-explore",
                            path, paths(side).surface));
        const RecordedSide found = recorded_side(candidates.header, side);
        if (found.surface != headers.surface.payload_hash) continue;
        const auto require = [&](const std::string& hash, const Header& given,
                                 const std::string& given_path) {
            if (hash != given.payload_hash)
                throw ArtifactError(
                    fmt::format("'{}' and '{}' do not belong together: the candidates were found with "
                                "another {} of '{}'; "
                                "rerun varimap-explore",
                                path, given_path, given.kind, paths(side).surface));
        };
        require(found.basis, headers.basis, paths(side).basis);
        require(found.hierarchy, headers.hierarchy, paths(side).hierarchy);
    }
}

bool PairInputs::are_same() const {
    const Headers &A = headers_.at("A"), &B = headers_.at("B");
    return A.surface.payload_hash == B.surface.payload_hash && A.basis.payload_hash == B.basis.payload_hash &&
           A.hierarchy.payload_hash == B.hierarchy.payload_hash;
}

void PairInputs::require_self_maps(const Header& self_maps, const std::string& path,
                                   const std::string& side) const {
    for (const char* of : {"A.", "B."})
        Stage::require_lineage(self_maps, path, of + kind_ + "hierarchy", headers_.at(side).hierarchy,
                               paths(side).hierarchy);
}

namespace {

InputVertex on_input(InputVertex in_file, const Surface& surface, const char* which) {
    const FileLink& link = surface.link;
    if (link.is_identity()) return in_file;
    const int vertex = in_file.index < int(link.vertex.size()) ? link.vertex[std::size_t(in_file.index)] : -1;
    if (vertex < 0)
        throw InputError(fmt::format(
            "landmark vertex {} of the {} is not on the surface that is mapped; choose another vertex",
            in_file.index, which));
    return {vertex};
}

}  // namespace

Landmarks on_inputs(Landmarks landmarks, const Surface& A, const Surface& B) {
    for (auto& [a, b] : landmarks.vertices) {
        a = on_input(a, A, "source");
        b = on_input(b, B, "target");
    }
    return landmarks;
}

Landmarks read_landmarks(Stage& stage, const std::vector<std::string>& files, const Surface& A,
                         const Surface& B, const LandmarkReading& reading) {
    if (files.empty()) return {};
    const Landmarks landmarks = on_inputs(
        read_landmarks(files, in_numbers_of_file(A.input, A.link), in_numbers_of_file(B.input, B.link),
                       reading, Repeats::refuse, A.link.fate, B.link.fate),
        A, B);
    for (size_t i = 0; i < files.size(); ++i)
        stage.record_file(files.size() == 1 ? "landmarks" : i == 0 ? "landmarks.A" : "landmarks.B", files[i]);
    if (landmarks.left_out > 0) stage.record_number("landmarks_left_out", landmarks.left_out);
    return landmarks;
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

Correspondences correspondences_of(const PointMap& map, const Surface& A, const Surface& B) {
    const PointMap images = from_file(map, A, B);
    const PointMap vertices = points_at_vertices(A.input);
    Correspondences pairs;
    for (std::size_t v = 0; v < images.size(); ++v) {
        if (images[v].face < 0 || vertices[v].face < 0) continue;
        pairs.from_A.emplace_back(vertices[v], images[v]);
        pairs.from_B.emplace_back(images[v], vertices[v]);
    }
    if (pairs.from_A.empty())
        throw InputError("the initial map gives no image to any vertex of the source that is mapped");
    return pairs;
}

PairContext pair_context(SurfaceData A, SurfaceData B, const VertexPairs<MeshVertex>& landmarks,
                         const PointPairs& points, double landmark_weight) {
    if (!points.empty()) {
        std::vector<int> vertices_A, vertices_B;
        std::vector<SurfacePoint> points_A, points_B;
        for (const auto& [a, b] : landmarks) vertices_A.push_back(a.index), vertices_B.push_back(b.index);
        for (const auto& [a, b] : points) points_A.push_back(a), points_B.push_back(b);
        move_vertices(A, vertices_A, points_A);
        move_vertices(B, vertices_B, points_B);
    }
    return {std::move(A), std::move(B), landmarks, landmark_weight};
}

PairContext pair_context(SurfaceData A, SurfaceData B, const Landmarks& landmarks, double landmark_weight) {
    const auto vertices = to_mesh_vertices(landmarks.vertices, A.surface, B.surface);
    const PointPairs points = landmark_points(landmarks, A.surface, B.surface);
    return pair_context(std::move(A), std::move(B), vertices, points, landmark_weight);
}

PairContext sketch_context(SurfaceData A, SurfaceData B, const Landmarks& landmarks, double landmark_weight) {
    if (landmarks.vertices.size() <= most_named_landmarks)
        return pair_context(std::move(A), std::move(B), landmarks, landmark_weight);
    const HeldApart held = held_apart(some_for_sketch(landmarks), A.surface, B.surface);
    if (held.vertices.size() < landmarks.vertices.size())
        log("{} of {} landmarks are too many or too near to others for the sketches: they count only where "
            "the map is solved for",
            landmarks.vertices.size() - held.vertices.size(), landmarks.vertices.size());
    const PointPairs points = landmark_points(held.landmarks, A.surface, B.surface);
    return pair_context(std::move(A), std::move(B), held.vertices, points, landmark_weight);
}

}  // namespace varimap
