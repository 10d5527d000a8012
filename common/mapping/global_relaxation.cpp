#include "common/mapping/global_relaxation.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace varimap {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Frame = Eigen::Matrix<double, 3, 2>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double least_share = 1.0 / 64;  ///< of a step
constexpr double longest_step = 0.05;     ///< of one vertex, in units of sqrt(area)

struct FaceSystem {
    double value;  ///< energy per area
    Vector6 gradient;
    Matrix6 hessian;
};

/// A tangent frame turned into the plane with unit normal `up` the shortest way.
Frame turned(const Frame& frame, const Vec3& up) {
    const Vec3 normal = frame.col(0).cross(frame.col(1));
    const double cosine = normal.dot(up);
    if (cosine < -0.999) return frame;
    return frame - (normal + up) * (up.transpose() * frame) / (1 + cosine);
}

/// Gradient and convex Hessian of one face by the tangent coordinates of its corners. The Hessian takes the
/// surface as unfolded into the face's plane: in space, what bends with the surface would count as strain.
FaceSystem face_system(const MovingMap& map, const std::vector<Frame>& frames, int f,
                       const FoldEnergy& energy) {
    const auto corners = map.source().faces.row(f);
    const RestTriangle& rest = map.rest(f);
    const Chord chord = map.chord(f);
    const auto d = energy.derivatives(chord.q, chord.D);
    const Vec3 up = chord.up.normalized();
    Frame flat[3];
    for (int i = 0; i < 3; ++i) flat[i] = turned(frames[std::size_t(corners[i])], up);
    Vector6 q, D, gradient;
    Matrix6 hessian;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const Vec3 &x = map.image(corners[i]), &y = map.image(corners[j]), &z = map.image(corners[k]);
        const double cj = rest.cotangent[j], ck = rest.cotangent[k];
        const Vec3 by_q = (ck * (x - y) + cj * (x - z)) / rest.area;
        const Vec3 by_D = chord.up.cross(z - y) / (2 * rest.area);
        gradient.segment<2>(2 * i) =
            rest.area * frames[std::size_t(corners[i])].transpose() * (d.f_q * by_q + d.f_D * by_D);
        q.segment<2>(2 * i) = flat[i].transpose() * by_q;
        D.segment<2>(2 * i) = flat[i].transpose() * by_D;
        hessian.block<2, 2>(2 * i, 2 * i) = d.f_q * (cj + ck) * Eigen::Matrix2d::Identity();
        const Eigen::Matrix2d mixed = -d.f_q * ck * flat[i].transpose() * flat[j];
        hessian.block<2, 2>(2 * i, 2 * j) = mixed;
        hessian.block<2, 2>(2 * j, 2 * i) = mixed.transpose();
    }
    hessian +=
        rest.area * (d.f_qD * (q * D.transpose() + D * q.transpose()) + d.convex_DD * D * D.transpose());
    return {d.f, gradient, hessian};
}

}  // namespace

struct GlobalRelaxation::State {
    MovingMap& map;
    const FeatureAgreement* features;
    const std::vector<Attachment>* attachments = nullptr;
    std::vector<int> unknown;  ///< per vertex: its place among the free ones, or -1
    std::vector<int> free;
    std::vector<int> faces;  ///< mapped ones with a free corner
    Sparse matrix;           ///< lower triangle
    /// Per face and pair of corners (k, l) with unknown k >= unknown l: where the block's two columns start.
    std::vector<std::array<int, 18>> slot;
    std::vector<char> is_free;  ///< per face: whether it is among `faces`
    Eigen::SimplicialLDLT<Sparse, Eigen::Lower> solver;
    std::vector<Frame> frames;
    Eigen::VectorXd gradient;

    State(MovingMap& m, const std::vector<char>& fixed, const FeatureAgreement* f);
    void build_pattern();
    int find(int row, int column) const;
    void assemble(const FoldEnergy& energy, const RobustExcess& robust);
    void add(int f, const FaceSystem& system, double weight);
    void add_features();
    void add_attachments();
    void walk(const PointMap& start, const Eigen::VectorXd& direction, double share);
    double total(const FoldEnergy& energy, const RobustExcess& robust) const;
};

