#include "varimap/parts/strained_parts.h"

#include <algorithm>

#include "varimap/core/statistics.h"
#include "varimap/sliding/face_energy.h"

namespace varimap {

namespace {

constexpr int smoothing = 3;      ///< rounds of averaging of the excess
constexpr double saturation = 1;  ///< excess of one face that counts at most
constexpr double known = 0.8;     ///< share of rejected faces from which on a part is not tried again
constexpr int least_rings = 2;    ///< by which a part is widened

/// Per face the mean over its corners of the mean, weighted by area, over their faces.
FaceData<double> averaged(const SlidingMap& map, const FaceData<double>& value) {
    const TriangleMesh& source = map.source();
    VertexData<double> mean(source.vertex_count(), 0);
    for (int v = 0; v < source.vertex_count(); ++v) {
        double sum = 0, area = 0;
        for (const int f : map.faces_of_vertex()[v]) {
            sum += map.rest(f).area * value[f];
            area += map.rest(f).area;
        }
        if (area > 0) mean[v] = sum / area;
    }
    FaceData<double> result(source.face_count());
    for (int f = 0; f < source.face_count(); ++f) {
        const auto c = source.faces.row(f);
        result[f] = (mean[c[0]] + mean[c[1]] + mean[c[2]]) / 3;
    }
    return result;
}

/// Excess energy per face, averaged over its surroundings.
FaceData<double> strain(const SlidingMap& map) {
    const RobustEnergy excess(judged_energy, 0);
    FaceData<double> value(map.source().face_count(), 0);
    for (int f = 0; f < value.size(); ++f) {
        if (!map.is_mapped(f)) continue;
        const ImageTriangle image = map.image_triangle(f);
        value[f] = std::min(saturation, excess.value(image.q, image.D));
    }
    for (int round = 0; round < smoothing; ++round) value = averaged(map, value);
    return value;
}

/// Marks the faces around `ring` that are not inside yet, and returns them.
std::vector<int> grow(const SlidingMap& map, const std::vector<int>& ring, FaceData<bool>& inside) {
    std::vector<int> next;
    for (const int f : ring)
        for (int k = 0; k < 3; ++k)
            for (const int g : map.faces_of_vertex()[map.source().faces(f, k)])
                if (!inside[g]) inside[g] = true, next.push_back(g);
    return next;
}

/// Marks all faces that those inside cut off from the largest rest.
void add_cut_off(const SlidingMap& map, const Edges& edges, FaceData<bool>& inside) {
    FaceData<bool> outside(inside.size());
    for (int f = 0; f < inside.size(); ++f) outside[f] = !inside[f];
    const auto rest = face_components(edges, outside);
    const auto largest = std::max_element(rest.begin(), rest.end(), [&](const auto& a, const auto& b) {
        return area_of(map, a) < area_of(map, b);
    });
    for (auto it = rest.begin(); it != rest.end(); ++it)
        if (it != largest)
            for (const int f : *it) inside[f] = true;
}

}  // namespace

std::vector<std::vector<int>> strained_parts(const SlidingMap& map, const Edges& edges,
                                             const FaceData<bool>& rejected, const StrainLimits& limits) {
    const FaceData<double> value = strain(map);
    const std::vector<double>& values = value;
    const double middle = upper_median(Eigen::Map<const Eigen::VectorXd>(values.data(), value.size()));
    const double limit = std::max(limits.excess, limits.contrast * middle);
    FaceData<bool> strained(value.size());
    for (int f = 0; f < value.size(); ++f) strained[f] = value[f] > limit;
    auto parts = face_components(edges, strained);
    std::erase_if(parts, [&](const auto& part) {
        const auto count = std::count_if(part.begin(), part.end(), [&](int f) { return rejected[f]; });
        return area_of(map, part) < limits.area || double(count) > known * double(part.size());
    });
    std::stable_sort(parts.begin(), parts.end(),
                     [&](const auto& a, const auto& b) { return area_of(map, a) > area_of(map, b); });
    if (int(parts.size()) > limits.most_parts) parts.resize(limits.most_parts);
    return parts;
}

FaceData<bool> widened(const SlidingMap& map, const Edges& edges, const std::vector<int>& part, double area) {
    FaceData<bool> inside(map.source().face_count());
    for (const int f : part) inside[f] = true;
    std::vector<int> ring = part;
    double grown = area_of(map, part);
    for (int r = 0; !ring.empty() && (r < least_rings || grown < area); ++r) {
        ring = grow(map, ring, inside);
        grown += area_of(map, ring);
    }
    add_cut_off(map, edges, inside);
    return inside;
}

}  // namespace varimap
