#include "varimap/map_repair/chart_repair.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "varimap/core/index_set.h"
#include "varimap/core/timing.h"
#include "varimap/geodesics/triangle_strip.h"
#include "varimap/mesh/boundary.h"
#include "varimap/relaxation/global_relaxation.h"
#include "varimap/relaxation/local_relaxation.h"
#include "varimap/sliding/face_energy.h"

namespace varimap {

namespace {

// Chosen by hand on pairs of people, cats and four-legged animals. The smallest discs once more, for what is
// left of larger ones.
constexpr std::array<int, 10> ring_counts{2, 3, 4, 5, 6, 8, 10, 13, 2, 4};
/// Share of the faces of either surface in a disc. A head of fine faces has a fifth of them: with 0.2, 23
/// pairs of animals end with 1045 faces reversed, with 0.3 and 0.4 with 233 and 231.
constexpr double largest_disc = 0.4;
constexpr int least_part = 1000;    ///< faces that a disc may have in any case
constexpr double most_filled = 10;  ///< times the faces around defects that a disc may have besides
/// Faces in discs that are tried, by all the faces, or so many of them if there are more: bounds the time. A
/// map of a large mesh has few defects, or is torn beyond repair.
constexpr double most_tried = 3;
constexpr int most_counted = 20'000;
/// Faces of a cluster around which the rings are as wide as that. Tried: none, 200, 100; of a pair of 320,000
/// vertices 337, 31 and 19 faces end reversed, of 14 pairs of 5,000 to 14,000 25, 34 and 60.
constexpr double usual_cluster = 200;
constexpr int polish_sweeps = 15;
constexpr int careful_polish_sweeps = 6;
constexpr int most_with_care = 200;  ///< vertices
/// For a part of more vertices than that which was mapped anew: its layouts are far from an isometry, and
/// local sweeps hardly move it along. With these steps errors of two halves of a set of animals are .993 and
/// .998 times those without, of gorillas and people .982. They may spoil this share of what was repaired:
/// with .3 errors of 23 pairs are another .994 times, but a sixth more faces end reversed.
constexpr int global_chart_steps = 8;
constexpr double least_chart_gain = 1e-4;
constexpr double may_spoil = 0.1;
const RobustEnergy global_energy({1, 0.1}, 0);
/// Faults more than the badness to beat, from which on faces that cut through the target are not looked
/// after. Of 607 such looks on six pairs, those beyond took six tenths of the time, and mended 22 of 166
/// parts.
constexpr double within_reach = 8;
constexpr int attempts_without_gain = 3;  ///< after which defects are left as they are
constexpr int rings_of_kernels = 2;       ///< around defects, where vertices may be moved one by one
/// Faces of a cluster in which that is tried: tangles of a large mesh take long, and gain nothing.
constexpr std::ptrdiff_t most_for_kernels = 1000;
const FoldEnergy polish_energy{1, 0.03};

/// As many for a small cluster, for a larger one as many more as it is wider.
int rings_around(const std::vector<int>& cluster, int rings) {
    return int(std::lround(rings * std::sqrt(std::max(1.0, double(cluster.size()) / usual_cluster))));
}

/// Of a disc on `mesh` that has to hold a part with so many faces: what is much larger is the outside of its
/// rim, and would be walked over in vain.
int most_disc_faces(const TriangleMesh& mesh, double part) {
    const int most = std::max(least_part, int(largest_disc * mesh.face_count()));
    return std::min(most, least_part + int(most_filled * part));
}

/// Whether a repair strains a body of a few large faces, between which shortest paths may run on the other
/// side of a corner, so that faces of a right map seem reversed: a prism of eight triangles on itself had 57
/// times the energy after it. Those of five pairs of fine meshes touch .07 of the area at most.
bool strains_a_body(double area, double energy_before, double energy_after) {
    constexpr double large = 0.2, much = 2;
    return area > large && energy_after > much * energy_before;
}

}  // namespace

ChartRepair::ChartRepair(SlidingMap& map, AlongTarget& along_target, NormalAgreement& agreement,
                         const PointMap& back, const ReliefAgreement* relief)
    : map_(map),
      along_target_(along_target),
      agreement_(agreement),
      relief_(relief),
      inverse_(map, back),
      kernels_(map, along_target),
      guard_(map),
      source_(map.source(), along_target.source_edges()),
      target_(map.target(), along_target.target_edges()),
      on_boundary_(boundary_vertices(map.source(), source_.edges())),
      strikes_(map.source().face_count(), 0) {}

double ChartRepair::faults(const std::vector<int>& faces, double limit) {
    // That a face cuts through the target is worth less than that it is reversed.
    constexpr double reversed = 4, branch = 12;
    double sum = 0;
    for (std::size_t i = 0; i < faces.size() && sum < limit; ++i)
        sum += reversed * along_target_.is_reversed(faces[i]);
    const std::vector<int> vertices = vertices_of(map_.source(), faces);
    for (std::size_t i = 0; i < vertices.size() && sum < limit; ++i)
        sum += branch * along_target_.is_branch_point(vertices[i]);
    return sum;
}

double ChartRepair::badness(const std::vector<int>& faces, double limit) {
    const double sum = faults(faces, limit);
    return sum < limit ? sum + double(agreement_.disagreeing_among(faces).size()) : sum;
}

ChartRepair::State ChartRepair::state(const std::vector<int>& faces) {
    return {badness(faces), guard_.crushed_share(faces)};
}

bool ChartRepair::is_better(const std::vector<int>& faces, const State& before) {
    return guard_.allows(faces, before.crushed) && badness(faces, before.badness) < before.badness;
}

bool ChartRepair::is_better(const std::vector<int>& faces, const State& before, const ChartedPart& part,
                            const PointMap& kept) {
    return badness(faces, before.badness) < before.badness &&
           (guard_.allows(faces, before.crushed) || guard_.had_no_partner(part.faces(), kept));
}

std::vector<int> ChartRepair::enclosed_on_target(const SubMesh& part, const std::vector<int>& rim) {
    const auto face = [&](std::size_t i) {
        return map_.point(part.vertex[std::size_t(rim[i % rim.size()])]).face;
    };
    const double finer = double(map_.target().face_count()) / map_.source().face_count();
    const int most = most_disc_faces(map_.target(), finer * part.mesh.face_count());
    std::vector<int> wall, inside;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        if (face(i) < 0 || face(i + 1) < 0) return {};
        const auto way = find_strip(map_.target(), target_.edges(), face(i), face(i + 1), most).faces;
        if (way.empty()) return {};
        wall.insert(wall.end(), way.begin(), way.end());
    }
    make_set(wall);
    for (const int v : part.vertex)
        if (map_.has_image(v)) inside.push_back(map_.point(v).face);
    make_set(inside);
    std::vector<int> disc =
        target_.filled(target_.widened(target_.enclosed(std::move(wall), inside, most), 1), most);
    return int(disc.size()) > 2 * most ? std::vector<int>() : disc;
}

