#include "stages/explore/telling_vertex.h"

#include <algorithm>
#include <limits>

#include "stages/explore/tips.h"
#include "varimap/core/index_set.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/surface/input_locator.h"

namespace varimap {

namespace {

/// Spread over A.
const std::vector<int>& some_samples(const PairContext& context) {
    constexpr std::size_t enough = 60;
    const std::vector<Level>& levels = context.A().hierarchy.levels;
    const auto level = std::find_if(levels.begin(), levels.end(),
                                    [](const Level& one) { return one.samples.size() >= enough; });
    return level == levels.end() ? levels.back().samples : level->samples;
}

/// Of A's vertices those whose images by the first map and by another are farthest apart in space.
std::vector<int> some_moved(const std::vector<Appraised>& list, std::size_t count,
                            const PairContext& context) {
    constexpr std::size_t most = 60;
    const TriangleMesh& B = context.B().surface.mesh;
    const Points first = positions(B, list[0].map.maps.A_to_B);
    Eigen::VectorXd gap = Eigen::VectorXd::Constant(first.rows(), std::numeric_limits<double>::infinity());
    for (std::size_t k = 1; k < count; ++k)
        gap = gap.cwiseMin((positions(B, list[k].map.maps.A_to_B) - first).rowwise().norm());
    std::vector<int> vertices = all_indices(gap.size());
    std::stable_sort(vertices.begin(), vertices.end(), [&](int a, int b) { return gap[a] > gap[b]; });
    vertices.resize(std::min(vertices.size(), most));
    return vertices;
}

/// Images of vertices of A by several maps, and how far from the others the first takes them.
class Images {
  public:
    Images(const std::vector<Appraised>& list, std::size_t count, const PairContext& context)
        : list_(list), count_(count), context_(context) {}

    int vertex(std::size_t map, int v) const {
        return nearest_vertex(context_.B().surface.mesh, list_[map].map.maps.A_to_B[std::size_t(v)]);
    }
    double gap(int v) const {
        const RowMatrix from_first = distances_from_each(context_.graph_B(), {vertex(0, v)});
        double least = from_first(vertex(1, v));
        for (std::size_t k = 2; k < count_; ++k) least = std::min(least, from_first(vertex(k, v)));
        return least;
    }
    /// That of the largest gap, and the gap.
    std::pair<int, double> most_telling(const std::vector<int>& vertices) const {
        std::pair<int, double> best{-1, -1};
        for (const int v : vertices)
            if (const double found = gap(v); found > best.second) best = {v, found};
        return best;
    }

  private:
    const std::vector<Appraised>& list_;
    std::size_t count_;
    const PairContext& context_;
};

}  // namespace

TellingVertex telling_vertex(const std::vector<Appraised>& list, std::size_t count,
                             const PairContext& context) {
    constexpr int most_tips = 12;
    constexpr double clear = 0.15;  // units of sqrt(area)
    const Images images(list, count, context);
    auto [best, gap] =
        images.most_telling(find_tips(context.graph_A(), some_samples(context), most_tips).vertices);
    if (gap < clear) best = images.most_telling(some_moved(list, count, context)).first;
    TellingVertex told{nearest_in_file(context.A().surface, best), {}};
    for (std::size_t k = 0; k < count; ++k)
        told.images.push_back(nearest_in_file(context.B().surface, images.vertex(k, best)));
    return told;
}

}  // namespace varimap
