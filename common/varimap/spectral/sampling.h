#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace varimap {

/// Farthest point insertion (Sec. 4.2) with the cells of the samples, near-linear in the number of vertices:
/// a new sample's cell is grown over the mesh from the sample itself and reaches only vertices that become
/// closer, and the farthest vertex comes from a lazily updated heap (distances only shrink).
///
/// Cells are connected by construction. Ties are broken by the lowest vertex number among distances that
/// agree to about six digits, so that rounding does not decide.
///
/// `grow(sample, claim)` must visit vertices outward from `sample` and go on past a vertex v exactly where
/// claim(v, distance) returned true. Its type is a parameter because it is called for every edge of every
/// cell: through std::function it cost 30% of varimap-hierarchy.
template <class Grow>
class FarthestPointSampling {
  public:
    FarthestPointSampling(int vertex_count, Grow grow)
        : grow_(std::move(grow)),
          cell_(vertex_count, -1),
          distance_(vertex_count, std::numeric_limits<double>::infinity()),
          is_sample_(vertex_count, 0) {
        queue_all();
    }
    /// Goes on from samples, the cells and the distances that belong to them.
    FarthestPointSampling(std::vector<int> samples, std::vector<int> cell, std::vector<double> distance,
                          Grow grow)
        : grow_(std::move(grow)),
          samples_(std::move(samples)),
          cell_(std::move(cell)),
          distance_(std::move(distance)),
          is_sample_(cell_.size(), 0) {
        for (const int s : samples_) is_sample_[s] = 1;
        queue_all();
    }

    /// Adds a vertex as a sample; no effect if it is one already.
    void insert(int vertex) {
        if (is_sample_[vertex]) return;
        is_sample_[vertex] = 1;
        const int index = int(samples_.size());
        samples_.push_back(vertex);
        grow_(vertex, [&](int v, double d) {
            // A sample is always its own nearest sample, also among coincident vertices.
            if (is_sample_[v] ? v != vertex : !(d < distance_[v] * (1 - 1e-9))) return false;
            if (v == vertex && cell_[v] == index) return false;
            distance_[v] = d;
            cell_[v] = index;
            return true;
        });
    }
    /// Adds farthest vertices until every vertex is within `radius` of its sample, or `limit` samples are
    /// reached.
    void cover(double radius, int limit) {
        while (int(samples_.size()) < limit && !heap_.empty()) {
            const Candidate top = heap_.top();
            heap_.pop();
            const Candidate current = candidate(top.vertex);
            if (current < top) {
                heap_.push(current);  // the distance shrank since it was queued
            } else if (distance_[top.vertex] <= radius) {
                heap_.push(current);
                return;
            } else {
                insert(top.vertex);
            }
        }
    }

    const std::vector<int>& samples() const { return samples_; }
    /// Per vertex: index of its sample.
    const std::vector<int>& cell() const { return cell_; }

  private:
    struct Candidate {
        float distance;
        int vertex;
        bool operator<(const Candidate& o) const {
            return distance != o.distance ? distance < o.distance : vertex > o.vertex;
        }
    };
    void queue_all() {
        std::vector<Candidate> all;
        all.reserve(distance_.size());
        for (int v = 0; v < int(distance_.size()); ++v) all.push_back(candidate(v));
        heap_ = std::priority_queue<Candidate>(std::less<Candidate>(), std::move(all));
    }
    Candidate candidate(int vertex) const {
        const double d = distance_[vertex];
        if (!std::isfinite(d)) return {std::numeric_limits<float>::infinity(), vertex};
        // Keep 20 bits of the distance: vertices that only rounding tells apart then tie.
        int exponent;
        const double mantissa = std::frexp(d, &exponent);
        return {float(std::ldexp(std::round(std::ldexp(mantissa, 20)), exponent - 20)), vertex};
    }

    Grow grow_;
    std::vector<int> samples_, cell_;
    std::vector<double> distance_;
    std::vector<char> is_sample_;
    std::priority_queue<Candidate> heap_;
};

}  // namespace varimap
