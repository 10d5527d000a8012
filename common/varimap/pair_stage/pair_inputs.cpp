#include "varimap/pair_stage/pair_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh/topology.h"
#include "varimap/spectral/spectral_check.h"

namespace varimap {

namespace {

MeshVertex mesh_vertex(const Surface& surface, InputVertex vertex, const char* which) {
    const MeshVertex v = mesh_vertex_at(surface, vertex);
    if (v.index < 0)
        throw InputError(fmt::format("landmark vertex {} of the {} belongs to no face; choose another vertex",
                                     vertex.index, which));
    return v;
}

bool is_at_vertex(const Surface& surface, InputVertex vertex) {
    return vertex_of(surface.mesh, surface.on_mesh[std::size_t(vertex.index)]) >= 0;
}

/// A repair makes one vertex of several; a landmark each would ask it to go to several places.
/// Near ones may share a vertex of a coarse mesh.
void require_unmerged(std::map<int, int>& taken, const Surface& surface, MeshVertex at, InputVertex vertex,
                      const char* which) {
    if (!is_at_vertex(surface, vertex)) return;
    const auto [other, is_new] = taken.emplace(at.index, vertex.index);
    if (!is_new)
        throw InputError(
            fmt::format("landmark vertices {} and {} of the {} became one when faces without area were "
                        "removed; keep one of the two landmarks",
                        other->second, vertex.index, which));
}

}  // namespace

PairInputs::PairInputs(Stage& stage) : A_(declare(stage, "A")), B_(declare(stage, "B")) {}

PairInputs::Paths PairInputs::declare(Stage& stage, const std::string& name) {
    const std::string& surface = stage.input(name + ".surface", "surface of varimap-preprocess");
    const std::string& basis = stage.input(name + ".basis", "basis of varimap-eigen");
    const std::string& hierarchy = stage.input(name + ".hierarchy", "hierarchy of varimap-hierarchy");
    return {surface, basis, hierarchy};
}

SurfaceData PairInputs::read(Stage& stage, const std::string& name, const Paths& paths) {
    auto surface = stage.read<Surface>(name + ".surface", paths.surface);
    auto basis = stage.read<Basis>(name + ".basis", paths.basis);
    auto hierarchy = stage.read<Hierarchy>(name + ".hierarchy", paths.hierarchy);
    Stage::require_lineage(basis.header, paths.basis, "surface", surface.header, paths.surface);
    Stage::require_lineage(hierarchy.header, paths.hierarchy, "surface", surface.header, paths.surface);
    Stage::require_lineage(hierarchy.header, paths.hierarchy, "basis", basis.header, paths.basis);
    hierarchies_.emplace_back(name + ".hierarchy", hierarchy.header);
    SurfaceData data{std::move(surface.value), std::move(basis.value), std::move(hierarchy.value)};
    require_fit(data);
    return data;
}

void PairInputs::require_same(const Header& plan, const std::string& plan_path) const {
    for (const auto& [role, header] : hierarchies_)
        Stage::require_lineage(plan, plan_path, role, header,
                               role == "A.hierarchy" ? A_.hierarchy : B_.hierarchy);
}

Landmarks read_landmarks(Stage& stage, const std::vector<std::string>& files, const Surface& A,
                         const Surface& B, LandmarkSpace space) {
    if (files.empty()) return {};
    const Landmarks landmarks = read_landmarks(files, A.input, B.input, space);
    for (size_t i = 0; i < files.size(); ++i)
        stage.record_file(files.size() == 1 ? "landmarks" : i == 0 ? "landmarks.A" : "landmarks.B", files[i]);
    return landmarks;
}

VertexPairs<MeshVertex> to_mesh_vertices(const VertexPairs<InputVertex>& landmarks, const Surface& A,
                                         const Surface& B) {
    VertexPairs<MeshVertex> result;
    std::map<int, int> taken_A, taken_B;
    for (const auto& [a, b] : landmarks) {
        result.emplace_back(mesh_vertex(A, a, "source"), mesh_vertex(B, b, "target"));
        require_unmerged(taken_A, A, result.back().first, a, "source");
        require_unmerged(taken_B, B, result.back().second, b, "target");
    }
    return result;
}

PointPairs landmark_points(const Landmarks& landmarks, const Surface& A, const Surface& B) {
    const auto is_exact = [&](const auto& pair) {
        return is_at_vertex(A, pair.first) && is_at_vertex(B, pair.second);
    };
    if (!landmarks.points.empty() ||
        std::all_of(landmarks.vertices.begin(), landmarks.vertices.end(), is_exact))
        return landmarks.points;
    PointPairs points;
    for (const auto& [a, b] : landmarks.vertices)
        points.emplace_back(point_at_vertex(A.input, a.index), point_at_vertex(B.input, b.index));
    return points;
}

}  // namespace varimap
