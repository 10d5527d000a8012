#include "varimap/relaxation/global_relaxation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "varimap/core/index_set.h"
#include "varimap/core/timing.h"
#include "varimap/relaxation/triangle_system.h"
#include "varimap/sliding/face_energy.h"

namespace varimap {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double least_share = 1.0 / 64;  ///< of a step; swept: 0.002 to 1/16
constexpr double next_share = 0.4;        ///< of the one before
/// Of one vertex, in units of sqrt(area). Swept: from 0.02; at 0.2 a branch point is left.
constexpr double longest_step = 0.05;
/// Energy, per area, that a face may gain in a step that is walked with care. 0.3 and 3 did about the same.
constexpr double tolerable = 1;
constexpr int careful_trials = 5;
constexpr double careful_share = 0.4;  ///< of the step before, where that was too long
constexpr double shift = 1e-8;         ///< of the diagonal, relative; swept: 1e-10 to 1e-6

/// Collects each of the first `count` integers once.
class Collector {
  public:
    explicit Collector(std::ptrdiff_t count) : marks_(std::size_t(count), 0) {}
    void add(int i) {
        if (marks_[std::size_t(i)]) return;
        marks_[std::size_t(i)] = 1;
        taken_.push_back(i);
    }
    /// What was added, in that order; it begins anew.
    std::vector<int> take() {
        for (const int i : taken_) marks_[std::size_t(i)] = 0;
        return std::exchange(taken_, {});
    }

  private:
    std::vector<char> marks_;
    std::vector<int> taken_;
};

/// A tangent frame turned into the plane with unit normal `up` the shortest way.
TangentFrame turned(const TangentFrame& frame, const Vec3& up) {
    const Vec3 normal = frame.col(0).cross(frame.col(1));
    const double cosine = normal.dot(up);
    if (cosine < -0.999) return frame;
    return frame - (normal + up) * (up.transpose() * frame) / (1 + cosine);
}

/// Gradient and convex Hessian of one face's energy, whose derivatives by q and D are d. The Hessian takes
/// the surface as unfolded into the face's plane: in space, what bends with the surface would count as
/// strain.
FaceDerivatives face_derivatives(const SlidingMap& map, const VertexData<TangentFrame>& frames, int f,
                                 const ImageTriangle& image, const FoldEnergy::Value& d) {
    const auto corners = map.source().faces.row(f);
    const RestTriangle& rest = map.rest(f);
    const Vec3 up = image.up.normalized();
    TangentFrame flat[3];
    for (int i = 0; i < 3; ++i) flat[i] = turned(frames[corners[i]], up);
    Vector6 q, D;
    FaceDerivatives result;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double cj = rest.cotangent[j], ck = rest.cotangent[k];
        const CornerGradient at_corner = corner_gradient(map, f, i, image);
        const Vec3 by_q = at_corner.q / rest.area, by_D = at_corner.D / (2 * rest.area);
        result.gradient.segment<2>(2 * i) =
            rest.area * frames[corners[i]].transpose() * (d.f_q * by_q + d.f_D * by_D);
        q.segment<2>(2 * i) = flat[i].transpose() * by_q;
        D.segment<2>(2 * i) = flat[i].transpose() * by_D;
        result.hessian.block<2, 2>(2 * i, 2 * i) = d.f_q * (cj + ck) * Eigen::Matrix2d::Identity();
        const Eigen::Matrix2d mixed = -d.f_q * ck * flat[i].transpose() * flat[j];
        result.hessian.block<2, 2>(2 * i, 2 * j) = mixed;
        result.hessian.block<2, 2>(2 * j, 2 * i) = mixed.transpose();
    }
    result.hessian += rest.area * gradient_products(q, D, d.f_qD, d.convex_DD);
    return result;
}

}  // namespace

struct GlobalRelaxation::State {
    SlidingMap& map;
    const ReliefAgreement* relief;
    const std::vector<SoftConstraint>* constraints = nullptr;
    VertexData<int> unknown;  ///< its place among the free vertices, or -1
    std::vector<int> free;
    std::vector<int> faces;                  ///< mapped ones with a free corner
    FaceData<int> place_of;                  ///< its place among `faces`, or -1
    std::unique_ptr<TriangleSystem> system;  ///< its nodes are the free vertices, its triangles the faces
    VertexData<TangentFrame> frames;
    Eigen::VectorXd gradient;
    struct Shape {
        double q, D;
    };
    std::vector<Shape> shapes;            ///< of the images of `faces`, as last measured
    PointMap start;                       ///< images of the free vertices before a step
    std::vector<Vec3> steps;              ///< of the free vertices
    Collector some_faces, some_vertices;  ///< by their places

