#pragma once

#include <functional>
#include <queue>
#include <vector>

namespace varimap {

/// Farthest point insertion (Sec. 4.2) with the cells of the samples, near-linear in the number of vertices:
/// a new sample's cell is grown over the mesh from the sample itself and reaches only vertices that become
/// closer, and the farthest vertex comes from a lazily updated heap (distances only shrink).
///
/// Cells are connected by construction. Ties are broken by the lowest vertex number among distances that
/// agree to about six digits, so that rounding does not decide.
class FarthestPointSampling {
  public:
    /// `grow(sample, claim)` must visit vertices outward from `sample` and go on past a vertex v exactly
    /// where claim(v, distance) returned true.
    using Claim = std::function<bool(int vertex, double distance)>;
    using Grow = std::function<void(int sample_vertex, const Claim& claim)>;

    FarthestPointSampling(int vertex_count, Grow grow);

    /// Adds a vertex as a sample; no effect if it is one already.
    void insert(int vertex);
    /// Adds farthest vertices until every vertex is within `radius` of its sample, or `limit` samples are
    /// reached.
    void cover(double radius, int limit);

    const std::vector<int>& samples() const { return samples_; }
    /// Per vertex: index of its sample, and the distance to it.
    const std::vector<int>& cell() const { return cell_; }
    const std::vector<double>& distance() const { return distance_; }

  private:
    struct Candidate {
        float distance;
        int vertex;
        bool operator<(const Candidate& o) const {
            return distance != o.distance ? distance < o.distance : vertex > o.vertex;
        }
    };
    Candidate candidate(int vertex) const;

    Grow grow_;
    std::vector<int> samples_, cell_;
    std::vector<double> distance_;
    std::vector<char> is_sample_;
    std::priority_queue<Candidate> heap_;
};

}  // namespace varimap
