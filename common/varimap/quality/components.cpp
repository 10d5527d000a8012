#include "varimap/quality/components.h"

#include <algorithm>

#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

double face_area(const TriangleMesh& mesh, int f) {
    return face_normal(mesh, f).norm() / 2;
}

/// Per component of the source, and of the target, how much of the former's area lies on the latter.
std::vector<std::vector<double>> areas_by_component(const PointMap& map, const TriangleMesh& source,
                                                    const std::vector<int>& of_source,
                                                    const TriangleMesh& target,
                                                    const std::vector<int>& of_target) {
    const auto count = [](const std::vector<int>& of_vertex) {
        return of_vertex.empty() ? 0 : std::size_t(*std::max_element(of_vertex.begin(), of_vertex.end()) + 1);
    };
    std::vector<std::vector<double>> areas(count(of_source), std::vector<double>(count(of_target), 0));
    for (int f = 0; f < source.face_count(); ++f) {
        const double third = face_area(source, f) / 3;
        for (const int v : source.faces.row(f)) {
            if (map[v].face < 0) continue;
            const int onto = of_target[std::size_t(target.faces(map[v].face, 0))];
            areas[std::size_t(of_source[std::size_t(v)])][std::size_t(onto)] += third;
        }
    }
    return areas;
}

std::vector<ComponentImage> images(const PointMap& map, const TriangleMesh& source,
                                   const std::vector<int>& of_source, const TriangleMesh& target,
                                   const std::vector<int>& of_target) {
    const auto areas = areas_by_component(map, source, of_source, target, of_target);
    std::vector<ComponentImage> found(areas.size());
    for (int v = source.vertex_count() - 1; v >= 0; --v)
        if (const int c = of_source[std::size_t(v)]; c >= 0) found[std::size_t(c)].vertex = v;
    const double total = surface_area(source);
    for (int f = 0; f < source.face_count(); ++f)
        found[std::size_t(of_source[std::size_t(source.faces(f, 0))])].area += face_area(source, f) / total;
    for (std::size_t c = 0; c < found.size(); ++c) {
        const auto most = std::max_element(areas[c].begin(), areas[c].end());
        if (most == areas[c].end() || !(*most > 0)) continue;
        found[c].onto = int(most - areas[c].begin());
        found[c].on_that = std::min(1.0, *most / (found[c].area * total));
    }
    return found;
}

void find_partners(std::vector<ComponentImage>& own, const std::vector<ComponentImage>& others) {
    for (std::size_t c = 0; c < own.size(); ++c)
        own[c].has_partner = own[c].onto >= 0 && others[std::size_t(own[c].onto)].onto == int(c);
}

bool is_single(const std::vector<ComponentImage>& components) {
    return std::any_of(components.begin(), components.end(),
                       [](const ComponentImage& one) { return !one.has_partner; });
}

}  // namespace

bool ComponentImages::are_astray() const {
    return is_single(of_source) && is_single(of_target);
}

ComponentImages measure_components(const PointMap& map, const PointMap& back, const TriangleMesh& source,
                                   const TriangleMesh& target) {
    const std::vector<int> on_source = vertex_components(source), on_target = vertex_components(target);
    ComponentImages found{images(map, source, on_source, target, on_target),
                          images(back, target, on_target, source, on_source)};
    find_partners(found.of_source, found.of_target);
    find_partners(found.of_target, found.of_source);
    return found;
}

}  // namespace varimap
