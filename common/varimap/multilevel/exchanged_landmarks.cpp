#include "varimap/multilevel/exchanged_landmarks.h"

#include <cmath>
#include <limits>

#include "varimap/core/index_set.h"
#include "varimap/geodesics/geodesic_graph.h"

namespace varimap {

namespace {

/// Between landmarks, in units of sqrt(area).
Eigen::MatrixXd distances_between(const std::vector<int>& vertices, const GeodesicGraph& graph) {
    const RowMatrix to_all = distances_from_each(graph, vertices);
    return to_all(Eigen::all, vertices);
}

/// Mean |log| of the ratios of distances. `partner`: per landmark of A, which of B it has.
double mean_change(const Eigen::MatrixXd& of_A, const Eigen::MatrixXd& of_B,
                   const std::vector<int>& partner) {
    constexpr double short_distance = 0.1;  // near landmarks do not count
    const int count = int(partner.size());
    double sum = 0;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < i; ++j)
            sum +=
                std::abs(std::log((of_A(i, j) + short_distance) /
                                  (of_B(partner[std::size_t(i)], partner[std::size_t(j)]) + short_distance)));
    return 2 * sum / (count * (count - 1));
}

/// Tries all exchanges, pair by pair.
class ExchangeSearch {
  public:
    ExchangeSearch(Eigen::MatrixXd of_A, Eigen::MatrixXd of_B)
        : of_A_(std::move(of_A)), of_B_(std::move(of_B)), partner_(all_indices(of_A_.rows())) {}

    Exchange best() {
        const double as_they_are = change();
        extend(0, {});
        constexpr double much = 0.1;
        return least_ < as_they_are + much ? best_ : Exchange{};
    }

  private:
    void extend(int next, const Exchange& so_far) {
        const int count = int(partner_.size());
        if (next == count) {
            if (so_far.empty()) return;
            if (const double now = change(); now < least_) least_ = now, best_ = so_far;
            return;
        }
        extend(next + 1, so_far);
        if (partner_[std::size_t(next)] != next) return;
        for (int other = next + 1; other < count; ++other) {
            if (partner_[std::size_t(other)] != other) continue;
            Exchange longer = so_far;
            longer.emplace_back(next, other);
            std::swap(partner_[std::size_t(next)], partner_[std::size_t(other)]);
            extend(next + 1, longer);
            std::swap(partner_[std::size_t(next)], partner_[std::size_t(other)]);
        }
    }
    double change() const { return mean_change(of_A_, of_B_, partner_); }

    Eigen::MatrixXd of_A_, of_B_;
    std::vector<int> partner_;
    Exchange best_;
    double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Exchange likely_exchange(const PairContext& context, double scale) {
    constexpr std::size_t most = 10;
    const std::size_t count = context.landmarks().size();
    if (count < 2 || count > most) return {};
    return ExchangeSearch(scale * distances_between(context.landmarks_A(), context.graph_A()),
                          distances_between(context.landmarks_B(), context.graph_B()))
        .best();
}

bool distances_fit(const PairContext& context, const VertexPairs<MeshVertex>& other) {
    constexpr std::size_t few = 4, most = 100;
    constexpr double much = 0.5;
    if (other.size() < few || other.size() > most) return false;
    const auto change = [&](const VertexPairs<MeshVertex>& landmarks) {
        std::vector<int> on_A, on_B;
        for (const auto& [a, b] : landmarks) on_A.push_back(a.index), on_B.push_back(b.index);
        return mean_change(distances_between(on_A, context.graph_A()),
                           distances_between(on_B, context.graph_B()),
                           all_indices(Eigen::Index(on_A.size())));
    };
    return change(other) < much * change(context.landmarks());
}

VertexPairs<MeshVertex> exchanged(VertexPairs<MeshVertex> landmarks, const Exchange& exchange) {
    for (const auto& [i, j] : exchange)
        std::swap(landmarks[std::size_t(i)].second, landmarks[std::size_t(j)].second);
    return landmarks;
}

}  // namespace varimap
