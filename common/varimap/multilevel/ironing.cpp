#include "varimap/multilevel/ironing.h"

#include <algorithm>
#include <cmath>

#include "varimap/core/log.h"
#include "varimap/mesh/face_geometry.h"
#include "varimap/mesh/ray_mesh.h"
#include "varimap/multilevel/reanchoring.h"
#include "varimap/spectral/local_shape.h"

namespace varimap {

namespace {

/// Where the inward normal of a vertex leaves the surface on the other side: the nearest vertex there.
class Antipodes {
  public:
    /// `looks_inward`: whether the faces do, and with them the surface's normals.
    Antipodes(const OrientedSurface& surface, const TriangleMesh& mesh, bool looks_inward)
        : mesh_(mesh), normals_(surface.normals), inward_(looks_inward ? 1 : -1), rays_(mesh) {}

    int of(int vertex) const {
        constexpr double lift = 1e-4;  // units of sqrt(area): past the faces around the vertex itself
        const Vec3 inward = inward_ * normals_.row(vertex).transpose();
        const SurfacePoint hit = rays_.first_hit(mesh_.vertex(vertex) + lift * inward, inward);
        return hit.face < 0 ? vertex : nearest_vertex(mesh_, hit);
    }

  private:
    const TriangleMesh& mesh_;
    const Points& normals_;
    double inward_;  ///< times a normal
    RayMesh rays_;
};

Eigen::VectorXd damping(const Orientation& orientation, double omega) {
    Eigen::VectorXd factor(Eigen::Index(orientation.determinant.size()));
    for (Eigen::Index i = 0; i < factor.size(); ++i)
        factor[i] = orientation.determinant[size_t(i)] < 0 ? omega : 1.0;
    return factor;
}

/// Reversed parts of both sides that are heavy enough to be placed anew.
struct ReversedParts {
    std::vector<ReversedPart> A, B;
    bool empty() const { return A.empty() && B.empty(); }
};

}  // namespace

/// The ironing of one map at one level.
class Ironing::Run {
  public:
    Run(const Ironing& ironing, const LevelPair& level, AlternatingMinimization& minimization,
        const Observer& observe, const IroningOptions& options)
        : ironing_(ironing),
          options_(options),
          level_(level),
          minimization_(minimization),
          observe_(observe),
          orientation_(measured()) {}

    void reflect();
    void damp();
    void reanchor();
    PairOrientation take_orientation() { return std::move(orientation_); }

  private:
    PairOrientation measured() const { return ironing_.measure(level_, minimization_.solution()); }
    Centres reflected_centres() const;
    Start reanchored(const ReversedParts& parts) const;
    double adopt_if_better(AlternatingMinimization& trial);

