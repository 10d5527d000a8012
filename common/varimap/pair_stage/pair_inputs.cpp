#include "varimap/pair_stage/pair_inputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "varimap/core/log.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/pair_stage/landmark_vertices.h"
#include "varimap/spectral/spectral_check.h"
#include "varimap/surface/input_locator.h"

namespace varimap {

namespace {

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

/// Moves the vertices that stand for landmarks to these; `points` empty: they are there.
void move_landmarks(SurfaceData& A, SurfaceData& B, const VertexPairs<MeshVertex>& landmarks,
                    const PointPairs& points) {
    if (points.empty()) return;
    std::vector<int> vertices_A, vertices_B;
    std::vector<SurfacePoint> points_A, points_B;
    for (const auto& [a, b] : landmarks) vertices_A.push_back(a.index), vertices_B.push_back(b.index);
    for (const auto& [a, b] : points) points_A.push_back(a), points_B.push_back(b);
    move_vertices(A, vertices_A, points_A);
    move_vertices(B, vertices_B, points_B);
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
                                "another {} of '{}'; rerun varimap-explore",
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
    move_landmarks(A, B, landmarks, points);
    return {std::move(A), std::move(B), landmarks, landmark_weight};
}

PairContext pair_context(SurfaceData A, SurfaceData B, const Landmarks& landmarks, double landmark_weight) {
    const auto vertices = to_mesh_vertices(landmarks.vertices, A.surface, B.surface);
    const PointPairs points = landmark_points(landmarks, A.surface, B.surface);
    return pair_context(std::move(A), std::move(B), vertices, points, landmark_weight);
}

PairContext sketch_context(SurfaceData A, SurfaceData B, const Landmarks& landmarks, double landmark_weight) {
    const int given = int(landmarks.vertices.size());
    if (given <= few_landmarks) return pair_context(std::move(A), std::move(B), landmarks, landmark_weight);
    const HeldApart held = held_apart(landmarks, A.surface, B.surface);
    const int left_out = given - int(held.vertices.size());
    if (left_out > 0)
        log("{} of {} landmarks are too many or too near to others for the sketches: they count only where "
            "the map is solved for",
            left_out, given);
    move_landmarks(A, B, held.vertices, landmark_points(held.landmarks, A.surface, B.surface));
    return {std::move(A), std::move(B), held.vertices, landmark_weight, left_out};
}

}  // namespace varimap
