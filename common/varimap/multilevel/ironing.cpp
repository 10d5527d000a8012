#include "varimap/multilevel/ironing.h"

#include "varimap/core/log.h"
#include "varimap/mesh/ray_mesh.h"
#include "varimap/multilevel/reanchoring.h"

namespace varimap {

namespace {

/// Per line (row or column) of a plan: the other side's vertex of the largest entry. `entry(e)` gives an
/// entry's value and its sample on the other side.
template <class Entry>
std::vector<int> best_vertices(const std::vector<int>& begin, const std::vector<int>& other_samples,
                               const Entry& entry) {
    std::vector<int> best(begin.size() - 1, other_samples[0]);
    for (size_t line = 0; line < best.size(); ++line) {
        double largest = -1;
        for (int e = begin[line]; e < begin[line + 1]; ++e)
            if (const auto [value, sample] = entry(e); value > largest)
                largest = value, best[line] = other_samples[sample];
    }
    return best;
}

std::vector<int> best_of_rows(const Coupling& plan, const std::vector<int>& column_samples) {
    return best_vertices(plan.support.row_begin, column_samples,
                         [&](int e) { return std::pair(plan.value[e], plan.support.column[e]); });
}

std::vector<int> best_of_columns(const Coupling& plan, const std::vector<int>& row_samples) {
    return best_vertices(plan.support.column_begin, row_samples, [&](int e) {
        return std::pair(plan.value[plan.support.by_row[e]], plan.support.row[e]);
    });
}

/// Where the inward normal of a vertex leaves the surface on the other side: the nearest vertex there.
class Antipodes {
  public:
    explicit Antipodes(const TriangleMesh& mesh) : mesh_(mesh), normals_(vertex_normals(mesh)), rays_(mesh) {}

    int of(int vertex) const {
        constexpr double lift = 1e-4;  // units of sqrt(area): past the faces around the vertex itself
        const Vec3 inward = -normals_.row(vertex).transpose();
        const SurfacePoint hit = rays_.first_hit(mesh_.vertex(vertex) + lift * inward, inward);
        if (hit.face < 0) return vertex;
        int corner;
        hit.barycentric.maxCoeff(&corner);
        return mesh_.faces(hit.face, corner);
    }