    State(SlidingMap& m, const VertexData<bool>& fixed, const ReliefAgreement* r);
    void find_faces(const VertexData<bool>& fixed);
    void number_unknowns(const VertexData<bool>& fixed);
    void assemble(const RobustEnergy& energy);
    void add_relief();
    void add_constraints();
    void add(int i, const FaceDerivatives& face, double weight);
    void set_steps(const Eigen::VectorXd& direction);
    void walk(double share);
    void measure(const std::vector<int>& places);
    void walk_with_care(const FoldEnergy& energy, const std::vector<double>& before, double share);
    std::vector<double> densities(const FoldEnergy& energy) const;
    double density(int i, const FoldEnergy& energy) const;
    std::vector<int> around(const std::vector<int>& vertices);
    std::vector<int> corners_of_worse(const FoldEnergy& energy, const std::vector<double>& before,
                                      const std::vector<int>& candidates);
    double descend(const RobustEnergy& energy, double before);
    double total(const RobustEnergy& energy) const;
};

GlobalRelaxation::State::State(SlidingMap& m, const VertexData<bool>& fixed, const ReliefAgreement* r)
    : map(m),
      relief(r),
      unknown(fixed.size(), -1),
      place_of(m.source().face_count(), -1),
      frames(fixed.size(), TangentFrame::Zero()),
      some_faces(m.source().face_count()),
      some_vertices(m.source().vertex_count()) {
    find_faces(fixed);
    number_unknowns(fixed);
    std::vector<std::array<int, 3>> triangles;
    for (const int f : faces) {
        const auto corners = map.source().faces.row(f);
        triangles.push_back({unknown[corners[0]], unknown[corners[1]], unknown[corners[2]]});
    }
    system = std::make_unique<TriangleSystem>(int(free.size()), triangles);
    shapes.resize(faces.size());
}

void GlobalRelaxation::State::find_faces(const VertexData<bool>& fixed) {
    for (int f = 0; f < map.source().face_count(); ++f) {
        if (marked_corners(map.source(), f, fixed) == 3 || !map.is_mapped(f)) continue;
        place_of[f] = int(faces.size());
        faces.push_back(f);
    }
}

/// The unknowns are the vertices of the faces that are not fixed.
void GlobalRelaxation::State::number_unknowns(const VertexData<bool>& fixed) {
    VertexData<bool> used(fixed.size());
    for (const int f : faces) mark_corners(map.source(), f, used);
    for (int v = 0; v < fixed.size(); ++v) {
        if (fixed[v] || !used[v]) continue;
        unknown[v] = int(free.size());
        free.push_back(v);
    }
}

void GlobalRelaxation::State::assemble(const RobustEnergy& energy) {
    for (const int v : free) frames[v] = map.tangents(v);
    system->clear();
    gradient = Eigen::VectorXd::Zero(2 * Eigen::Index(free.size()));
    for (int i = 0; i < int(faces.size()); ++i) {
        const ImageTriangle image = map.image_triangle(faces[i]);
        shapes[std::size_t(i)] = {image.q, image.D};
        const FoldEnergy::Value d = energy.energy.derivatives(image.q, image.D);
        add(i, face_derivatives(map, frames, faces[i], image, d), energy.slope(d.f));
        if (const double more = map.rest(faces[i]).area_weight; more > 0)
            add(i, face_derivatives(map, frames, faces[i], image, energy.energy.area_derivatives(image.D)),
                more);
    }
    if (relief) add_relief();
    if (constraints) add_constraints();
    system->scale_diagonal(1 + shift);
}

/// Adds to what belongs to faces[i].
void GlobalRelaxation::State::add(int i, const FaceDerivatives& face, double weight) {
    system->add(i, face.hessian, weight);
    for (int k = 0; k < 3; ++k)
        if (const int row = unknown[map.source().faces(faces[i], k)]; row >= 0)
            gradient.segment<2>(2 * row) += weight * face.gradient.segment<2>(2 * k);
}

void GlobalRelaxation::State::add_relief() {
    for (int i = 0; i < int(free.size()); ++i) {
        const auto data = relief->derivatives(free[i], frames[free[i]]);
        gradient.segment<2>(2 * i) += data.gradient;
        system->add(i, data.hessian);
    }
}

void GlobalRelaxation::State::add_constraints() {
    for (const SoftConstraint& constraint : *constraints)
        if (const int i = place_of[constraint.from.face]; i >= 0)
            add(i, derivatives(constraint, map, frames), 1);
}

double GlobalRelaxation::State::total(const RobustEnergy& energy) const {
    double sum = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const RestTriangle& rest = map.rest(faces[i]);
        sum += rest.area * density_with_area_weight(energy, rest, shapes[i].q, shapes[i].D);
    }
    if (relief)
        for (const int v : free) sum += relief->value(v);
    if (constraints)
        for (const SoftConstraint& constraint : *constraints)
            if (place_of[constraint.from.face] >= 0) sum += varimap::value(constraint, map);
    return sum;
}

