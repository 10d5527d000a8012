#include "varimap/relaxation/global_relaxation.h"

#include <array>
#include <cmath>

#include "varimap/relaxation/triangle_system.h"

namespace varimap {

namespace {

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
FaceSystem face_system(const SlidingMap& map, const std::vector<Frame>& frames, int f,
                       const FoldEnergy& energy) {
    const auto corners = map.source().faces.row(f);
    const RestTriangle& rest = map.rest(f);
    const ImageTriangle image = map.image_triangle(f);
    const auto d = energy.derivatives(image.q, image.D);
    const Vec3 up = image.up.normalized();
    Frame flat[3];
    for (int i = 0; i < 3; ++i) flat[i] = turned(frames[std::size_t(corners[i])], up);
    Vector6 q, D, gradient;
    Matrix6 hessian;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const Vec3 &x = map.image(corners[i]), &y = map.image(corners[j]), &z = map.image(corners[k]);
        const double cj = rest.cotangent[j], ck = rest.cotangent[k];
        const Vec3 by_q = (ck * (x - y) + cj * (x - z)) / rest.area;
        const Vec3 by_D = image.up.cross(z - y) / (2 * rest.area);
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
    SlidingMap& map;
    const ReliefAgreement* relief;
    const std::vector<SoftConstraint>* constraints = nullptr;
    std::vector<int> unknown;  ///< per vertex: its place among the free ones, or -1
    std::vector<int> free;
    std::vector<int> faces;                  ///< mapped ones with a free corner
    std::vector<int> place_of;               ///< per face: its place among `faces`, or -1
    std::unique_ptr<TriangleSystem> system;  ///< its nodes are the free vertices, its triangles the faces
    std::vector<Frame> frames;
    Eigen::VectorXd gradient;
    PointMap start;           ///< images of the free vertices before a step
    std::vector<Vec3> steps;  ///< of the free vertices

    State(SlidingMap& m, const std::vector<char>& fixed, const ReliefAgreement* r);
    void assemble(const FoldEnergy& energy, const RobustExcess& robust);
    void add_relief();
    void add(int i, const FaceSystem& face, double weight);
    void add_constraints();
    PointMap images() const;
    void place(const PointMap& images);
    void set_steps(const Eigen::VectorXd& direction);
    void walk(double share);
    double total(const FoldEnergy& energy, const RobustExcess& robust) const;
};

GlobalRelaxation::State::State(SlidingMap& m, const std::vector<char>& fixed, const ReliefAgreement* r)
    : map(m),
      relief(r),
      unknown(fixed.size(), -1),
      place_of(std::size_t(m.source().face_count()), -1),
      frames(fixed.size(), Frame::Zero()) {
    std::vector<char> used(fixed.size(), 0);
    for (int f = 0; f < map.source().face_count(); ++f) {
        const auto c = map.source().faces.row(f);
        const bool movable =
            !fixed[std::size_t(c[0])] || !fixed[std::size_t(c[1])] || !fixed[std::size_t(c[2])];
        if (!movable || !map.is_mapped(f)) continue;
        place_of[std::size_t(f)] = int(faces.size());
        faces.push_back(f);
        for (int k = 0; k < 3; ++k) used[std::size_t(c[k])] = 1;
    }
    for (std::size_t v = 0; v < fixed.size(); ++v) {
        if (fixed[v] || !used[v]) continue;
        unknown[v] = int(free.size());
        free.push_back(int(v));
    }
    std::vector<std::array<int, 3>> triangles;
    for (const int f : faces) {
        const auto c = map.source().faces.row(f);
        triangles.push_back(
            {unknown[std::size_t(c[0])], unknown[std::size_t(c[1])], unknown[std::size_t(c[2])]});
    }
    system = std::make_unique<TriangleSystem>(int(free.size()), triangles);
}

void GlobalRelaxation::State::assemble(const FoldEnergy& energy, const RobustExcess& robust) {
    for (const int v : free) frames[std::size_t(v)] = map.tangents(v);
    system->clear();
    gradient = Eigen::VectorXd::Zero(2 * Eigen::Index(free.size()));
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const FaceSystem face = face_system(map, frames, faces[i], energy);
        add(int(i), face, robust.slope(face.value));
    }
    if (relief) add_relief();
    if (constraints) add_constraints();
    system->scale_diagonal(1 + 1e-8);
}

/// Adds to what belongs to faces[i].
void GlobalRelaxation::State::add(int i, const FaceSystem& face, double weight) {
    system->add(i, face.hessian, weight);
    for (int k = 0; k < 3; ++k)
        if (const int row = unknown[std::size_t(map.source().faces(faces[std::size_t(i)], k))]; row >= 0)
            gradient.segment<2>(2 * row) += weight * face.gradient.segment<2>(2 * k);
}

void GlobalRelaxation::State::add_relief() {
    for (std::size_t i = 0; i < free.size(); ++i) {
        const auto data = relief->derivatives(free[i], frames[std::size_t(free[i])]);
        gradient.segment<2>(2 * Eigen::Index(i)) += data.gradient;
        system->add(int(i), data.hessian);
    }
}

void GlobalRelaxation::State::add_constraints() {
    for (const SoftConstraint& constraint : *constraints) {
        const int i = place_of[std::size_t(constraint.from.face)];
        if (i < 0) continue;
        const auto [gradient, hessian] = derivatives(constraint, map, frames);
        add(i, {0, gradient, hessian}, 1);
    }
}

double GlobalRelaxation::State::total(const FoldEnergy& energy, const RobustExcess& robust) const {
    double sum = 0;
    for (const int f : faces) {
        const ImageTriangle image = map.image_triangle(f);
        sum += map.rest(f).area * robust.value(energy.value(image.q, image.D));
    }
    if (relief)
        for (const int v : free) sum += relief->value(v);
    if (constraints)
        for (const SoftConstraint& constraint : *constraints)
            if (place_of[std::size_t(constraint.from.face)] >= 0) sum += varimap::value(constraint, map);
    return sum;
}

PointMap GlobalRelaxation::State::images() const {
    PointMap points(free.size());
    for (std::size_t i = 0; i < free.size(); ++i) points[i] = map.points()[std::size_t(free[i])];
    return points;
}

void GlobalRelaxation::State::place(const PointMap& images) {
    for (std::size_t i = 0; i < free.size(); ++i) map.place(free[i], images[i]);
}

void GlobalRelaxation::State::set_steps(const Eigen::VectorXd& direction) {
    start = images();
    steps.resize(free.size());
    for (std::size_t i = 0; i < free.size(); ++i) {
        steps[i] = frames[std::size_t(free[i])] * direction.segment<2>(2 * Eigen::Index(i));
        const double length = steps[i].norm();
        if (length > longest_step) steps[i] *= longest_step / length;
    }
}

/// Moves all free vertices from the start by that share of their step.
void GlobalRelaxation::State::walk(double share) {
    for (std::size_t i = 0; i < free.size(); ++i) map.place(free[i], map.walk(start[i], share * steps[i]));
}

GlobalRelaxation::GlobalRelaxation(SlidingMap& map, const std::vector<char>& fixed,
                                   const ReliefAgreement* relief)
    : state_(std::make_unique<State>(map, fixed, relief)) {}
GlobalRelaxation::~GlobalRelaxation() = default;

void GlobalRelaxation::set_constraints(const std::vector<SoftConstraint>& constraints) {
    state_->constraints = &constraints;
}

double GlobalRelaxation::step(const FoldEnergy& energy, double robustness) {
    State& s = *state_;
    const RobustExcess robust(energy, robustness);
    s.assemble(energy, robust);
    if (!s.system->factorize()) return 0;
    const Eigen::VectorXd direction = -s.system->solve(s.gradient);
    if (!direction.allFinite()) return 0;
    s.set_steps(direction);
    const double before = s.total(energy, robust);
    // Curved targets make full steps overshoot: the share is halved for as long as that helps.
    double best = before;
    PointMap best_images = s.start;
    for (double share = 1; share >= least_share; share /= 2) {
        s.walk(share);
        const double after = s.total(energy, robust);
        if (after >= best && best < before) break;
        if (after < best) {
            best = after;
            best_images = s.images();
        }
    }
    s.place(best_images);
    return before > 0 ? 1 - best / before : 0;
}

}  // namespace varimap