  private:
    const TriangleMesh& mesh_;
    Points normals_;
    RayMesh rays_;
};

SparseMatrix damped(const SparseMatrix& weights, const Orientation& orientation, double omega) {
    Eigen::VectorXd factor(weights.cols());
    for (int i = 0; i < factor.size(); ++i) factor[i] = orientation.determinant[i] < 0 ? omega : 1.0;
    return weights * factor.asDiagonal();
}

}  // namespace

Ironing::Ironing(const PairContext& context, LevelPair& pair, const IroningOptions& options)
    : context_(context),
      pair_(pair),
      options_(options),
      oriented_A_(context.A().surface.mesh),
      oriented_B_(context.B().surface.mesh) {}

PairOrientation Ironing::measure(const Solution& solution) const {
    return {
        measure_orientation(pair_.A, oriented_A_, pair_.B, oriented_B_, context_.graph_B(),
                            solution.step.centres.row, best_of_rows(solution.plan, pair_.B.level.samples)),
        measure_orientation(pair_.B, oriented_B_, pair_.A, oriented_A_, context_.graph_A(),
                            solution.step.centres.column,
                            best_of_columns(solution.plan, pair_.A.level.samples))};
}

Centres Ironing::reflected_centres(const PairOrientation& orientation, const Centres& centres) const {
    // g = antipode . f and g^-1 = f^-1 . antipode.
    const Antipodes antipodes(context_.B().surface.mesh);
    Centres reflected = centres;
    for (Eigen::Index k = 0; k < centres.row.rows(); ++k)
        reflected.row.row(k) = pair_.B.vertex_points.row(antipodes.of(orientation.A_to_B.image_vertex[k]));
    for (Eigen::Index l = 0; l < centres.column.rows(); ++l) {
        const int opposite = antipodes.of(pair_.B.level.samples[l]);
        reflected.column.row(l) = centres.column.row(pair_.B.level.cell[opposite]);
    }
    reflected.row = pair_.A.side.averaging * reflected.row;
    reflected.column = pair_.B.side.averaging * reflected.column;
    pull_landmarks(pair_.A.side, pair_.B.side, reflected);
    return reflected;
}

void Ironing::reflect(AlternatingMinimization& minimization,
                      const std::function<void(const Alternation&)>& observe) {
    const PairOrientation before = measure(minimization.solution());
    if (before.reversed_mass() <= options_.reflected_mass) return;
    AlternatingMinimization trial(pair_.A.side, pair_.B.side, minimization.options());
    trial.start(reflected_centres(before, minimization.solution().step.centres), {});
    trial.run(observe);
    const double after = measure(trial.solution()).reversed_mass();
    log("reflected a map that reversed {:.1f}% of the mass: now {:.1f}%", 100 * before.reversed_mass(),
        100 * after);
    if (after < before.reversed_mass()) minimization.adopt(trial.take_solution());
}

void Ironing::set_weights(const PairOrientation& orientation) {
    pair_.A.side.averaging = averaging_operator(
        damped(pair_.A.side.weights, orientation.A_to_B, options_.omega), pair_.A.side.mass);
    pair_.B.side.averaging = averaging_operator(
        damped(pair_.B.side.weights, orientation.B_to_A, options_.omega), pair_.B.side.mass);
}

void Ironing::restore_weights() {
    pair_.A.side.averaging = averaging_operator(pair_.A.side.weights, pair_.A.side.mass);
    pair_.B.side.averaging = averaging_operator(pair_.B.side.weights, pair_.B.side.mass);
}

void Ironing::damp(AlternatingMinimization& minimization,
                   const std::function<void(const Alternation&)>& observe) {
    PairOrientation orientation = measure(minimization.solution());
    const double before = orientation.reversed_mass();
    double least = before;
    int round = 0, stalled = 0;
    while (round < options_.maximum_rounds && stalled < options_.patience &&
           orientation.reversed_mass() > options_.tolerated_mass) {
        set_weights(orientation);
        observe(minimization.step());
        orientation = measure(minimization.solution());
        stalled = orientation.reversed_mass() < 0.95 * least ? 0 : stalled + 1;
        least = std::min(least, orientation.reversed_mass());
        ++round;
    }
    if (round == 0) return;
    restore_weights();
    minimization.run(observe);
    log("ironed {} rounds: {:.2f}% of the mass reversed before, {:.2f}% after, {:.2f}% with full weights",
        round, 100 * before, 100 * orientation.reversed_mass(),
        100 * measure(minimization.solution()).reversed_mass());
}

void Ironing::reanchor(AlternatingMinimization& minimization,
                       const std::function<void(const Alternation&)>& observe) {
    const PairOrientation before = measure(minimization.solution());
    const auto parts_A = reversed_parts(pair_.A, before.A_to_B, options_.reanchored_mass);
    const auto parts_B = reversed_parts(pair_.B, before.B_to_A, options_.reanchored_mass);
    if (parts_A.empty() && parts_B.empty()) return;

    const Solution& now = minimization.solution();
    Centres centres = now.step.centres;
    KeptEntries kept = significant_entries(now.plan, pair_.A.side.mass, pair_.B.side.mass,
                                           minimization.options().support_threshold);
    const bool coarse = pair_.A.level.kind == LevelKind::diffusion;
    const GeodesicGraph& graph_A = coarse ? context_.sample_graph_A() : context_.graph_A();
    const GeodesicGraph& graph_B = coarse ? context_.sample_graph_B() : context_.graph_B();
    for (const ReversedPart& part : parts_A) {
        const auto images = reanchored_images(part, pair_.A, before.A_to_B, graph_A, pair_.B, graph_B);
        for (size_t n = 0; n < images.size(); ++n) {
            centres.row.row(part.samples[n]) = pair_.B.side.points.row(images[n]);
            kept[part.samples[n]].push_back(images[n]);
        }
    }
    for (const ReversedPart& part : parts_B) {
        const auto images = reanchored_images(part, pair_.B, before.B_to_A, graph_B, pair_.A, graph_A);
        for (size_t n = 0; n < images.size(); ++n) {
            centres.column.row(part.samples[n]) = pair_.A.side.points.row(images[n]);
            kept[images[n]].push_back(part.samples[n]);
        }
    }
    pull_landmarks(pair_.A.side, pair_.B.side, centres);

    AlternatingMinimization trial(pair_.A.side, pair_.B.side, minimization.options());
    trial.start(centres, kept);
    trial.run(observe);
    const double after = measure(trial.solution()).reversed_mass();
    log("placed {} and {} reversed parts anew: {:.2f}% of the mass reversed before, {:.2f}% after; energy "
        "{:.6g} before, "
        "{:.6g} after",
        parts_A.size(), parts_B.size(), 100 * before.reversed_mass(), 100 * after, now.step.energy,
        trial.solution().step.energy);
    if (after < before.reversed_mass()) minimization.adopt(trial.take_solution());
}

void Ironing::iron(AlternatingMinimization& minimization,
                   const std::function<void(const Alternation&)>& observe) {
    const int samples = int(std::min(pair_.A.level.samples.size(), pair_.B.level.samples.size()));
    if (!options_.enabled || samples < options_.minimum_samples || samples > options_.maximum_samples) return;
    if (samples <= options_.reflected_samples) reflect(minimization, observe);
    damp(minimization, observe);
    reanchor(minimization, observe);
}

}  // namespace varimap
