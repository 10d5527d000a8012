#include "varimap/transport/support.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>

#include "varimap/core/index_set.h"
#include "varimap/core/parallel.h"

namespace varimap {

namespace {

/// Collects distinct numbers below a bound, quickly and repeatedly: a bit each, in words of which only those
/// between the lowest and the highest number are looked at.
class DistinctSet {
  public:
    explicit DistinctSet(int bound) : words_(std::size_t(bound) / 64 + 1, 0) {}
    void add(int i) {
        const int word = i / 64;
        words_[std::size_t(word)] |= std::uint64_t(1) << (i % 64);
        lowest_ = std::min(lowest_, word);
        highest_ = std::max(highest_, word);
    }
    /// The numbers, ascending; leaves none.
    std::vector<int> take() {
        int count = 0;
        for (int w = lowest_; w <= highest_; ++w) count += std::popcount(words_[std::size_t(w)]);
        std::vector<int> members;
        members.reserve(std::size_t(count));
        for (int w = lowest_; w <= highest_; ++w) {
            for (std::uint64_t bits = std::exchange(words_[std::size_t(w)], 0); bits != 0; bits &= bits - 1)
                members.push_back(64 * w + std::countr_zero(bits));
        }
        lowest_ = int(words_.size()), highest_ = -1;
        return members;
    }

  private:
    std::vector<std::uint64_t> words_;
    int lowest_ = int(words_.size()), highest_ = -1;
};

/// For each row k of `outer`: the union of the lists inner[i] over the columns i of that row.
std::vector<std::vector<int>> union_over_neighbours(const SparseMatrix& outer,
                                                    const std::vector<std::vector<int>>& inner, int bound) {
    std::vector<std::vector<int>> result(outer.rows());
    parallel_for_each_range(result.size(), 256, [&](std::size_t begin, std::size_t end) {
        DistinctSet set(bound);
        for (std::size_t k = begin; k < end; ++k) {
            for (SparseMatrix::InnerIterator it(outer, Eigen::Index(k)); it; ++it)
                for (int j : inner[it.col()]) set.add(j);
            result[k] = set.take();
        }
    });
    return result;
}

std::vector<std::vector<int>> union_over_entries(const std::vector<std::vector<int>>& kept,
                                                 const SparseMatrix& inner) {
    std::vector<std::vector<int>> result(kept.size());
    parallel_for_each_range(kept.size(), 256, [&](std::size_t begin, std::size_t end) {
        DistinctSet set(int(inner.cols()));
        for (std::size_t i = begin; i < end; ++i) {
            for (int j : kept[i])
                for (SparseMatrix::InnerIterator it(inner, j); it; ++it) set.add(int(it.col()));
            result[i] = set.take();
        }
    });
    return result;
}

/// The positive entries of a plan by columns, gathered by reading the plan forwards.
struct PositiveColumns {
    std::vector<int> begin, row;
    std::vector<double> value;

