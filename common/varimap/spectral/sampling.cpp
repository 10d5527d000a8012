#include "varimap/spectral/sampling.h"

#include <cmath>
#include <limits>

namespace varimap {

FarthestPointSampling::FarthestPointSampling(int vertex_count, Grow grow)
    : grow_(std::move(grow)),
      cell_(vertex_count, -1),
      distance_(vertex_count, std::numeric_limits<double>::infinity()),
      is_sample_(vertex_count, 0) {
    for (int v = 0; v < vertex_count; ++v) heap_.push(candidate(v));
}

FarthestPointSampling::Candidate FarthestPointSampling::candidate(int vertex) const {
    const double d = distance_[vertex];
    if (!std::isfinite(d)) return {std::numeric_limits<float>::infinity(), vertex};
    // Keep 20 bits of the distance: vertices that only rounding tells apart then tie.
    int exponent;
    const double mantissa = std::frexp(d, &exponent);
    return {float(std::ldexp(std::round(std::ldexp(mantissa, 20)), exponent - 20)), vertex};
}

void FarthestPointSampling::insert(int vertex) {
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

void FarthestPointSampling::cover(double radius, int limit) {
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

}  // namespace varimap
