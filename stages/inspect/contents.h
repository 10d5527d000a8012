#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "varimap/core/linear_algebra.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// A dense array of an artifact, where it lies in memory.
struct ArrayView {
    std::variant<const double*, const int*> data;
    std::vector<Eigen::Index> shape;  ///< one or two extents
    bool column_major = false;

    Eigen::Index size() const;
};

template <class Scalar, int R, int C, int O, int MR, int MC>
ArrayView view(const Eigen::Matrix<Scalar, R, C, O, MR, MC>& matrix) {
    if (C == 1) return {matrix.data(), {matrix.rows()}, false};
    return {matrix.data(), {matrix.rows(), matrix.cols()}, !(O & Eigen::RowMajor)};
}
template <class Scalar>
ArrayView view(const std::vector<Scalar>& values) {
    return {values.data(), {Eigen::Index(values.size())}, false};
}

/// Receives what an artifact holds, piece by piece; names are unique within an artifact and fit file names.
class ContentsVisitor {
  public:
    virtual ~ContentsVisitor() = default;
    virtual void fact(const std::string& name, const std::string& value) = 0;
    virtual void array(const std::string& name, const ArrayView& array) = 0;
    virtual void sparse(const std::string& name, const SparseMatrix& matrix) = 0;
    virtual void mesh(const std::string& name, const TriangleMesh& mesh) = 0;
    /// A text of its own, such as quality.json; `name` includes the ending.
    virtual void text(const std::string& name, const std::string& content) = 0;
};

/// Decodes an artifact of any kind and shows its contents.
/// Throws ArtifactError (damaged, unknown kind, other schema), IoError.
void visit_artifact(const std::string& path, ContentsVisitor& visitor);

}  // namespace varimap
