#include "varimap/parts/missed_parts.h"

#include <algorithm>

#include "varimap/core/log.h"
#include "varimap/core/timing.h"
#include "varimap/mesh/interpolation.h"
#include "varimap/mesh/mass.h"
#include "varimap/mesh/topology.h"
#include "varimap/parts/strained_parts.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/relaxation/global_relaxation.h"
#include "varimap/sliding/face_energy.h"
#include "varimap/sliding/inverse_map.h"
#include "varimap/sliding/target_cells.h"

namespace varimap {

namespace {

/// Chosen by hand on maps that had lost a limb, which enter .67 to .9 of the area that disagreed, and on a
/// list of 36, where the directions are two different maps on some pairs: these enter .04 to .48 of it.
constexpr double elsewhere = 0.05, least_won_area = 0.004, gained_share = 0.5;
constexpr int rings_replaced = 2, rings_relaxed = 3, rings_taken = 4;
constexpr int missed_global_steps = 10, missed_fold_sweeps = 60;
constexpr double missed_fold_visits = 60;  ///< of the vertices that move, in the mean
constexpr double least_step_gain =
    1e-3;  ///< share of the energy that a step must win to be followed by another

/// Where the way there and back leads from a vertex; itself where it ends nowhere.
Vec3 there_and_back(const SlidingMap& map, const PointMap& back, int v) {
    const StraightImage end = straight_image(map.point(v), back, map.target(), map.source());
    return end.is_whole ? end.place : map.source().vertex(v);
}

VertexData<bool> vertices_elsewhere(const SlidingMap& map, const PointMap& back) {
    VertexData<bool> marks(map.source().vertex_count());
    for (int v = 0; v < marks.size(); ++v)
        marks[v] =
            map.has_image(v) && (there_and_back(map, back, v) - map.source().vertex(v)).norm() > elsewhere;
    return marks;
}

void widen(VertexData<bool>& marks, const TriangleMesh& mesh, int rings) {
    for (int ring = 0; ring < rings; ++ring) {
        VertexData<bool> wider = marks;
        for (int f = 0; f < mesh.face_count(); ++f)
            if (marked_corners(mesh, f, marks) > 0) mark_corners(mesh, f, wider);
        marks = std::move(wider);
    }
}

double area_of(const VertexData<bool>& marks, const TriangleMesh& mesh) {
    const Eigen::VectorXd mass = voronoi_masses(mesh);
    double sum = 0;
    for (int v = 0; v < marks.size(); ++v)
        if (marks[v]) sum += mass[v];
    return sum / mass.sum();
}

/// The marked vertices that may move.
VertexData<bool> movable(VertexData<bool> marks, const VertexData<bool>& fixed) {
    for (int v = 0; v < marks.size(); ++v) marks[v] = marks[v] && !fixed[v];
    return marks;
}

void relax(SlidingMap& map, const VertexData<bool>& held, const std::vector<SoftConstraint>& constraints) {
    const double moving = double(std::count(held.begin(), held.end(), 0)) / count_used_vertices(map.source());
    const FoldRemoval remove_folds{missed_fold_sweeps, missed_fold_visits * moving};
    remove_folds(map, held);
    GlobalRelaxation global(map, held);
    global.set_constraints(constraints);
    for (int step = 0; step < missed_global_steps; ++step)
        if (global.step(RobustEnergy(judged_energy, 1)) < least_step_gain) break;
    remove_folds(map, held);
}

}  // namespace

void take_from_other_direction(SlidingMap& map, const PointMap& back, VertexData<bool> open,
                               const VertexData<bool>& fixed) {
    const VertexData<bool> led_astray = vertices_elsewhere(map, back);
    for (int v = 0; v < open.size(); ++v) open[v] = open[v] || led_astray[v];
    widen(open, map.source(), rings_taken);
    InverseMap(map, back).place(map, movable(std::move(open), fixed));
}

bool recover_missed_parts(SlidingMap& map, const PointMap& back, const VertexData<bool>& fixed,
                          const std::vector<SoftConstraint>& landmarks, double inverse_weight) {
    VertexData<bool> open = vertices_elsewhere(map, back);
    const double disagreeing = area_of(open, map.source());
    if (disagreeing < least_won_area) return false;
    const Timer timer("missed parts");
    const TargetCells cells(map, GeodesicGraph(map.target()), usual_cell_radius(map));
    const std::vector<char> before = cells.occupied(map.points());
    const PointMap kept = map.points();
    widen(open, map.source(), rings_replaced);
    InverseMap(map, back).place(map, movable(open, fixed));
    widen(open, map.source(), rings_relaxed);
    VertexData<bool> held = movable(open, fixed);
    for (int v = 0; v < held.size(); ++v) held[v] = !held[v];
    std::vector<SoftConstraint> constraints = inverse_constraints(map, back, inverse_weight);
    constraints.insert(constraints.end(), landmarks.begin(), landmarks.end());
    relax(map, held, constraints);
    const std::vector<char> after = cells.occupied(map.points());
    const double gain = cells.lost_area(after, before) - cells.lost_area(before, after);
    if (gain >= std::max(least_won_area, gained_share * disagreeing)) {
        log("images taken from the other direction enter {:.1f}% more of the other surface", 100 * gain);
        return true;
    }
    map.restore(kept);
    return false;
}

}  // namespace varimap
