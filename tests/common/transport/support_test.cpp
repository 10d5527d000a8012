#include "varimap/transport/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fixtures/random_plan.h"

namespace varimap {
namespace {

using random_plan::dense;
using random_plan::Generator;
using Lists = std::vector<std::vector<int>>;

Coupling random_coupling(int rows, int columns, unsigned seed) {
    Generator random(seed);
    Coupling plan;
    plan.support = random.support(rows, columns, .2);
    plan.value = random.values(plan.support.entries());
    plan.row_background = .1 * random.values(rows);
    plan.column_background = .1 * random.values(columns);
    return plan;
}

TEST(Support, ListsTheSameEntriesByRowsAndByColumns) {
    const Lists lists{{1, 4}, {}, {0, 1, 2}, {4}};
    const Support s(lists, 6);
    EXPECT_EQ(s.rows(), 4);
    EXPECT_EQ(s.columns(), 6);
    EXPECT_EQ(s.entries(), 6);
    EXPECT_EQ(s.column, (std::vector{1, 4, 0, 1, 2, 4}));
    EXPECT_EQ(s.row_begin, (std::vector{0, 2, 2, 5, 6}));
    for (int j = 0; j < s.columns(); ++j)
        for (int e = s.column_begin[j]; e < s.column_begin[j + 1]; ++e) {
            EXPECT_EQ(s.column[s.by_row[e]], j);
            EXPECT_GE(s.by_row[e], s.row_begin[s.row[e]]);
            EXPECT_LT(s.by_row[e], s.row_begin[s.row[e] + 1]);
        }
    EXPECT_EQ(s.column_begin.back(), 6);
    EXPECT_EQ(std::set<int>(s.by_row.begin(), s.by_row.end()).size(), 6u);
}

TEST(Support, DenseHoldsEveryEntry) {
    const Support s = Support::dense(3, 4);
    EXPECT_EQ(s.entries(), 12);
    for (int e = 0; e < 12; ++e) EXPECT_EQ(s.column[e], e % 4);
}

TEST(Coupling, SumsAndMeansIncludeTheBackground) {
    const Coupling plan = random_coupling(15, 9, 1);
    const RowMatrix full = dense(plan);
    EXPECT_LT((row_sums(plan) - full.rowwise().sum()).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((column_sums(plan) - full.colwise().sum().transpose()).cwiseAbs().maxCoeff(), 1e-14);
    Generator random(2);
    const RowMatrix x = random.points(15, 3), y = random.points(9, 5);
    const RowMatrix rows = full.rowwise().sum().cwiseInverse().asDiagonal() * (full * y);
    const RowMatrix columns =
        full.colwise().sum().cwiseInverse().transpose().asDiagonal() * (full.transpose() * x);
    EXPECT_LT((row_barycentres(plan, y) - rows).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((column_barycentres(plan, x) - columns).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(SignificantEntries, AreLargeOrTheBestOfTheirLine) {
    const Coupling plan = random_coupling(30, 40, 3);
    const RowMatrix value = dense(plan.support, plan.value, -1);
    const Eigen::VectorXd m = value.cwiseMax(0).rowwise().sum(), n = value.cwiseMax(0).colwise().sum();
    constexpr double threshold = .15;
    const Lists kept = significant_entries(plan, m, n, threshold);
    int dropped = 0;
    for (int i = 0; i < 30; ++i)
        for (int j = 0; j < 40; ++j) {
            const double v = value(i, j);
            const bool expected = v >= 0 && (v >= threshold * m[i] || v >= threshold * n[j] ||
                                             v == value.row(i).maxCoeff() || v == value.col(j).maxCoeff());
            EXPECT_EQ(std::binary_search(kept[i].begin(), kept[i].end(), j), expected) << i << " " << j;
            dropped += v >= 0 && !expected;
        }
    EXPECT_GT(dropped, 30);
}

TEST(Enlarged, HoldsAllPairsOfNeighboursOfKeptEntries) {
    Generator random(4);
    const auto mutual = [](const SparseMatrix& W) { return SparseMatrix(W + SparseMatrix(W.transpose())); };
    const SparseMatrix X = mutual(random.weights(25, .04)), Y = mutual(random.weights(20, .04));
    const Lists kept = [&] {
        const Support s = random.support(25, 20, .02);
        Lists lists(25);
        for (int i = 0; i < 25; ++i)
            lists[i].assign(&s.column[s.row_begin[i]], &s.column[0] + s.row_begin[i + 1]);
        return lists;
    }();
    const Support s = enlarged(kept, X, Y);
    const RowMatrix found = dense(s, Eigen::VectorXd::Ones(s.entries()), 0);
    EXPECT_LT(s.entries(), 400);
    for (int k = 0; k < 25; ++k)
        for (int l = 0; l < 20; ++l) {
            double meets = 0;
            for (int i = 0; i < 25; ++i)
                for (int j : kept[i]) meets += X.coeff(i, k) * Y.coeff(j, l);
            EXPECT_EQ(found(k, l), meets > 0 ? 1 : 0) << k << " " << l;
        }
}

TEST(Inherited, GoesToAllChildrenOfKeptPairs) {
    const Lists kept{{0, 2}, {1}};
    const std::vector<int> row_parent{0, 1, 1, 0}, column_parent{2, 0, 1, 1, 2};
    EXPECT_EQ(inherited(kept, row_parent, column_parent), (Lists{{0, 1, 4}, {2, 3}, {2, 3}, {0, 1, 4}}));
}

}  // namespace
}  // namespace varimap
