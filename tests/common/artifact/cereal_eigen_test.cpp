#include "varimap/artifact/cereal_eigen.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace varimap {

struct EverySort {
    Eigen::MatrixXd columns;
    Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor> rows;
    Eigen::VectorXf single;
    Eigen::Vector3d fixed = Eigen::Vector3d::Zero();
    Eigen::SparseMatrix<double, Eigen::RowMajor> sparse;
    std::vector<std::pair<int, int>> pairs;
    std::string text;
};

template <class Archive>
void serialize(Archive& archive, EverySort& all) {
    archive(all.columns, all.rows, all.single, all.fixed, all.sparse, all.pairs, all.text);
}

namespace {

EverySort filled() {
    EverySort all;
    all.columns = Eigen::MatrixXd::Random(4, 2);
    all.rows = Eigen::MatrixXi::Random(5, 3);
    all.single = Eigen::VectorXf::Random(3);
    all.fixed = {1, 2, 3};
    all.sparse.resize(4, 5);
    all.sparse.insert(3, 1) = 7;  // not compressed, and rows without entries
    all.sparse.insert(1, 4) = -2;
    all.sparse.insert(1, 0) = 5;
    all.pairs = {{1, 2}, {3, 4}};
    all.text = "text";
    return all;
}

TEST(CerealEigen, RoundTrip) {
    const EverySort all = filled();
    EverySort read;
    cereal_decode(cereal_encode(all), read);
    EXPECT_EQ(read.columns, all.columns);
    EXPECT_EQ(read.rows, all.rows);
    EXPECT_EQ(read.single, all.single);
    EXPECT_EQ(read.fixed, all.fixed);
    EXPECT_EQ(Eigen::MatrixXd(read.sparse), Eigen::MatrixXd(all.sparse));
    EXPECT_EQ(read.sparse.nonZeros(), 3);
    EXPECT_EQ(read.pairs, all.pairs);
    EXPECT_EQ(read.text, all.text);
}

TEST(CerealEigen, EqualValuesGiveEqualBytesCompressedOrNot) {
    EverySort all = filled();
    const std::string bytes = cereal_encode(all);
    all.sparse.makeCompressed();
    EXPECT_EQ(cereal_encode(all), bytes);
    EverySort read;
    cereal_decode(bytes, read);
    EXPECT_EQ(cereal_encode(read), bytes);
}

TEST(CerealEigen, EmptyMatrices) {
    EverySort read = filled();
    cereal_decode(cereal_encode(EverySort{}), read);
    EXPECT_EQ(read.columns.size(), 0);
    EXPECT_EQ(read.sparse.rows(), 0);
}

TEST(CerealEigen, RefusesMissingAndLeftOverBytes) {
    const std::string bytes = cereal_encode(filled());
    EverySort read;
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW(cereal_decode(bytes.substr(0, size), read), ArtifactError) << size;
    EXPECT_THROW(cereal_decode(bytes + '\0', read), ArtifactError);
}

TEST(CerealEigen, RefusesContradictorySizes) {
    Eigen::Vector3d fixed;
    EXPECT_THROW(cereal_decode(cereal_encode(Eigen::VectorXd(Eigen::VectorXd::Zero(4))), fixed),
                 ArtifactError);
    const std::pair<std::int64_t, std::int64_t> huge(std::int64_t(1) << 40, std::int64_t(1) << 40),
        negative(-1, 3);
    Eigen::MatrixXd matrix;
    EXPECT_THROW(cereal_decode(cereal_encode(huge), matrix), ArtifactError);
    EXPECT_THROW(cereal_decode(cereal_encode(negative), matrix), ArtifactError);
}

TEST(CerealEigen, RefusesSizesBeyondThePayloadBeforeAllocatingThem) {
    const std::uint64_t huge = std::uint64_t(1) << 36;  // within what a vector may hold, and 512 GB
    std::vector<double> numbers;
    std::vector<std::string> texts;
    std::string text;
    EXPECT_THROW(cereal_decode(cereal_encode(huge), numbers), ArtifactError);
    EXPECT_THROW(cereal_decode(cereal_encode(huge), texts), ArtifactError);
    EXPECT_THROW(cereal_decode(cereal_encode(huge), text), ArtifactError);
    Eigen::MatrixXd matrix;
    EXPECT_THROW(cereal_decode(cereal_encode(std::pair<std::int64_t, std::int64_t>(huge, 1)), matrix),
                 ArtifactError);
    Eigen::SparseMatrix<double, Eigen::RowMajor> sparse;
    const std::array<std::int64_t, 3> rows{1 << 30, 1, 0}, entries{1, 1, 1 << 30};
    for (const auto& sizes : {rows, entries})
        EXPECT_THROW(cereal_decode(cereal_encode(sizes), sparse), ArtifactError);
}

TEST(CerealEigen, RefusesSparseIndicesOutOfRange) {
    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(2, 3), read;
    matrix.insert(0, 1) = 1;
    matrix.insert(1, 2) = 1;
    matrix.makeCompressed();
    for (const int wrong : {-1, 3}) {
        auto bad = matrix;
        bad.innerIndexPtr()[1] = wrong;
        EXPECT_THROW(cereal_decode(cereal_encode(bad), read), ArtifactError);
    }
    auto bad = matrix;
    bad.outerIndexPtr()[1] = 5;
    EXPECT_THROW(cereal_decode(cereal_encode(bad), read), ArtifactError);
}

}  // namespace
}  // namespace varimap