    const Ironing& ironing_;
    const IroningOptions& options_;
    const LevelPair& level_;
    AlternatingMinimization& minimization_;
    const Observer& observe_;
    PairOrientation orientation_;  ///< of the minimisation's solution
};

/// Goes on from where a trial has ended if less mass is reversed there, at no too high an energy. Returns how
/// much is.
double Ironing::Run::adopt_if_better(AlternatingMinimization& trial) {
    PairOrientation after = ironing_.measure(level_, trial.solution());
    const double reversed = after.reversed_mass(), put_right = orientation_.reversed_mass() - reversed;
    const double cost = std::log(trial.solution().step.energy / minimization_.solution().step.energy);
    if (put_right > 0 && !(cost > options_.energy_for_mass * put_right)) {
        minimization_.adopt(trial.take_solution());
        orientation_ = std::move(after);
    }
    return reversed;
}

Centres Ironing::Run::reflected_centres() const {
    // g = antipode . f and g^-1 = f^-1 . antipode.
    const Surface &A = ironing_.context_.A().surface, &B = ironing_.context_.B().surface;
    const Antipodes antipodes(ironing_.oriented_B_, B.mesh, PairHandedness(A, B).B_inward);
    const Centres& centres = minimization_.solution().step.centres;
    const Level& level_B = level_.B.level;
    Centres reflected = centres;
    for (Eigen::Index k = 0; k < centres.row.rows(); ++k)
        reflected.row.row(k) =
            level_.B.vertex_points.row(antipodes.of(orientation_.A_to_B.image_vertex[size_t(k)]));
    for (Eigen::Index l = 0; l < centres.column.rows(); ++l) {
        const int opposite = antipodes.of(level_B.samples[size_t(l)]);
        reflected.column.row(l) = centres.column.row(level_B.cell[size_t(opposite)]);
    }
    reflected.row = level_.A.side.averaging.P * reflected.row;
    reflected.column = level_.B.side.averaging.P * reflected.column;
    return reflected;
}

void Ironing::Run::reflect() {
    const double before = orientation_.reversed_mass();
    if (before <= options_.reflected_mass) return;
    AlternatingMinimization trial = minimization_.another();
    trial.start(reflected_centres(), {});
    trial.run(observe_);
    const double after = adopt_if_better(trial);
    log("reflected a map that reversed {:.1f}% of the mass: now {:.1f}%", 100 * before, 100 * after);
}

void Ironing::Run::damp() {
    constexpr double progress = 0.95;  // of the least mass so far: less counts as a stall
    const double before = orientation_.reversed_mass();
    double least = before;
    int round = 0, stalled = 0;
    while (round < options_.maximum_rounds && stalled < options_.patience &&
           orientation_.reversed_mass() > options_.tolerated_mass) {
        minimization_.set_damping(Damping{damping(orientation_.A_to_B, options_.omega),
                                          damping(orientation_.B_to_A, options_.omega)});
        observe_(minimization_.step());
        orientation_ = measured();
        stalled = orientation_.reversed_mass() < progress * least ? 0 : stalled + 1;
        least = std::min(least, orientation_.reversed_mass());
        ++round;
    }
    if (round == 0) return;
    const double damped = orientation_.reversed_mass();
    minimization_.set_damping({});
    minimization_.run(observe_);
    orientation_ = measured();
    log("ironed {} rounds: {:.2f}% of the mass reversed before, {:.2f}% after, {:.2f}% with full weights",
        round, 100 * before, 100 * damped, 100 * orientation_.reversed_mass());
}

/// Where a trial starts with these parts placed anew.
Start Ironing::Run::reanchored(const ReversedParts& parts) const {
    const Solution& now = minimization_.solution();
    const Side &A = level_.A.side, &B = level_.B.side;
    Start start{now.step.centres,
                significant_entries(now.plan, A.mass, B.mass, minimization_.options().support_threshold)};
    const bool coarse = level_.A.level.kind == LevelKind::diffusion;
    const PairContext& context = ironing_.context_;
    const GraphedSide side_A{level_.A, coarse ? ironing_.sample_graphs_.A() : context.graph_A()};
    const GraphedSide side_B{level_.B, coarse ? ironing_.sample_graphs_.B() : context.graph_B()};
    for (const ReversedPart& part : parts.A) {
        const auto images = reanchored_images(part, orientation_.A_to_B, side_A, side_B);
        for (size_t n = 0; n < images.size(); ++n) {
            start.centres.row.row(part.samples[n]) = B.points.row(images[n]);
            start.kept[size_t(part.samples[n])].push_back(images[n]);
        }
    }
    for (const ReversedPart& part : parts.B) {
        const auto images = reanchored_images(part, orientation_.B_to_A, side_B, side_A);
        for (size_t n = 0; n < images.size(); ++n) {
            start.centres.column.row(part.samples[n]) = A.points.row(images[n]);
            start.kept[size_t(images[n])].push_back(part.samples[n]);
        }
    }
    return start;
}

void Ironing::Run::reanchor() {
    const ReversedParts parts{reversed_parts(level_.A, orientation_.A_to_B, options_.reanchored_mass),
                              reversed_parts(level_.B, orientation_.B_to_A, options_.reanchored_mass)};
    if (parts.empty()) return;
    const double before = orientation_.reversed_mass(), energy = minimization_.solution().step.energy;
    const Start start = reanchored(parts);
    AlternatingMinimization trial = minimization_.another();
    trial.start(start.centres, start.kept);
    trial.run(observe_);
    const double energy_after = trial.solution().step.energy;
    const double after = adopt_if_better(trial);
    log("placed {} and {} reversed parts anew: {:.2f}% of the mass reversed before, {:.2f}% after; energy "
        "{:.6g} before, {:.6g} after",
        parts.A.size(), parts.B.size(), 100 * before, 100 * after, energy, energy_after);
}

Ironing::Ironing(const PairContext& context, const IroningOptions& options)
    : context_(context),
      options_(options),
      oriented_A_(context.A().surface.mesh),
      oriented_B_(context.B().surface.mesh),
      sample_graphs_(context) {}

PairOrientation Ironing::measure(const LevelPair& level, const Solution& solution) const {
    const OrientedSide A{level.A, oriented_A_, context_.graph_A()},
        B{level.B, oriented_B_, context_.graph_B()};
    return {measure_orientation(A, B, solution.step.centres.row, largest_of_rows(solution.plan)),
            measure_orientation(B, A, solution.step.centres.column, largest_of_columns(solution.plan))};
}

std::optional<PairOrientation> Ironing::iron(const LevelPair& level, AlternatingMinimization& minimization,
                                             const Observer& observe) const {
    return iron(level, minimization, observe, options_);
}

std::optional<PairOrientation> Ironing::iron(const LevelPair& level, AlternatingMinimization& minimization,
                                             const Observer& observe, const IroningOptions& options) const {
    const int samples = int(std::min(level.A.level.samples.size(), level.B.level.samples.size()));
    if (!options.enabled || samples < options.minimum_samples || samples > options.maximum_samples) return {};
    Run run(*this, level, minimization, observe, options);
    if (samples <= options.reflected_samples) run.reflect();
    run.damp();
    run.reanchor();
    return run.take_orientation();
}

}  // namespace varimap
