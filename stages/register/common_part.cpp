#include "stages/register/common_part.h"

#include "varimap/core/error.h"
#include "varimap/core/indexed.h"

namespace varimap {
namespace {

/// Of the template's vertices, which are finite on it and on all specimens.
VertexData<bool> present_everywhere(const TriangleMesh& first, const std::vector<Points>& specimens) {
    VertexData<bool> present(first.vertex_count());
    for (int v = 0; v < first.vertex_count(); ++v) {
        present[v] = first.vertices.row(v).allFinite();
        for (const Points& points : specimens) present[v] = present[v] && points.row(v).allFinite();
    }
    return present;
}

}  // namespace

CommonPart common_part(const TriangleMesh& first, const std::vector<Points>& specimens) {
    const VertexData<bool> present = present_everywhere(first, specimens);
    Eigen::VectorXd area = Eigen::VectorXd::Zero(first.vertex_count());
    std::vector<int> faces;
    for (int f = 0; f < first.face_count(); ++f) {
        const auto corners = first.faces.row(f);
        if (!present[corners[0]] || !present[corners[1]] || !present[corners[2]]) continue;
        faces.push_back(f);
        for (const int v : corners) area[v] += face_normal(first, f).norm() / 6;
    }
    CommonPart result;
    for (int v = 0; v < first.vertex_count(); ++v)
        if (area[v] > 0) result.vertices.push_back(v);
    if (result.vertices.size() < 3) throw InputError("no part of the template is mapped to every specimen");
    result.faces = first.faces(faces, Eigen::all);
    result.weights = area(result.vertices) / area(result.vertices).sum();
    return result;
}

}  // namespace varimap