VertexData<bool> ChartRepair::all_but(const std::vector<int>& vertices) const {
    VertexData<bool> marks(map_.source().vertex_count(), true);
    for (const int v : vertices) marks[v] = false;
    return marks;
}

void ChartRepair::polish(std::vector<int> vertices) {
    LocalRelaxation local(map_, 7);
    for (int i = 0; i < polish_sweeps; ++i) local.sweep(vertices, polish_energy);
}

void ChartRepair::relax(const std::vector<int>& vertices, const std::vector<int>& around, double most) {
    const PointMap kept = map_.points_of(vertices);
    GlobalRelaxation global(map_, all_but(vertices), relief_);
    LocalRelaxation local(map_, 7);
    std::vector<int> shuffled = vertices;
    for (int i = 0; i < global_chart_steps; ++i) {
        const double gain = global.step(global_energy);
        local.sweep(shuffled, global_energy.energy);
        if (gain < least_chart_gain) break;
    }
    if (badness(around) > most) map_.place(vertices, kept);
}

void ChartRepair::polish_with_care(const std::vector<int>& vertices) {
    LocalRelaxation local(map_, 7);
    std::vector<int> one(1);
    for (int i = 0; i < careful_polish_sweeps; ++i)
        for (const int v : vertices) {
            const SurfacePoint point = map_.point(v);
            const auto faults = along_target_.faults_around(v);
            one[0] = v;
            local.sweep(one, polish_energy);
            if (map_.point(v).face == point.face && map_.point(v).barycentric == point.barycentric) continue;
            if (along_target_.faults_around(v).more_than(faults)) map_.place(v, point);
        }
}

std::vector<int> ChartRepair::disc_around(const std::vector<int>& cluster, int rings) {
    std::vector<int> faces = source_.widened(cluster, rings);
    const int most = most_disc_faces(map_.source(), double(faces.size()));
    faces = source_.filled(std::move(faces), most);
    return int(faces.size()) > most ? std::vector<int>() : faces;
}

ChartRepair::Outcome ChartRepair::attempt(std::vector<int> faces, const std::vector<int>& around,
                                          const VertexData<bool>& fixed) {
    const State before = state(around);
    if (adopt_inverse(faces, around, before, fixed)) return Outcome::inverted;
    SubMesh disc(map_.source(), std::move(faces));
    std::vector<int> rim = disc_boundary(disc.mesh);
    if (rim.empty()) return Outcome::no_disc;
    std::vector<int> goal = enclosed_on_target(disc, rim);
    const ChartedPart part(map_, std::move(disc), std::move(rim), std::move(goal));
    if (!part.are_discs()) return Outcome::no_disc;
    if (!part.has_simple_rim()) return Outcome::no_simple_rim;
    const PointMap unfolded = part.unfolded(map_, fixed);
    if (unfolded.empty()) return Outcome::folded;

    const PointMap kept = map_.points_of(part.vertices());
    const std::vector<int> free = part.free_vertices(fixed);
    map_.place(part.vertices(), unfolded);
    polish(free);
    if (is_better(around, before, part, kept)) {
        if (int(free.size()) > most_with_care) {
            const double after = badness(around);
            relax(free, around, after + may_spoil * (before.badness - after));
        }
        return Outcome::repaired;
    }
    const double most = before.badness + within_reach;
    if (faults(around, most) < most) {
        agreement_.improve(agreement_.disagreeing_among(part.faces()), all_but(free));
        if (is_better(around, before, part, kept)) return Outcome::repaired;
    }
    if (int(free.size()) <= most_with_care) {
        map_.place(part.vertices(), unfolded);
        polish_with_care(free);
        if (is_better(around, before, part, kept)) return Outcome::repaired;
    }
    map_.place(part.vertices(), kept);
    return Outcome::no_gain;
}

