#include "varimap/map_repair/normal_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "varimap/core/index_set.h"
#include "varimap/core/timing.h"
#include "varimap/relaxation/fold_removal.h"
#include "varimap/sliding/face_energy.h"

namespace varimap {

namespace {

constexpr int most_searches = 4;  ///< of a vertex. Measured at 80'000: 12 leave 59 faces of 303, 4 leave 63
constexpr int directions = 12;
constexpr std::array<double, 5> radii{0.1, 0.3, 0.7, 1.3, 2.2};  ///< in mean edges of the vertex's image
constexpr double disagreement = 10;                              ///< cost per area
constexpr double reversal = 100;                                 ///< cost per face: above all else
const RobustEnergy energy{{1, 0.03}, 0.3};

const std::array<Vec3, 7> inner_points{Vec3(1, 1, 1) / 3,  Vec3(.7, .15, .15),  Vec3(.15, .7, .15),
                                       Vec3(.15, .15, .7), Vec3(.08, .46, .46), Vec3(.46, .08, .46),
                                       Vec3(.46, .46, .08)};

}  // namespace

NormalAgreement::NormalAgreement(SlidingMap& map, AlongTarget& along_target)
    : map_(map), along_target_(along_target), closest_(map.target()), disagreement_(map) {}

bool NormalAgreement::disagrees(int f) const {
    const auto c = map_.source().faces.row(f);
    const Vec3 &x = map_.image(c[0]), &y = map_.image(c[1]), &z = map_.image(c[2]);
    const Vec3 normal = map_.chord_normal(f);
    if (along_target_.lies_within_a_star(f, normal)) return false;
    Vec3 below = Vec3::Zero();
    std::size_t left = inner_points.size();
    int face = map_.point(c[0]).face;
    for (const Vec3& b : inner_points) {
        face = closest_(b[0] * x + b[1] * y + b[2] * z, face).point.face;
        below += face_normal(map_.target(), face).normalized();
        // Each of those left adds a vector of length 1 at most.
        const double most = double(--left) * (1 + 1e-9) * normal.norm();
        if (normal.dot(below) > most) return false;
        if (normal.dot(below) < -most) return true;
    }
    return !(normal.dot(below) > 0);
}

std::vector<int> NormalAgreement::disagreeing_among(const std::vector<int>& faces) {
    const auto judge = [&](int f) {
        return map_.is_mapped(f) && (map_.image_triangle(f).D <= 0 || disagrees(f));
    };
    return faces_where(faces, [&](int f) { return disagreement_(f, judge); });
}

std::vector<int> NormalAgreement::disagreeing_faces() {
    const Timer timer("normals");
    return disagreeing_among(all_indices(map_.source().face_count()));
}

double NormalAgreement::strain(int v) const {
    double sum = 0;
    for (const int f : map_.faces_of_vertex()[v]) {
        if (!map_.is_mapped(f)) continue;
        sum += face_energy(map_, f, energy);
        if (map_.image_triangle(f).D <= FoldRemoval::flat_limit) sum += reversal;
    }
    return sum;
}

double NormalAgreement::with_disagreement(double cost, int v, double limit) const {
    for (const int f : map_.faces_of_vertex()[v]) {
        if (cost >= limit) break;  // what follows asks for many closest points
        if (map_.is_mapped(f) && disagrees(f)) cost += map_.rest(f).area * disagreement;
    }
    return cost;
}

double NormalAgreement::mean_edge(int v) const {
    double sum = 0;
    int count = 0;
    for (const int f : map_.faces_of_vertex()[v])
        for (int k = 0; k < 3; ++k)
            if (const int u = map_.source().faces(f, k); u != v && map_.has_image(u))
                sum += (map_.image(u) - map_.image(v)).norm(), ++count;
    return count == 0 ? 0 : sum / count;
}

std::vector<NormalAgreement::Place> NormalAgreement::places_around(int v, double size) {
    const SurfacePoint start = map_.point(v);
    const auto frame = map_.tangents(v);
    std::vector<Place> places;
    for (const double radius : radii)
        for (int i = 0; i < directions; ++i) {
            const double angle = 2 * std::numbers::pi * i / directions;
            const Vec3 step =
                radius * size * (std::cos(angle) * frame.col(0) + std::sin(angle) * frame.col(1));
            map_.place(v, map_.walk(start, step));
            places.push_back({strain(v), map_.point(v)});
        }
    map_.place(v, start);
    // Of the least strained first, what the others disagree about is never asked.
    std::stable_sort(places.begin(), places.end(),
                     [](const Place& a, const Place& b) { return a.strain < b.strain; });
    return places;
}

bool NormalAgreement::search(int v) {
    const double size = mean_edge(v);
    if (size == 0) return false;
    const SurfacePoint start = map_.point(v);
    SurfacePoint best = start;
    const double before = with_disagreement(strain(v), v, std::numeric_limits<double>::infinity());
    double least = before;
    for (const Place& place : places_around(v, size)) {
        if (place.strain >= least) break;
        map_.place(v, place.point);
        if (const double c = with_disagreement(place.strain, v, least); c < least)
            least = c, best = place.point;
    }
    map_.place(v, start);
    if (!(least < before)) return false;
    const auto faults = along_target_.faults_around(v);
    map_.place(v, best);
    if (!along_target_.faults_around(v).more_than(faults)) return true;
    map_.place(v, start);
    return false;
}

std::vector<int> NormalAgreement::improve(std::vector<int> disagreeing, const VertexData<bool>& fixed) {
    const Timer timer("normals");
    VertexData<int> searches(map_.source().vertex_count(), 0);
    while (!disagreeing.empty()) {
        std::vector<int> vertices;
        for (const int f : disagreeing)
            for (int k = 0; k < 3; ++k)
                if (const int v = map_.source().faces(f, k); !fixed[v] && searches[v] < most_searches)
                    vertices.push_back(v);
        make_set(vertices);
        for (const int v : vertices) ++searches[v];
        bool moved = false;
        for (const int v : vertices) moved = search(v) || moved;
        if (!moved) break;
        // Only faces around what moved can have changed.
        std::vector<int> faces = map_.faces_around(vertices);
        faces.insert(faces.end(), disagreeing.begin(), disagreeing.end());
        make_set(faces);
        disagreeing = disagreeing_among(faces);
    }
    return disagreeing;
}

}  // namespace varimap