    explicit PositiveColumns(const Coupling& plan) : begin(std::size_t(plan.support.columns()) + 1, 0) {
        const Support& s = plan.support;
        for (int e = 0; e < s.entries(); ++e) begin[std::size_t(s.column[e]) + 1] += plan.value[e] > 0;
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        row.resize(std::size_t(begin.back()));
        value.resize(row.size());
        std::vector<int> next = begin;
        for (int i = 0; i < s.rows(); ++i)
            for (int e = s.row_begin[i]; e < s.row_begin[i + 1]; ++e) {
                if (!(plan.value[e] > 0)) continue;
                const auto place = std::size_t(next[std::size_t(s.column[e])]++);
                row[place] = i;
                value[place] = plan.value[e];
            }
    }
};

RowMatrix normalised(RowMatrix sums, const Eigen::VectorXd& totals) {
    return totals.cwiseInverse().asDiagonal() * sums;
}

}  // namespace

Support::Support(std::vector<std::vector<int>> columns, int column_count)
    : row_begin(columns.size() + 1, 0), column_begin(column_count + 1, 0) {
    for (size_t i = 0; i < columns.size(); ++i)
        row_begin[i + 1] = entry_count(std::size_t(row_begin[i]) + columns[i].size(), "the plan");
    column.reserve(row_begin.back());
    for (auto& list : columns) {
        column.insert(column.end(), list.begin(), list.end());
        std::vector<int>().swap(list);
    }
    for (int j : column) ++column_begin[j + 1];
    std::partial_sum(column_begin.begin(), column_begin.end(), column_begin.begin());
    std::vector<int> next(column_begin.begin(), column_begin.end() - 1);
    row.resize(column.size());
    by_row.resize(column.size());
    for (int i = 0; i < rows(); ++i)
        for (int e = row_begin[i]; e < row_begin[i + 1]; ++e) {
            const int place = next[column[e]]++;
            row[place] = i;
            by_row[place] = e;
        }
}

Support Support::dense(int rows, int columns) {
    return Support(std::vector<std::vector<int>>(rows, all_indices(columns)), columns);
}

Eigen::VectorXd row_sums(const Coupling& plan) {
    Eigen::VectorXd sums = plan.row_background * plan.column_background.sum();
    for (int i = 0; i < plan.support.rows(); ++i)
        for (int e = plan.support.row_begin[i]; e < plan.support.row_begin[i + 1]; ++e)
            sums[i] += plan.value[e];
    return sums;
}

Eigen::VectorXd column_sums(const Coupling& plan) {
    Eigen::VectorXd sums = plan.column_background * plan.row_background.sum();
    for (int e = 0; e < plan.support.entries(); ++e) sums[plan.support.column[e]] += plan.value[e];
    return sums;
}

namespace {

/// Per line, a row or a column: `across` of its largest entry. `begin`: where a line's begin; `entry_at`:
/// their places in row order.
template <class EntryAt>
std::vector<int> largest_of_lines(const Coupling& plan, const std::vector<int>& begin,
                                  const std::vector<int>& across, const EntryAt& entry_at) {
    std::vector<int> best(begin.size() - 1, 0);
    for (std::size_t line = 0; line < best.size(); ++line) {
        double largest = -1;
        for (int e = begin[line]; e < begin[line + 1]; ++e)
            if (const double value = plan.value[entry_at(e)]; value > largest)
                largest = value, best[line] = across[std::size_t(e)];
    }
    return best;
}

}  // namespace

std::vector<int> largest_of_rows(const Coupling& plan) {
    const Support& s = plan.support;
    return largest_of_lines(plan, s.row_begin, s.column, [](int e) { return e; });
}

std::vector<int> largest_of_columns(const Coupling& plan) {
    const Support& s = plan.support;
    return largest_of_lines(plan, s.column_begin, s.row, [&](int e) { return s.by_row[std::size_t(e)]; });
}

RowMatrix row_barycentres(const Coupling& plan, const RowMatrix& points) {
    const Support& s = plan.support;
    RowMatrix sums = plan.row_background * (plan.column_background.transpose() * points);
    parallel_for_each_index(0 + s.rows(), 64, [&](int i) {
        for (int e = s.row_begin[i]; e < s.row_begin[i + 1]; ++e)
            if (plan.value[e] > 0) sums.row(i) += plan.value[e] * points.row(s.column[e]);
    });
    return normalised(std::move(sums), row_sums(plan));
}

RowMatrix column_barycentres(const Coupling& plan, const RowMatrix& points) {
    RowMatrix sums = plan.column_background * (plan.row_background.transpose() * points);
    const PositiveColumns columns(plan);
    parallel_for_each_index(0 + plan.support.columns(), 64, [&](int j) {
        for (int e = columns.begin[std::size_t(j)]; e < columns.begin[std::size_t(j) + 1]; ++e)
            sums.row(j) += columns.value[std::size_t(e)] * points.row(columns.row[std::size_t(e)]);
    });
    return normalised(std::move(sums), column_sums(plan));
}

std::vector<std::vector<int>> significant_entries(const Coupling& plan, const Eigen::VectorXd& row_mass,
                                                  const Eigen::VectorXd& column_mass, double threshold) {
    const Support& s = plan.support;
    std::vector<char> keep(s.entries(), 0);
    std::vector<int> best_of_column(s.columns(), -1);
    for (int i = 0; i < s.rows(); ++i) {
        int best = -1;
        for (int e = s.row_begin[i]; e < s.row_begin[i + 1]; ++e) {
            const int j = s.column[e];
            const double value = plan.value[e];
            keep[e] = value >= threshold * row_mass[i] || value >= threshold * column_mass[j];
            if (best < 0 || value > plan.value[best]) best = e;
            if (best_of_column[j] < 0 || value > plan.value[best_of_column[j]]) best_of_column[j] = e;
        }
        if (best >= 0) keep[best] = 1;
    }
    for (int e : best_of_column)
        if (e >= 0) keep[e] = 1;
    std::vector<std::vector<int>> kept(s.rows());
    for (int i = 0; i < s.rows(); ++i)
        for (int e = s.row_begin[i]; e < s.row_begin[i + 1]; ++e)
            if (keep[e]) kept[i].push_back(s.column[e]);
    return kept;
}

Support enlarged(const std::vector<std::vector<int>>& kept, const SparseMatrix& row_neighbours,
                 const SparseMatrix& column_neighbours) {
    const int columns = int(column_neighbours.rows());
    return Support(
        union_over_neighbours(row_neighbours, union_over_entries(kept, column_neighbours), columns), columns);
}

std::vector<std::vector<int>> inherited(const std::vector<std::vector<int>>& kept,
                                        const std::vector<int>& row_parent,
                                        const std::vector<int>& column_parent) {
    int coarse_columns = 0;
    for (int q : column_parent) coarse_columns = std::max(coarse_columns, q + 1);
    for (const auto& list : kept)
        for (int q : list) coarse_columns = std::max(coarse_columns, q + 1);
    std::vector<std::vector<int>> children(coarse_columns);
    for (size_t j = 0; j < column_parent.size(); ++j) children[column_parent[j]].push_back(int(j));

    std::vector<std::vector<int>> result(row_parent.size());
    parallel_for_each_index(size_t(0) + row_parent.size(), size_t(256), [&](size_t i) {
        for (int q : kept[row_parent[i]])
            result[i].insert(result[i].end(), children[q].begin(), children[q].end());
        std::sort(result[i].begin(), result[i].end());
    });
    return result;
}

}  // namespace varimap
