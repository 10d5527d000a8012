#include "stages/explore/tips.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stages/explore/starts.h"
#include "varimap/core/index_set.h"

namespace varimap {

namespace {

// Constants of this file are first guesses that did well on one hippopotamus and were not swept.

/// To other components it is far.
RowMatrix finite_distances(const GeodesicGraph& graph, const std::vector<int>& sources) {
    return distances_from_each(graph, sources).cwiseMin(1e3);
}

/// Maxima of a function on a graph and how far one must go down from each to get to a higher one.
std::vector<std::pair<double, int>> prominent_maxima(const Eigen::VectorXd& height,
                                                     const GeodesicGraph& graph) {
    const int n = graph.vertex_count();
    std::vector<int> order = all_indices(n), peak(static_cast<std::size_t>(n), -1);
    // Of equal heights the first counts as higher, here and where two peaks meet.
    const auto is_higher = [&](int a, int b) {
        return height[a] != height[b] ? height[a] > height[b] : a < b;
    };
    std::sort(order.begin(), order.end(), is_higher);
    const auto top = [&](int v) {
        while (peak[std::size_t(v)] != v) v = peak[std::size_t(v)] = peak[std::size_t(peak[std::size_t(v)])];
        return v;
    };
    std::vector<std::pair<double, int>> found;
    for (const int v : order) {
        peak[std::size_t(v)] = v;
        for (int e = graph.offset[std::size_t(v)]; e < graph.offset[std::size_t(v) + 1]; ++e) {
            const int w = graph.target[std::size_t(e)];
            if (peak[std::size_t(w)] < 0) continue;
            int higher = top(v), lower = top(w);
            if (higher == lower) continue;
            if (is_higher(lower, higher)) std::swap(higher, lower);
            if (height[lower] > height[v]) found.emplace_back(height[lower] - height[v], lower);
            peak[std::size_t(lower)] = higher;
        }
    }
    found.emplace_back(std::numeric_limits<double>::infinity(), order.front());
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    return found;
}

/// Logarithms of the distances between tips.
Eigen::MatrixXd log_distances(const Tips& tips) {
    return tips.distance(tips.vertices, Eigen::all).array().log();
}

/// Goes through the partial matchings, tip by tip of A, and keeps the best.
class TipSearch {
  public:
    TipSearch(const Tips& A, const Tips& B, int count)
        : A_(log_distances(A)), B_(log_distances(B)), count_(std::size_t(count)), taken_(B.vertices.size()) {}

    std::vector<TipMatching> run() {
        if (count_ > 0) go_on(0, 0);
        std::vector<TipMatching> matchings;
        for (auto& [cost, matching] : best_) matchings.push_back(std::move(matching));
        return matchings;
    }

  private:
    void go_on(int tip, double cost) {
        constexpr double alone = 0.25;  // the price of a tip without a partner
        constexpr std::size_t least = 3;
        if (best_.size() == count_ && cost >= best_.back().first) return;
        if (tip == A_.rows()) {
            if (current_.size() >= least)
                keep(cost + alone * double(std::size_t(B_.rows()) - current_.size()));
            return;
        }
        for (int other = 0; other < B_.rows(); ++other) {
            if (taken_[std::size_t(other)]) continue;
            const double more = misfit(tip, other);
            taken_[std::size_t(other)] = true;
            current_.emplace_back(tip, other);
            go_on(tip + 1, cost + more);
            current_.pop_back();
            taken_[std::size_t(other)] = false;
        }
        go_on(tip + 1, cost + alone);
    }
    /// Mean squared logarithm of the ratio of distances from the tips that are matched.
    double misfit(int tip, int other) const {
        double sum = 0;
        for (const auto& [a, b] : current_) sum += std::pow(A_(tip, a) - B_(other, b), 2);
        return current_.empty() ? 0 : sum / double(current_.size());
    }
    void keep(double cost) {
        const auto at = std::upper_bound(best_.begin(), best_.end(), cost,
                                         [](double c, const auto& other) { return c < other.first; });
        best_.insert(at, {cost, current_});
        if (best_.size() > count_) best_.pop_back();
    }

    Eigen::MatrixXd A_, B_;
    std::size_t count_;
    std::vector<bool> taken_;  ///< tips of B
    TipMatching current_;
    std::vector<std::pair<double, TipMatching>> best_;
};

/// Per sample its distances from tips, in units of each tip's mean distance.
RowMatrix places(const Tips& tips, const std::vector<int>& which, const std::vector<int>& samples) {
    RowMatrix place(samples.size(), which.size());
    for (std::size_t k = 0; k < which.size(); ++k) {
        const auto distance = tips.distance.col(which[k]);
        for (std::size_t i = 0; i < samples.size(); ++i)
            place(Eigen::Index(i), Eigen::Index(k)) = distance[samples[i]] / distance.mean();
    }
    return place;
}

}  // namespace

Tips find_tips(const GeodesicGraph& graph, const std::vector<int>& sources, int most) {
    constexpr double least_prominence = 0.01;  // units of sqrt(area)
    const Eigen::VectorXd mean = finite_distances(graph, sources).colwise().mean();
    Tips tips;
    for (const auto& [prominence, vertex] : prominent_maxima(mean, graph))
        if (prominence >= least_prominence && int(tips.vertices.size()) < most)
            tips.vertices.push_back(vertex);
    tips.distance = finite_distances(graph, tips.vertices).transpose();
    return tips;
}

std::vector<TipMatching> match_tips(const Tips& A, const Tips& B, int count) {
    return TipSearch(A, B, count).run();
}

Matching matching_by_tips(const Tips& A, const Tips& B, const TipMatching& tips, const LevelPair& pair) {
    std::vector<int> of_A, of_B;
    for (const auto& [a, b] : tips) of_A.push_back(a), of_B.push_back(b);
    return nearest_to_each_other(places(A, of_A, pair.A.level.samples),
                                 places(B, of_B, pair.B.level.samples));
}

}  // namespace varimap