std::vector<int> ChartRepair::free_within(const std::vector<int>& faces, const VertexData<bool>& fixed) {
    const std::vector<int> wide = source_.widened(faces, 1), inside = vertices_of(map_.source(), faces);
    std::vector<int> beyond, free;
    std::set_difference(wide.begin(), wide.end(), faces.begin(), faces.end(), std::back_inserter(beyond));
    const std::vector<int> outside = vertices_of(map_.source(), beyond);
    std::set_difference(inside.begin(), inside.end(), outside.begin(), outside.end(),
                        std::back_inserter(free));
    std::erase_if(free, [&](int v) { return fixed[v] || on_boundary_[v] || !map_.has_image(v); });
    return free;
}

bool ChartRepair::adopt_inverse(const std::vector<int>& faces, const std::vector<int>& around,
                                const State& before, const VertexData<bool>& fixed) {
    const std::vector<int> free = free_within(faces, fixed);
    const PointMap kept = map_.points_of(free);
    for (const int v : free)
        if (const SurfacePoint image = inverse_(v); image.face >= 0) map_.place(v, image);
    polish(free);
    if (is_better(around, before)) return true;
    map_.place(free, kept);
    return false;
}

std::vector<std::vector<int>> ChartRepair::clusters_of(const std::vector<int>& defects) {
    std::vector<char> marks(std::size_t(map_.source().face_count()), 0);
    for (const int f : source_.widened(defects, 1)) marks[std::size_t(f)] = 1;
    return face_components(source_.edges(), std::move(marks));
}

std::vector<std::vector<int>> ChartRepair::promising_clusters_of(const std::vector<int>& defects) {
    std::vector<std::vector<int>> clusters = clusters_of(defects);
    std::erase_if(clusters, [&](const std::vector<int>& cluster) {
        return std::any_of(cluster.begin(), cluster.end(),
                           [&](int f) { return strikes_[f] >= attempts_without_gain; });
    });
    return clusters;
}

std::vector<int> ChartRepair::operator()(const VertexData<bool>& fixed) {
    const Timer timer("repair in charts");
    std::vector<int> defects = along_target_.faulty_faces(), touched, all_touched;
    double budget = most_tried * std::min(map_.source().face_count(), most_counted);
    for (const int rings : ring_counts) {
        touched.clear();
        for (const std::vector<int>& cluster : promising_clusters_of(defects)) {
            std::vector<int> faces = disc_around(cluster, rings_around(cluster, rings));
            const std::vector<int> around = source_.widened(faces, 2);
            if (faces.empty() || double(around.size()) > budget) {
                // What is left of it, or a smaller disc, may do.
                touched.insert(touched.end(), cluster.begin(), cluster.end());
                ++report_.outcomes[std::size_t(Outcome::no_disc)];
                continue;
            }
            budget -= double(around.size());
            touched.insert(touched.end(), around.begin(), around.end());
            const Outcome outcome = attempt(std::move(faces), around, fixed);
            ++report_.outcomes[std::size_t(outcome)];
            if (outcome == Outcome::repaired || outcome == Outcome::inverted)
                for (const int f : around) strikes_[f] = 0;
            else if (outcome == Outcome::no_gain || outcome == Outcome::folded)
                for (const int f : cluster) ++strikes_[f];
        }
        if (touched.empty()) break;
        make_set(touched);
        all_touched.insert(all_touched.end(), touched.begin(), touched.end());
        defects = along_target_.faulty_among(touched);
    }
    make_set(all_touched);
    return all_touched;
}

std::vector<int> ChartRepair::centre_stars(const VertexData<bool>& fixed) {
    const Timer timer("kernels of stars");
    std::vector<int> touched;
    for (std::vector<int> cluster : clusters_of(along_target_.faulty_faces())) {
        if (std::ssize(cluster) > most_for_kernels) continue;
        const std::vector<int> faces = source_.widened(cluster, rings_of_kernels),
                               around = source_.widened(faces, 1), free = free_within(faces, fixed);
        const PointMap kept = map_.points_of(free);
        const double before = badness(around), strain = total_energy(map_, around, judged_energy);
        std::erase_if(cluster, [&](int f) { return !along_target_.is_reversed(f); });
        kernels_.centre(cluster, free);
        if (!strains_a_body(area_of(map_, around), strain, total_energy(map_, around, judged_energy)) &&
            badness(around, before) < before)
            touched.insert(touched.end(), around.begin(), around.end());
        else
            map_.place(free, kept);
    }
    make_set(touched);
    return touched;
}

}  // namespace varimap
