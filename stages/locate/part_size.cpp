#include "stages/locate/part_size.h"

#include <algorithm>
#include <cmath>

#include "varimap/geodesics/geodesic_graph.h"

namespace varimap {

namespace {

/// Ratios of lengths that are taken for 1: of parts of the same body in other poses the upper quartile is .89
/// to 1.07.
constexpr double same_units = 1.25;

double upper_quartile(std::vector<double> values) {
    const auto at = values.begin() + std::ptrdiff_t((3 * (values.size() - 1) + 3) / 4);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Those of the whole's mesh over those of the part's, for all pairs of landmarks that are joined on both.
std::vector<double> length_ratios(const Surface& part, const std::vector<int>& landmarks_part,
                                  const Surface& whole, const std::vector<int>& landmarks_whole) {
    const RowMatrix on_part = distances_from_each(GeodesicGraph(part.mesh), landmarks_part);
    const RowMatrix on_whole = distances_from_each(GeodesicGraph(whole.mesh), landmarks_whole);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < landmarks_part.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const double own = on_part(Eigen::Index(i), landmarks_part[j]);
            const double other = on_whole(Eigen::Index(i), landmarks_whole[j]);
            if (own > 0 && other > 0 && std::isfinite(own) && std::isfinite(other))
                ratios.push_back(other / own);
        }
    return ratios;
}

}  // namespace

PartSize part_size(const Surface& part, const std::vector<int>& landmarks_part, const Surface& whole,
                   const std::vector<int>& landmarks_whole) {
    const std::vector<double> ratios = length_ratios(part, landmarks_part, whole, landmarks_whole);
    const double of_files = part.scale / whole.scale;  // times the ratio of meshes, which have unit area
    double scale = ratios.empty() ? 1 : upper_quartile(ratios) * of_files;
    if (std::max(scale, 1 / scale) < same_units) scale = 1;
    const double ratio = scale / of_files;
    return {scale, ratio * ratio};
}

}  // namespace varimap
