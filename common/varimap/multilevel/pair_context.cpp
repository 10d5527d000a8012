#include "varimap/multilevel/pair_context.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "varimap/multilevel/sample_graph.h"

namespace varimap {

namespace {

constexpr int full_levels = 2;  ///< Euclidean levels that have every vertex (see HierarchyOptions)

int sampled_euclidean_levels(const Hierarchy& h) {
    return int(h.levels.size()) - h.diffusion_levels() - full_levels;
}

const Level& last_diffusion_level(const Hierarchy& h) {
    return h.levels[h.diffusion_levels() - 1];
}

/// psi = Phi_t / sqrt(1 + K_t), rows in the unit ball.
RowMatrix normalised_embedding(const Basis& basis, double time) {
    RowMatrix psi = diffusion_embedding(basis, time);
    const Eigen::VectorXd kernel = psi.rowwise().squaredNorm();
    return (1 + kernel.array()).rsqrt().matrix().asDiagonal() * psi;
}

/// c with c^2 = sum over edges m_i |x_i - x_j|^2 / sum m_i |psi_i - psi_j|^2.
double edge_scale(const Surface& surface, const RowMatrix& psi) {
    double in_space = 0, in_psi = 0;
    for (int f = 0; f < surface.mesh.face_count(); ++f)
        for (int c = 0; c < 3; ++c) {
            const int i = surface.mesh.faces(f, c), j = surface.mesh.faces(f, (c + 1) % 3);
            in_space +=
                surface.mass[i] * (surface.mesh.vertices.row(i) - surface.mesh.vertices.row(j)).squaredNorm();
            in_psi += surface.mass[i] * (psi.row(i) - psi.row(j)).squaredNorm();
        }
    return std::sqrt(in_space / in_psi);
}

/// The points in their own `count` principal directions: distances among them shrink least.
RowMatrix principal_coordinates(const RowMatrix& points, const Eigen::VectorXd& mass, Eigen::Index count) {
    const RowMatrix centred = points.rowwise() - Eigen::RowVectorXd(mass.transpose() * points);
    const Eigen::MatrixXd covariance = centred.transpose() * mass.asDiagonal() * centred;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(covariance);
    return centred * directions.eigenvectors().rightCols(std::min(count, points.cols()));
}

RowMatrix mixed_points(const SurfaceData& data, double mu) {
    const RowMatrix x = data.surface.mesh.vertices;
    if (mu == 0) return x;
    const Level& last = last_diffusion_level(data.hierarchy);
    // Most of psi's extent lies in few directions; 32 of 100 measured as accurate as all, in two thirds of
    // the time.
    constexpr Eigen::Index principal_directions = 32;
    const RowMatrix psi = principal_coordinates(normalised_embedding(data.basis, last.scale),
                                                data.surface.mass, principal_directions);
    RowMatrix points(x.rows(), 3 + psi.cols());
    points << x, (mu * edge_scale(data.surface, psi)) * psi;
    return points;
}

LevelSide diffusion_side(const SurfaceData& data, const GeodesicGraph& graph, int index,
                         const std::vector<int>& landmarks) {
    const Level& source = data.hierarchy.levels[std::min(index, data.hierarchy.diffusion_levels() - 1)];
    return make_level_side(
        with_samples(source, landmarks, data.surface, data.basis, graph, data.hierarchy.options),
        diffusion_embedding(data.basis, source.scale), data.surface.mass);
}

}  // namespace

RowMatrix sample_positions(const Surface& surface, const Level& level) {
    return surface.mesh.vertices(level.samples, Eigen::all);
}

PairContext::PairContext(SurfaceData A, SurfaceData B, VertexPairs<MeshVertex> landmarks,
                         double landmark_weight)
    : A_(std::move(A)),
      B_(std::move(B)),
      graph_A_(A_.surface.mesh),
      graph_B_(B_.surface.mesh),
      sample_graph_A_(sample_graph(last_diffusion_level(A_.hierarchy), graph_A_)),
      sample_graph_B_(sample_graph(last_diffusion_level(B_.hierarchy), graph_B_)),
      landmarks_(std::move(landmarks)),
      landmark_weight_(landmark_weight) {
    for (const auto& [a, b] : landmarks_) {
        landmarks_A_.push_back(a.index);
        landmarks_B_.push_back(b.index);
    }
}

int PairContext::diffusion_levels() const {
    return std::max(A_.hierarchy.diffusion_levels(), B_.hierarchy.diffusion_levels());
}

LevelPair PairContext::diffusion_level(int index) const {
    LevelPair pair{diffusion_side(A_, graph_A_, index, landmarks_A_),
                   diffusion_side(B_, graph_B_, index, landmarks_B_)};
    set_landmarks(pair, landmarks_, landmark_weight_);
    return pair;
}

int PairContext::euclidean_levels() const {
    return std::max(sampled_euclidean_levels(A_.hierarchy), sampled_euclidean_levels(B_.hierarchy)) +
           full_levels;
}

const Level& PairContext::euclidean_source(const SurfaceData& data, int index) const {
    const Hierarchy& h = data.hierarchy;
    const int first_full = euclidean_levels() - full_levels;
    // A surface with fewer sampled levels goes on with its first full one, so that both end together.
    const int own = index >= first_full ? sampled_euclidean_levels(h) + index - first_full
                                        : std::min(index, sampled_euclidean_levels(h));
    return h.levels[h.diffusion_levels() + own];
}

LevelSide PairContext::euclidean_side(const SurfaceData& data, const GeodesicGraph& graph, int index,
                                      double mu, const std::vector<int>& landmarks) const {
    return make_level_side(with_samples(euclidean_source(data, index), landmarks, data.surface, data.basis,
                                        graph, data.hierarchy.options),
                           mixed_points(data, mu), data.surface.mass);
}

LevelPair PairContext::euclidean_level(int index, double mu) const {
    LevelPair pair{euclidean_side(A_, graph_A_, index, mu, landmarks_A_),
                   euclidean_side(B_, graph_B_, index, mu, landmarks_B_)};
    set_landmarks(pair, landmarks_, landmark_weight_);
    return pair;
}

}  // namespace varimap