void GlobalRelaxation::State::set_steps(const Eigen::VectorXd& direction) {
    start = map.points_of(free);
    steps.resize(free.size());
    for (int i = 0; i < int(free.size()); ++i) {
        steps[i] = frames[free[i]] * direction.segment<2>(2 * i);
        const double length = steps[i].norm();
        if (length > longest_step) steps[i] *= longest_step / length;
    }
}

/// Moves all free vertices from the start by that share of their step.
void GlobalRelaxation::State::walk(double share) {
    for (int i = 0; i < int(free.size()); ++i) map.place(free[i], map.walk(start[i], share * steps[i]));
}

/// Of the faces at these places.
void GlobalRelaxation::State::measure(const std::vector<int>& places) {
    for (const int i : places) {
        const ImageTriangle image = map.image_triangle(faces[std::size_t(i)]);
        shapes[std::size_t(i)] = {image.q, image.D};
    }
}

std::vector<double> GlobalRelaxation::State::densities(const FoldEnergy& energy) const {
    std::vector<double> result(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) result[i] = density(int(i), energy);
    return result;
}

double GlobalRelaxation::State::density(int i, const FoldEnergy& energy) const {
    const auto& [q, D] = shapes[std::size_t(i)];
    return density_with_area_weight(energy, map.rest(faces[std::size_t(i)]), q, D);
}

/// The faces, by their places, of the free vertices at those places.
std::vector<int> GlobalRelaxation::State::around(const std::vector<int>& vertices) {
    for (const int i : vertices)
        for (const int f : map.faces_of_vertex()[free[std::size_t(i)]])
            if (place_of[f] >= 0) some_faces.add(place_of[f]);
    return some_faces.take();
}

/// The free vertices, by their places, of those of `candidates` (places of faces) that gained more than is
/// tolerable.
std::vector<int> GlobalRelaxation::State::corners_of_worse(const FoldEnergy& energy,
                                                           const std::vector<double>& before,
                                                           const std::vector<int>& candidates) {
    for (const int i : candidates)
        if (density(i, energy) > before[std::size_t(i)] + tolerable)
            for (int k = 0; k < 3; ++k)
                if (const int u = unknown[map.source().faces(faces[std::size_t(i)], k)]; u >= 0)
                    some_vertices.add(u);
    return some_vertices.take();
}

/// Moves all free vertices from the start by that share of their steps, shorter ones where faces would get
/// far worse than `before`, and none where that does not help: a few corners that turn over do not hold up
/// all others.
void GlobalRelaxation::State::walk_with_care(const FoldEnergy& energy, const std::vector<double>& before,
                                             double share) {
    std::vector<double> shares(free.size(), share);
    walk(share);
    std::vector<int> candidates = all_indices(std::ssize(faces));
    measure(candidates);
    for (int trial = 1; trial <= careful_trials; ++trial) {
        const std::vector<int> worse = corners_of_worse(energy, before, candidates);
        if (worse.empty()) return;
        for (const int u : worse) {
            const auto i = std::size_t(u);
            shares[i] = trial < careful_trials ? careful_share * shares[i] : 0;
            map.place(free[i], map.walk(start[i], shares[i] * steps[i]));
        }
        candidates = around(worse);  // all others are as they were, and were not worse
        measure(candidates);
    }
}

/// Leaves the images after the largest share of the step that lowers the energy, walked with care; as they
/// were where none does. Curved targets make full steps overshoot. Returns the energy.
double GlobalRelaxation::State::descend(const RobustEnergy& energy, double before) {
    const std::vector<double> densities_before = densities(energy.energy);
    for (double share = 1; share >= least_share; share *= next_share) {
        walk_with_care(energy.energy, densities_before, share);
        if (const double after = total(energy); after < before) return after;
    }
    map.place(free, start);
    return before;
}

GlobalRelaxation::GlobalRelaxation(SlidingMap& map, const VertexData<bool>& fixed,
                                   const ReliefAgreement* relief)
    : state_(std::make_unique<State>(map, fixed, relief)) {}
GlobalRelaxation::~GlobalRelaxation() = default;

void GlobalRelaxation::set_constraints(const std::vector<SoftConstraint>& constraints) {
    state_->constraints = &constraints;
}

double GlobalRelaxation::step(const RobustEnergy& energy) {
    const Timer timer("global steps");
    State& s = *state_;
    s.assemble(energy);
    if (!s.system->factorize()) return 0;
    const Eigen::VectorXd direction = -s.system->solve(s.gradient);
    if (!direction.allFinite()) return 0;
    s.set_steps(direction);
    const double before = s.total(energy), after = s.descend(energy, before);
    return before > 0 ? 1 - after / before : 0;
}

}  // namespace varimap
