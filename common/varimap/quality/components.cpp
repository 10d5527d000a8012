#include "varimap/quality/components.h"

#include <algorithm>
#include <utility>

#include "varimap/mesh/boundary.h"

namespace varimap {

namespace {

/// A mesh's faces by component, and how large they are.
struct ComponentFaces {
    ConnectedComponents labels;
    std::vector<std::vector<int>> faces;  ///< per component
    FaceData<double> share;               ///< per face: of the mesh's area

    explicit ComponentFaces(const TriangleMesh& mesh)
        : labels(connected_components(mesh)), faces(labels.faces()), share(mesh.face_count()) {
        const double area = surface_area(mesh);
        for (int f = 0; f < mesh.face_count(); ++f) share[f] = face_normal(mesh, f).norm() / (2 * area);
    }
};

/// Per component of the source, and of the target, how much of the source's area lies on the latter.
using Shares = std::vector<std::vector<double>>;
Shares shares_on(const PointMap& map, const TriangleMesh& source, const ComponentFaces& of_source,
                 const ComponentFaces& of_target) {
    Shares shares(of_source.faces.size(), std::vector<double>(of_target.faces.size(), 0));
    for (std::size_t c = 0; c < shares.size(); ++c)
        for (const int f : of_source.faces[c])
            for (const int v : source.faces.row(f)) {
                if (map[v].face < 0) continue;
                const int onto = of_target.labels.of_face[std::size_t(map[v].face)];
                shares[c][std::size_t(onto)] += of_source.share[f] / 3;
            }
    return shares;
}

/// `there`: of these components; `back`: of the other surface's.
std::vector<ComponentImage> images(const TriangleMesh& mesh, const ComponentFaces& components,
                                   const Shares& there, const Shares& back) {
    std::vector<ComponentImage> found(components.faces.size());
    for (int v = mesh.vertex_count() - 1; v >= 0; --v)
        if (const int c = components.labels.of_vertex[std::size_t(v)]; c >= 0)
            found[std::size_t(c)].vertex = v;
    for (std::size_t c = 0; c < found.size(); ++c) {
        ComponentImage& one = found[c];
        for (const int f : components.faces[c]) one.area += components.share[f];
        const auto most = std::max_element(there[c].begin(), there[c].end());
        if (most != there[c].end() && *most > 0) {
            one.onto = int(most - there[c].begin());
            one.on_that = std::min(1.0, *most / one.area);
        }
        for (const std::vector<double>& shares : back) one.taken += shares[c] / one.area;
        one.orientation = orientation_sign({mesh.vertices, mesh.faces(components.faces[c], Eigen::all)});
    }
    return found;
}

bool lacks_partner(const ComponentImage& one) {
    return !one.has_partner();
}

}  // namespace

bool ComponentImages::are_astray() const {
    return are_several() && std::ranges::any_of(of_source, lacks_partner) &&
           std::ranges::any_of(of_target, lacks_partner);
}

int ComponentImages::orientation_product(const ComponentImage& one) const {
    if (one.onto < 0) return 0;
    const ComponentImage& partner = of_target[std::size_t(one.onto)];
    if (partner.onto < 0 || &of_source[std::size_t(partner.onto)] != &one) return 0;
    return one.orientation * partner.orientation;
}

std::vector<int> ComponentImages::opposed() const {
    const auto largest = std::ranges::max_element(of_source, {}, &ComponentImage::area);
    std::vector<int> found;
    for (std::size_t c = 0; c < of_source.size(); ++c)
        if (orientation_product(of_source[c]) * orientation_product(*largest) < 0) found.push_back(int(c));
    return found;
}

ComponentImages measure_components(const PointMap& map, const PointMap& back, const TriangleMesh& source,
                                   const TriangleMesh& target) {
    const ComponentFaces of_source(source), of_target(target);
    const Shares there = shares_on(map, source, of_source, of_target),
                 here = shares_on(back, target, of_target, of_source);
    return {images(source, of_source, there, here), images(target, of_target, here, there)};
}

}  // namespace varimap
