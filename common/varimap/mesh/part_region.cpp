#include "varimap/mesh/part_region.h"

#include <algorithm>
#include <utility>

#include "varimap/artifact/cereal_eigen.h"
#include "varimap/artifact/consistency.h"
#include "varimap/mesh/topology.h"

namespace varimap {

template <class Archive>
void serialize(Archive& archive, PartRegion& region) {
    archive(region.face_count, region.faces);
}

std::string encode(const PartRegion& region) {
    return cereal_encode(region);
}

void decode(const std::string& payload, PartRegion& region) {
    cereal_decode(payload, region);
    require<PartRegion>(!region.faces.empty() && are_distinct_in_range(region.faces, region.face_count) &&
                            std::is_sorted(region.faces.begin(), region.faces.end()),
                        "faces");
}

namespace {

double area_of(const TriangleMesh& mesh, const std::vector<int>& faces) {
    double area = 0;
    for (const int f : faces) area += face_normal(mesh, f).norm() / 2;
    return area;
}

std::vector<int> marked_faces(const FaceData<char>& marked) {
    std::vector<int> faces;
    for (int f = 0; f < marked.size(); ++f)
        if (marked[f]) faces.push_back(f);
    return faces;
}

/// Turns the patches of faces with that mark over that are smaller than `least`.
void turn_small_patches(const TriangleMesh& mesh, const Edges& edges, char mark, double least,
                        FaceData<char>& marked) {
    std::vector<char> chosen;
    for (const char m : marked) chosen.push_back(m == mark);
    for (const std::vector<int>& patch : face_components(edges, std::move(chosen)))
        if (area_of(mesh, patch) < least)
            for (const int f : patch) marked[f] = !mark;
}

/// Into how many fans a vertex's marked faces fall.
int fans(std::span<const int> faces, int v, const Edges& edges, const FaceData<char>& marked) {
    int count = 0, joints = 0;  // every joint of two marked faces is seen from both
    for (const int f : faces) {
        if (!marked[f]) continue;
        ++count;
        for (int c = 0; c < 3; ++c) {
            const auto& ends = edges.vertices[std::size_t(edges.of_side[std::size_t(3 * f + c)])];
            if (ends[0] != v && ends[1] != v) continue;
            for (const int side : edges.sides[edges.of_side[std::size_t(3 * f + c)]])
                joints += side / 3 != f && marked[side / 3];
        }
    }
    return count - joints / 2;
}

void open_pinches(const TriangleMesh& mesh, const Edges& edges, FaceData<char>& marked) {
    const Adjacency faces_of_vertex = vertex_faces(mesh);
    for (bool changed = true; changed;) {
        changed = false;
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            if (fans(faces_of_vertex[v], v, edges, marked) < 2) continue;
            changed = true;
            for (const int f : faces_of_vertex[v]) marked[f] = 1;
        }
    }
}

}  // namespace

PartRegion tidy_region(const TriangleMesh& mesh, FaceData<char> marked) {
    constexpr double least_hole = 1e-3, least_piece = 0.05;
    const Edges edges = find_edges(mesh);
    const auto fill_holes = [&] {
        turn_small_patches(mesh, edges, 0, least_hole * surface_area(mesh), marked);
    };
    fill_holes();
    turn_small_patches(mesh, edges, 1, least_piece * area_of(mesh, marked_faces(marked)), marked);
    open_pinches(mesh, edges, marked);
    fill_holes();  // what the faces around pinches enclose
    return {mesh.face_count(), marked_faces(marked)};
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
    std::vector<int> number(std::size_t(whole.mesh.vertex_count()), -1);
    for (const int f : region.faces) {
        link.face.push_back(before.face[std::size_t(f)]);
        link.turned.push_back(before.turned[std::size_t(f)]);
        for (const int v : whole.mesh.faces.row(f)) number[std::size_t(v)] = 0;
    }
    std::vector<int> kept;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] < 0) continue;
        number[v] = int(kept.size());
        kept.push_back(int(v));
        link.origin.push_back(before.origin[v]);
    }
    const Faces corners = whole.mesh.faces(region.faces, Eigen::all);
    result.mesh = {whole.mesh.vertices(kept, Eigen::all),
                   corners.unaryExpr([&](int v) { return number[std::size_t(v)]; }), whole.mesh.space};
    link.fate = before.fate;
    for (std::size_t v = 0; v < before.vertex.size(); ++v) {
        const int own = before.vertex[v];
        link.vertex.push_back(own < 0 ? -1 : number[std::size_t(own)]);
        const bool had_face = own >= 0 && before.fate[v] < VertexFate::unused;
        if (had_face && link.vertex.back() < 0) link.fate[v] = VertexFate::outside_part;
    }
    return result;
}

}  // namespace varimap
