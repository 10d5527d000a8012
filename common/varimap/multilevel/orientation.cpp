#include "varimap/multilevel/orientation.h"

#include <Eigen/LU>

#include "varimap/core/parallel.h"

namespace varimap {

namespace {

/// Two orthonormal tangent vectors, positively oriented about the normal.
Eigen::Matrix<double, 3, 2> tangent_basis(const Vec3& normal) {
    const Vec3 axis = std::abs(normal.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
    Eigen::Matrix<double, 3, 2> basis;
    basis.col(0) = normal.cross(axis).normalized();
    basis.col(1) = normal.cross(basis.col(0));
    return basis;
}

/// Least-squares fit of a linear map between two tangent planes.
class OffsetFit {
  public:
    OffsetFit(const OrientedSurface& A, int a, const OrientedSurface& B, int b)
        : A_(A),
          B_(B),
          a_(a),
          b_(b),
          plane_A_(tangent_basis(A.normals.row(a).transpose())),
          plane_B_(tangent_basis(B.normals.row(b).transpose())) {}

    void add(int a, int b, double weight) {
        if (A_.normals.row(a).dot(A_.normals.row(a_)) <= 0 || B_.normals.row(b).dot(B_.normals.row(b_)) <= 0)
            return;
        const Eigen::RowVector2d p = (A_.positions.row(a) - A_.positions.row(a_)) * plane_A_;
        const Eigen::RowVector2d q = (B_.positions.row(b) - B_.positions.row(b_)) * plane_B_;
        moments_A_ += weight * p.transpose() * p;
        moments_B_ += weight * q.transpose() * q;
        products_ += weight * q.transpose() * p;
    }

    double normalised_determinant() const {
        // Offsets along one line, or none: no orientation, which rounding must not invent.
        if (is_degenerate(moments_A_) || is_degenerate(moments_B_)) return 0;
        return products_.determinant() / std::sqrt(moments_A_.determinant() * moments_B_.determinant());
    }

  private:
    static bool is_degenerate(const Eigen::Matrix2d& m) {
        return !(m.determinant() > 1e-9 * m.trace() * m.trace());  // of order 1 unless along a line
    }

    const OrientedSurface &A_, &B_;
    int a_, b_;
    Eigen::Matrix<double, 3, 2> plane_A_, plane_B_;
    Eigen::Matrix2d moments_A_ = Eigen::Matrix2d::Zero(), moments_B_ = Eigen::Matrix2d::Zero(),
                    products_ = Eigen::Matrix2d::Zero();
};

/// |a - b|^2; or, where its first terms show that it is above `limit`, some number above that.
template <class A, class B>
double squared_distance(const A& a, const B& b, double limit) {
    constexpr Eigen::Index first = 16;  // the smoothest functions tell most points apart
    constexpr double beyond_rounding = 1 + 1e-12;
    if (a.size() > 2 * first) {
        const double part = (a.template head<first>() - b.template head<first>()).squaredNorm();
        if (part > limit * beyond_rounding) return part;
    }
    return (a - b).squaredNorm();
}

}  // namespace

int nearest_by_descent(int vertex, const Eigen::RowVectorXd& centre, const RowMatrix& vertex_points,
                       const GeodesicGraph& graph) {
    double smallest = (vertex_points.row(vertex) - centre).squaredNorm();
    for (int current = vertex;; vertex = current) {
        for (int e = graph.offset[vertex]; e < graph.offset[vertex + 1]; ++e) {
            const double d = squared_distance(vertex_points.row(graph.target[e]), centre, smallest);
            if (d < smallest) smallest = d, current = graph.target[e];
        }
        if (current == vertex) return vertex;
    }
}

namespace {

/// Per sample: the vertex of the other mesh nearest to its centre.
std::vector<int> image_vertices(const OrientedSide& to, const RowMatrix& centres,
                                const std::vector<int>& partner) {
    const LevelSide& target = to.level_side;
    std::vector<int> image(partner.size());
    parallel_for_each_index(partner.size(), size_t(32), [&](size_t k) {
        image[k] = nearest_by_descent(target.level.samples[size_t(partner[k])], centres.row(Eigen::Index(k)),
                                      target.vertex_points, to.graph);
    });
    return image;
}

double determinant_at(int k, const OrientedSide& from, const OrientedSide& to,
                      const std::vector<int>& image_vertex) {
    const std::vector<int>& samples = from.level_side.level.samples;
    const Side& side = from.level_side.side;
    OffsetFit fit(from.surface, samples[k], to.surface, image_vertex[k]);
    for (SparseMatrix::InnerIterator it(side.weights, k); it; ++it)
        fit.add(samples[it.col()], image_vertex[it.col()], it.value() * side.mass[it.col()]);
    return fit.normalised_determinant();
}

}  // namespace

Orientation measure_orientation(const OrientedSide& from, const OrientedSide& to, const RowMatrix& centres,
                                const std::vector<int>& partner) {
    Orientation result;
    result.image_vertex = image_vertices(to, centres, partner);
    result.determinant.resize(partner.size());
    parallel_for_each_index(partner.size(), size_t(32), [&](size_t k) {
        result.determinant[k] = determinant_at(int(k), from, to, result.image_vertex);
    });
    for (size_t k = 0; k < partner.size(); ++k)
        if (result.determinant[k] < 0) result.reversed_mass += from.level_side.side.mass[Eigen::Index(k)];
    return result;
}

}  // namespace varimap