GlobalRelaxation::State::State(MovingMap& m, const std::vector<char>& fixed, const FeatureAgreement* f)
    : map(m),
      features(f),
      unknown(fixed.size(), -1),
      is_free(std::size_t(m.source().face_count()), 0),
      frames(fixed.size(), Frame::Zero()) {
    std::vector<char> used(fixed.size(), 0);
    for (int f = 0; f < map.source().face_count(); ++f) {
        const auto c = map.source().faces.row(f);
        const bool movable =
            !fixed[std::size_t(c[0])] || !fixed[std::size_t(c[1])] || !fixed[std::size_t(c[2])];
        if (!movable || !map.is_mapped(f)) continue;
        faces.push_back(f);
        is_free[std::size_t(f)] = 1;
        for (int k = 0; k < 3; ++k) used[std::size_t(c[k])] = 1;
    }
    for (std::size_t v = 0; v < fixed.size(); ++v) {
        if (fixed[v] || !used[v]) continue;
        unknown[v] = int(free.size());
        free.push_back(int(v));
    }
    build_pattern();
}

void GlobalRelaxation::State::build_pattern() {
    std::vector<Eigen::Triplet<double>> entries;
    const int n = 2 * int(free.size());
    const auto each_block = [&](const auto& body) {
        for (const int f : faces)
            for (int k = 0; k < 3; ++k)
                for (int l = 0; l < 3; ++l) {
                    const int row = unknown[std::size_t(map.source().faces(f, k))];
                    const int column = unknown[std::size_t(map.source().faces(f, l))];
                    if (column >= 0 && row >= column) body(f, k, l, row, column);
                }
    };
    each_block([&](int, int, int, int row, int column) {
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
                if (row > column || a >= b) entries.emplace_back(2 * row + a, 2 * column + b, 0.0);
    });
    matrix.resize(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    slot.resize(std::size_t(map.source().face_count()));
    each_block([&](int f, int k, int l, int row, int column) {
        auto* slots = slot[std::size_t(f)].data() + 6 * k + 2 * l;
        slots[0] = find(2 * row, 2 * column);
        slots[1] = find(2 * row + (row == column), 2 * column + 1);
    });
    solver.analyzePattern(matrix);
}

int GlobalRelaxation::State::find(int row, int column) const {
    const int* begin = matrix.innerIndexPtr();
    return int(std::lower_bound(begin + matrix.outerIndexPtr()[column],
                                begin + matrix.outerIndexPtr()[column + 1], row) -
               begin);
}

void GlobalRelaxation::State::assemble(const FoldEnergy& energy, const RobustExcess& robust) {
    for (const int v : free) frames[std::size_t(v)] = map.tangents(v);
    Eigen::Map<Eigen::VectorXd>(matrix.valuePtr(), matrix.nonZeros()).setZero();
    gradient = Eigen::VectorXd::Zero(matrix.rows());
    for (const int f : faces) {
        const FaceSystem system = face_system(map, frames, f, energy);
        add(f, system, robust.slope(system.value));
    }
    if (features) add_features();
    if (attachments) add_attachments();
    for (int i = 0; i < matrix.rows(); ++i) matrix.valuePtr()[matrix.outerIndexPtr()[i]] *= 1 + 1e-8;
}

void GlobalRelaxation::State::add(int f, const FaceSystem& system, double weight) {
    const auto corners = map.source().faces.row(f);
    for (int k = 0; k < 3; ++k) {
        const int row = unknown[std::size_t(corners[k])];
        if (row < 0) continue;
        gradient.segment<2>(2 * row) += weight * system.gradient.segment<2>(2 * k);
        for (int l = 0; l < 3; ++l) {
            const int column = unknown[std::size_t(corners[l])];
            if (column < 0 || row < column) continue;
            const int* slots = slot[std::size_t(f)].data() + 6 * k + 2 * l;
            double* values = matrix.valuePtr();
            const bool diagonal = row == column;
            values[slots[0]] += weight * system.hessian(2 * k, 2 * l);
            values[slots[0] + 1] += weight * system.hessian(2 * k + 1, 2 * l);
            if (!diagonal) values[slots[1]] += weight * system.hessian(2 * k, 2 * l + 1);
            values[slots[1] + !diagonal] += weight * system.hessian(2 * k + 1, 2 * l + 1);
        }
    }
}

void GlobalRelaxation::State::add_features() {
    for (std::size_t i = 0; i < free.size(); ++i) {
        const auto system = features->derivatives(free[i], frames[std::size_t(free[i])]);
        gradient.segment<2>(2 * int(i)) += system.gradient;
        // The lower triangle's columns start with the block on the diagonal.
        const int* start = matrix.outerIndexPtr() + 2 * i;
        matrix.valuePtr()[start[0]] += system.hessian(0, 0);
        matrix.valuePtr()[start[0] + 1] += system.hessian(1, 0);
        matrix.valuePtr()[start[1]] += system.hessian(1, 1);
    }
}

void GlobalRelaxation::State::add_attachments() {
    for (const Attachment& attachment : *attachments) {
        const int f = attachment.from.face;
        if (!is_free[std::size_t(f)]) continue;
        const auto [gradient, hessian] = derivatives(attachment, map, frames);
        add(f, {0, gradient, hessian}, 1);
    }
}

double GlobalRelaxation::State::total(const FoldEnergy& energy, const RobustExcess& robust) const {
    double sum = 0;
    for (const int f : faces) {
        const Chord chord = map.chord(f);
        sum += map.rest(f).area * robust.value(energy.value(chord.q, chord.D));
    }
    if (features)
        for (const int v : free) sum += features->value(v);
    if (attachments)
        for (const Attachment& attachment : *attachments)
            if (is_free[std::size_t(attachment.from.face)]) sum += varimap::value(attachment, map);
    return sum;
}

/// Moves all free vertices from `start` by that share of their step.
void GlobalRelaxation::State::walk(const PointMap& start, const Eigen::VectorXd& direction, double share) {
    for (const int v : free) {
        Vec3 step = frames[std::size_t(v)] * direction.segment<2>(2 * unknown[std::size_t(v)]);
        const double length = step.norm();
        if (length > longest_step) step *= longest_step / length;
        map.place(v, start[std::size_t(v)]);
        map.move(v, share * step);
    }
}

GlobalRelaxation::GlobalRelaxation(MovingMap& map, const std::vector<char>& fixed,
                                   const FeatureAgreement* features)
    : state_(std::make_unique<State>(map, fixed, features)) {}
GlobalRelaxation::~GlobalRelaxation() = default;

void GlobalRelaxation::attach(const std::vector<Attachment>& attachments) {
    state_->attachments = &attachments;
}

double GlobalRelaxation::step(const FoldEnergy& energy, double robustness) {
    State& s = *state_;
    const RobustExcess robust(energy, robustness);
    s.assemble(energy, robust);
    s.solver.factorize(s.matrix);
    if (s.solver.info() != Eigen::Success) return 0;
    const Eigen::VectorXd direction = -s.solver.solve(s.gradient);
    if (!direction.allFinite()) return 0;
    const PointMap start = s.map.points();
    const double before = s.total(energy, robust);
    // Curved targets make full steps overshoot: the share is halved for as long as that helps.
    double best = before, best_share = 0;
    for (double share = 1; share >= least_share; share /= 2) {
        s.walk(start, direction, share);
        const double after = s.total(energy, robust);
        if (after >= best && best_share > 0) break;
        if (after < best) {
            best = after;
            best_share = share;
        }
    }
    s.walk(start, direction, best_share);
    return before > 0 ? 1 - best / before : 0;
}

}  // namespace varimap
