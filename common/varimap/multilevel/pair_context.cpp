#include "varimap/multilevel/pair_context.h"

#include <tbb/task_arena.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace varimap {

namespace {

/// psi = Phi_t / sqrt(1 + K_t), rows in the unit ball.
RowMatrix normalised_embedding(const Basis& basis, double time) {
    RowMatrix psi = diffusion_embedding(basis, time);
    const Eigen::VectorXd kernel = psi.rowwise().squaredNorm();
    return (1 + kernel.array()).rsqrt().matrix().asDiagonal() * psi;
}

/// c with c^2 = sum over edges m_i |x_i - x_j|^2 / sum m_i |psi_i - psi_j|^2.
double edge_scale(const Domain& domain, const RowMatrix& psi) {
    const TriangleMesh& mesh = domain.mesh;
    double in_space = 0, in_psi = 0;
    const auto add = [&](int i, int j) {
        in_space += domain.mass[i] * (mesh.vertices.row(i) - mesh.vertices.row(j)).squaredNorm();
        in_psi += domain.mass[i] * (psi.row(i) - psi.row(j)).squaredNorm();
    };
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int c = 0; c < 3; ++c) add(mesh.faces(f, c), mesh.faces(f, (c + 1) % 3));
    for (const DomainEdge& edge : domain.edges) add(edge.a, edge.b);
    return std::sqrt(in_space / in_psi);
}

/// The points in their own `count` principal directions: distances among them shrink least.
RowMatrix principal_coordinates(const RowMatrix& points, const Eigen::VectorXd& mass, Eigen::Index count) {
    const RowMatrix centred = points.rowwise() - Eigen::RowVectorXd(mass.transpose() * points);
    const Eigen::MatrixXd covariance = centred.transpose() * mass.asDiagonal() * centred;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(covariance);
    return centred * directions.eigenvectors().rightCols(std::min(count, points.cols()));
}

template <class Pair, class Member>
std::vector<int> indices(const std::vector<Pair>& pairs, Member vertex) {
    std::vector<int> result;
    for (const Pair& pair : pairs) result.push_back((pair.*vertex).index);
    return result;
}

using Landmark = VertexPairs<MeshVertex>::value_type;

using Enlarge = Level (LevelBuilder::*)(const Level&, const std::vector<int>&, const RowMatrix&) const;
/// A side's diffusion level with its landmarks, embedded for it only where that adds samples.
template <class Side>
Level with_landmarks(const Side& own, int index, Enlarge enlarge) {
    const Level& source = own.diffusion_source(index);
    if (samples_with(source, own.landmarks).size() == source.samples.size()) return source;
    return (own.builder().*enlarge)(source, own.landmarks, diffusion_embedding(own.data.basis, source.scale));
}

}  // namespace

RowMatrix sample_positions(const Domain& domain, const Level& level) {
    return domain.mesh.vertices(level.samples, Eigen::all);
}

const Level& PairContext::Side::diffusion_source(int index) const {
    const Hierarchy& h = data.hierarchy;
    return h.levels[size_t(std::min(index, h.diffusion_levels() - 1))];
}

LevelSide PairContext::Side::joined(Level level, RowMatrix vertex_points) const {
    return make_level_side(std::move(level), std::move(vertex_points), data.surface.mass,
                           data.hierarchy.options.truncation);
}

const PairContext::Side::Psi& PairContext::Side::psi() const {
    std::call_once(psi_->once, [&] {
        // Isolated: a task that this thread took up meanwhile could ask for it again, and wait for itself.
        tbb::this_task_arena::isolate([&] {
            // Most of psi's extent lies in few directions; 32 of 100 measured as accurate as all, in two
            // thirds of the time.
            constexpr Eigen::Index principal_directions = 32;
            const Level& last = data.hierarchy.last_diffusion_level();
            psi_->points = principal_coordinates(normalised_embedding(data.basis, last.scale),
                                                 data.surface.mass, principal_directions);
            psi_->scale = edge_scale(data.surface, psi_->points);
        });
    });
    return *psi_;
}

RowMatrix PairContext::Side::mixed_points(double mu) const {
    if (data.surface.coordinates.size() > 0) return data.surface.coordinates;
    const RowMatrix x = data.surface.mesh.vertices;
    if (mu == 0) return x;
    const Psi& psi = this->psi();
    RowMatrix points(x.rows(), 3 + psi.points.cols());
    points << x, (mu * psi.scale) * psi.points;
    return points;
}

PairContext::PairContext(SurfaceData A, SurfaceData B, VertexPairs<MeshVertex> landmarks,
                         double landmark_weight, int landmarks_left_out)
    : A_(std::move(A), indices(landmarks, &Landmark::first)),
      B_(std::move(B), indices(landmarks, &Landmark::second)),
      landmarks_(std::move(landmarks)),
      landmark_weight_(landmark_weight),
      landmarks_left_out_(landmarks_left_out) {}

LevelPair PairContext::joined(LevelSide A, LevelSide B) const {
    LevelPair pair{std::move(A), std::move(B), {}};
    pair.partners = partners_at(pair, landmarks_, landmark_weight_);
    return pair;
}

int PairContext::diffusion_levels() const {
    return std::max(A().hierarchy.diffusion_levels(), B().hierarchy.diffusion_levels());
}

LevelPair PairContext::diffusion_level(int index) const {
    const auto side = [index](const Side& own) {
        const Level& source = own.diffusion_source(index);
        RowMatrix embedding = diffusion_embedding(own.data.basis, source.scale);
        Level level = own.builder().diffusion_with(source, own.landmarks, embedding);
        return own.joined(std::move(level), std::move(embedding));
    };
    return joined(side(A_), side(B_));
}

Levels PairContext::diffusion_samples(int index) const {
    constexpr Enlarge enlarge = &LevelBuilder::diffusion_with;
    return {with_landmarks(A_, index, enlarge), with_landmarks(B_, index, enlarge)};
}

Levels PairContext::diffusion_cells(int index) const {
    constexpr Enlarge enlarge = &LevelBuilder::diffusion_cells_with;
    return {with_landmarks(A_, index, enlarge), with_landmarks(B_, index, enlarge)};
}

int PairContext::diffusion_sample_count(int index) const {
    const auto count = [index](const Side& side) {
        return samples_with(side.diffusion_source(index), side.landmarks).size();
    };
    return int(std::min(count(A_), count(B_)));
}

int PairContext::find_diffusion_level(const std::vector<int>& samples_A,
                                      const std::vector<int>& samples_B) const {
    for (int l = diffusion_levels() - 1; l >= 0; --l)
        if (samples_with(A_.diffusion_source(l), A_.landmarks) == samples_A &&
            samples_with(B_.diffusion_source(l), B_.landmarks) == samples_B)
            return l;
    return -1;
}

int PairContext::euclidean_levels() const {
    return std::max(A().hierarchy.sampled_euclidean_levels(), B().hierarchy.sampled_euclidean_levels()) + 1;
}

const Level& PairContext::euclidean_source(const Side& side, int index) const {
    const Hierarchy& h = side.data.hierarchy;
    if (index + 1 == euclidean_levels()) return h.levels.back();
    // A surface with fewer sampled levels stays on its last one, so that both end together.
    return h.levels[size_t(h.diffusion_levels() + std::min(index, h.sampled_euclidean_levels() - 1))];
}

LevelPair PairContext::euclidean_level(int index, double mu) const {
    const auto side = [&](const Side& own) {
        return own.joined(own.builder().euclidean_with(euclidean_source(own, index), own.landmarks),
                          own.mixed_points(mu));
    };
    return joined(side(A_), side(B_));
}

}  // namespace varimap
