#include "varimap/relaxation/triangle_system.h"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "varimap/core/index_set.h"

namespace varimap {

TriangleSystem::TriangleSystem(int node_count, const std::vector<std::array<int, 3>>& triangles)
    : triangles_(triangles), position_(node_count) {
    build_pattern();
    order();
    for (auto& triangle : triangles_)
        for (int& corner : triangle) corner = corner < 0 ? -1 : position_[corner];
    build_pattern();
    find_slots();
    count_factor();
}

/// Pairs of nodes that share a triangle, and every node with itself, by the higher one.
void TriangleSystem::build_pattern() {
    const int n = int(position_.size());
    const auto each_pair = [&](const auto& body) {
        for (int k = 0; k < n; ++k) body(k, k);
        for (const auto& t : triangles_)
            for (int k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
                if (low >= 0) body(low, high);
            }
    };
    std::vector<int> end(n + 1, 0);
    each_pair([&](int, int high) { ++end[high + 1]; });
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<int> lows(end.back());
    each_pair([&](int low, int high) { lows[end[high]++] = low; });
    begin_.assign(1, 0);
    row_.clear();
    for (int k = 0, first = 0; k < n; first = end[k], ++k) {
        std::sort(lows.begin() + first, lows.begin() + end[k]);
        std::unique_copy(lows.begin() + first, lows.begin() + end[k], std::back_inserter(row_));
        begin_.push_back(int(row_.size()));
    }
}

void TriangleSystem::order() {
    const int n = int(position_.size());
    const std::vector<double> ones(row_.size(), 1);
    const Eigen::Map<const Eigen::SparseMatrix<double>> graph(n, n, int(row_.size()), begin_.data(),
                                                              row_.data(), ones.data());
    Eigen::AMDOrdering<int>::PermutationType node_at;
    Eigen::AMDOrdering<int>()(Eigen::SparseMatrix<double>(graph).selfadjointView<Eigen::Upper>(), node_at);
    for (int k = 0; k < n; ++k) position_[node_at.indices()[k]] = k;
}

void TriangleSystem::find_slots() {
    for (const auto& t : triangles_) {
        auto& slots = slot_.emplace_back(std::array{-1, -1, -1});
        for (int k = 0; k < 3; ++k) {
            const auto [row, column] = std::minmax(t[(k + 1) % 3], t[(k + 2) % 3]);
            if (row < 0) continue;
            const auto first = row_.begin() + begin_[column], last = row_.begin() + begin_[column + 1];
            slots[k] = int(std::lower_bound(first, last, row) - row_.begin());
        }
    }
    upper_.resize(row_.size());
}

/// The elimination tree and the number of entries per column of L.
void TriangleSystem::count_factor() {
    const int n = int(position_.size());
    parent_.assign(n, -1);
    visited_.assign(n, -1);
    factor_begin_.assign(n + 1, 0);
    for (int k = 0; k < n; ++k) {
        visited_[k] = k;
        for (int entry = begin_[k]; entry < begin_[k + 1] - 1; ++entry)
            for (int i = row_[entry]; visited_[i] != k; i = parent_[i]) {
                if (parent_[i] < 0) parent_[i] = k;
                ++factor_begin_[i + 1];
                visited_[i] = k;
            }
    }
    entry_count(std::accumulate(factor_begin_.begin(), factor_begin_.end(), std::size_t(0)),
                "the factor of a relaxation step");
    std::partial_sum(factor_begin_.begin(), factor_begin_.end(), factor_begin_.begin());
    factor_row_.resize(factor_begin_.back());
    factor_.resize(factor_begin_.back());
    inverse_.resize(n);
    pattern_.resize(n);
    present_.assign(n, Block::Zero());
}

void TriangleSystem::clear() {
    std::fill(upper_.begin(), upper_.end(), Block::Zero());
}

void TriangleSystem::add(int triangle, const TriangleMatrix& matrix, double weight) {
    const auto& corners = triangles_[triangle];
    for (int k = 0; k < 3; ++k) {
        if (corners[k] >= 0) diagonal(corners[k]) += weight * matrix.block<2, 2>(2 * k, 2 * k);
        const int slot = slot_[triangle][k];
        if (slot < 0) continue;
        int a = (k + 1) % 3, b = (k + 2) % 3;
        if (corners[a] > corners[b]) std::swap(a, b);
        upper_[slot] += weight * matrix.block<2, 2>(2 * a, 2 * b);
    }
}

void TriangleSystem::scale_diagonal(double factor) {
    for (const int k : position_) diagonal(k).diagonal() *= factor;
}

/// Fills the end of the pattern with the columns in which row k of L has entries, every one before those it
/// contributes to; returns where they start.
int TriangleSystem::row_pattern(int k) {
    int top = int(pattern_.size());
    visited_[k] = k;
    for (int entry = begin_[k]; entry < begin_[k + 1] - 1; ++entry) {
        int length = 0;
        for (int i = row_[entry]; visited_[i] != k; i = parent_[i]) {
            pattern_[length++] = i;
            visited_[i] = k;
        }
        while (length > 0) pattern_[--top] = pattern_[--length];
    }
    return top;
}

bool TriangleSystem::factorize() {
    const int n = int(position_.size());
    factor_end_.assign(factor_begin_.begin(), factor_begin_.end() - 1);
    std::fill(visited_.begin(), visited_.end(), -1);
    for (int k = 0; k < n; ++k) {
        int next = row_pattern(k);
        for (int entry = begin_[k]; entry < begin_[k + 1] - 1; ++entry)
            present_[row_[entry]] = upper_[entry].transpose();
        Block pivot = diagonal(k);
        for (; next < n; ++next) {
            const int i = pattern_[next];
            const Block entry = present_[i];
            present_[i].setZero();
            int& end = factor_end_[i];
            for (int e = factor_begin_[i]; e < end; ++e)
                present_[factor_row_[e]].noalias() -= entry * factor_[e];
            factor_row_[end] = k;
            factor_[end].noalias() = inverse_[i] * entry.transpose();
            pivot.noalias() -= entry * factor_[end];
            ++end;
        }
        const double determinant = pivot.determinant();
        if (determinant == 0 || !std::isfinite(determinant)) return false;
        inverse_[k] = pivot.inverse();
    }
    return true;
}

Eigen::VectorXd TriangleSystem::solve(const Eigen::VectorXd& b) const {
    const int n = int(position_.size());
    std::vector<Eigen::Vector2d> y(n);
    for (int node = 0; node < n; ++node) y[position_[node]] = b.segment<2>(2 * node);
    for (int i = 0; i < n; ++i)
        for (int e = factor_begin_[i]; e < factor_begin_[i + 1]; ++e)
            y[factor_row_[e]].noalias() -= factor_[e].transpose() * y[i];
    for (int i = n - 1; i >= 0; --i) {
        y[i] = inverse_[i] * y[i];
        for (int e = factor_begin_[i]; e < factor_begin_[i + 1]; ++e)
            y[i].noalias() -= factor_[e] * y[factor_row_[e]];
    }
    Eigen::VectorXd x(b.size());
    for (int node = 0; node < n; ++node) x.segment<2>(2 * node) = y[position_[node]];
    return x;
}

}  // namespace varimap
