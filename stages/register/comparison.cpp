#include "stages/register/comparison.h"

#include "varimap/core/error.h"

namespace varimap {
namespace {

/// A shape; Procrustes analysis needs that it has a size.
Points shape_of(const Registration& all, std::size_t i, const Extent& extent) {
    Points shape = extent.of(all.shape(i));
    const double rounding = 1e-14 * shape.cwiseAbs().maxCoeff();
    if (!(size_about_centroid(shape, extent.weights) > rounding))
        throw InputError(all.names[i] +
                         ": all of the template's points lie in one place on it; look at its map");
    return shape;
}

Alignment aligned_wholes(const Registration& all, const Extent& common, bool scale) {
    std::vector<Points> wholes;
    for (std::size_t i = 0; i < all.points.size(); ++i)
        if (!all.is_part[i]) wholes.push_back(shape_of(all, i, common));
    const Points start = common.of(all.first.vertices);
    if (!wholes.empty()) return procrustes(wholes, start, common.weights, scale);
    Alignment none;
    none.mean = start;
    return none;
}

/// The rows of a part's vertices, of points of the common ones. Both extents are ascending.
Points rows_of(const Extent& part, const Extent& common, const Points& points) {
    std::vector<int> rows;
    std::size_t row = 0;
    for (const int v : part.vertices) {
        while (common.vertices[row] != v) ++row;
        rows.push_back(int(row));
    }
    return points(rows, Eigen::all);
}

}  // namespace

ShapeComparison compare_shapes(const Registration& all, const Extents& extents, int components, bool scale) {
    const Extent& common = extents.common();
    Alignment wholes = aligned_wholes(all, common, scale);
    const double mean_size = size_about_centroid(wholes.mean, common.weights);
    ShapeComparison result;
    if (!wholes.shapes.empty()) result.components = principal_components(wholes, common.weights, components);
    for (std::size_t i = 0, whole = 0; i < all.points.size(); ++i) {
        if (!all.is_part[i]) {
            result.aligned.push_back(std::move(wholes.shapes[whole]));
            result.sizes.push_back(wholes.sizes[whole]);
            result.distances.push_back(wholes.distances[whole]);
            ++whole;
            continue;
        }
        const Extent& own = extents.of(i);
        LaidOver part =
            laid_over(shape_of(all, i, own), rows_of(own, common, wholes.mean), own.weights, scale);
        result.aligned.push_back(std::move(part.shape));
        result.sizes.push_back(part.size_ratio * mean_size);
        result.distances.push_back(part.distance);
    }
    result.mean = std::move(wholes.mean);
    constexpr double rounding = 1e-9;  // of copies of one surface
    result.is_outlier = outliers(result.distances, rounding * mean_size);
    return result;
}

}  // namespace varimap
