#include "varimap/surface/part_region.h"

#include <algorithm>
#include <utility>

#include "varimap/artifact/cereal_eigen.h"
#include "varimap/artifact/consistency.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/serialization.h"
#include "varimap/mesh/topology.h"

namespace varimap {

template <class Archive>
void serialize(Archive& archive, PartRegion& region) {
    archive(region.face_count, region.faces, region.part_is_source, region.placed, region.strain);
}

std::string encode(const PartRegion& region) {
    return cereal_encode(region);
}

void decode(const std::string& payload, PartRegion& region) {
    cereal_decode(payload, region);
    require<PartRegion>(!region.faces.empty() && are_distinct_in_range(region.faces, region.face_count) &&
                            std::is_sorted(region.faces.begin(), region.faces.end()),
                        "faces");
    require<PartRegion>(are_points(region.placed), "points");
    require<PartRegion>(region.strain >= 0, "strain");
}

void require_places(const PartRegion& region, const TriangleMesh& part_file, const TriangleMesh& whole_file) {
    if (!is_map_between(region.placed, part_file, whole_file))
        throw ArtifactError("the region is one of another part or whole; rerun varimap-locate");
}

namespace {

std::vector<int> marked_faces(const FaceData<char>& marked) {
    std::vector<int> faces;
    for (int f = 0; f < marked.size(); ++f)
        if (marked[f]) faces.push_back(f);
    return faces;
}

std::vector<std::vector<int>> patches_of(char mark, const Edges& edges, const FaceData<char>& marked) {
    std::vector<char> chosen;
    for (const char m : marked) chosen.push_back(m == mark);
    return face_components(edges, std::move(chosen));
}

void fill_holes(const TriangleMesh& mesh, const Edges& edges, FaceData<char>& marked) {
    const double least = 1e-3 * surface_area(mesh);
    for (const std::vector<int>& patch : patches_of(0, edges, marked))
        if (area_of(mesh, patch) < least)
            for (const int f : patch) marked[f] = 1;
}

void drop_pieces(const TriangleMesh& mesh, const Edges& edges, FaceData<char>& marked) {
    const auto patches = patches_of(1, edges, marked);
    double total = 0, largest = 0;
    for (const std::vector<int>& patch : patches) {
        const double area = area_of(mesh, patch);
        total += area;
        largest = std::max(largest, area);
    }
    for (const std::vector<int>& patch : patches)
        if (area_of(mesh, patch) < std::min(.05 * total, largest))
            for (const int f : patch) marked[f] = 0;
}

void open_pinches(const TriangleMesh& mesh, const Edges& edges, FaceData<char>& marked) {
    const Adjacency faces_of_vertex = vertex_faces(mesh);
    for (bool changed = true; changed;) {
        changed = false;
        const VertexData<int> fans = count_fans(mesh, edges, marked);
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            if (fans[v] < 2) continue;
            changed = true;
            for (const int f : faces_of_vertex[v]) marked[f] = 1;
        }
    }
}

}  // namespace

void join_patches(const TriangleMesh& mesh, const FaceData<char>& between, FaceData<char>& marked) {
    const Edges edges = find_edges(mesh);
    const auto patches = patches_of(1, edges, marked);
    if (patches.size() < 2) return;
    std::vector<int> reached =
        *std::max_element(patches.begin(), patches.end(),
                          [&](const auto& a, const auto& b) { return area_of(mesh, a) < area_of(mesh, b); });
    constexpr int unknown = -2, none = -1;
    FaceData<int> before(mesh.face_count(), unknown);
    for (const int f : reached) before[f] = none;
    for (std::size_t i = 0; i < reached.size(); ++i) {
        const int f = reached[i];
        if (marked[f])
            for (int g = before[f]; g != none && !marked[g]; g = before[g]) marked[g] = 1;
        for (int c = 0; c < 3; ++c)
            for (const int half_edge : edges.half_edges[edges.of_half_edge[std::size_t(3 * f + c)]]) {
                const int g = half_edge / 3;
                if (before[g] != unknown || !(marked[g] || between[g])) continue;
                before[g] = f;
                reached.push_back(g);
            }
    }
}

std::vector<int> tidy_region(const TriangleMesh& mesh, FaceData<char> marked) {
    const Edges edges = find_edges(mesh);
    fill_holes(mesh, edges, marked);
    drop_pieces(mesh, edges, marked);
    open_pinches(mesh, edges, marked);
    fill_holes(mesh, edges, marked);  // what the faces around pinches enclose
    return marked_faces(marked);
}

RepairedMesh cropped(RepairedMesh whole, const PartRegion& region) {
    if (region.face_count != whole.mesh.face_count())
        throw ArtifactError(
            "the region is one of another mesh, or of one repaired otherwise; rerun varimap-locate");
    const FileLink before = whole.link.is_identity() ? link_to_itself(whole.mesh) : std::move(whole.link);
    RepairedMesh result;
    result.counts = whole.counts;
    FileLink& link = result.link;
    link.file = before.file;
    for (const int f : region.faces) {
        link.face.push_back(before.face[std::size_t(f)]);
        link.turned.push_back(before.turned[std::size_t(f)]);
    }
    const UsedVertices kept =
        used_vertices(whole.mesh.faces(region.faces, Eigen::all), whole.mesh.vertex_count());
    for (const int v : kept.vertex) link.origin.push_back(before.origin[std::size_t(v)]);
    result.mesh = {whole.mesh.vertices(kept.vertex, Eigen::all), kept.faces, whole.mesh.space};
    link.fate = before.fate;
    for (std::size_t v = 0; v < before.vertex.size(); ++v) {
        const int own = before.vertex[v];
        link.vertex.push_back(own < 0 ? -1 : kept.number[std::size_t(own)]);
        const bool had_face = own >= 0 && before.fate[v] < VertexFate::unused;
        if (had_face && link.vertex.back() < 0) link.fate[v] = VertexFate::outside_part;
    }
    return result;
}

}  // namespace varimap
