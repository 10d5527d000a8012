#include "stages/generate/body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stages/generate/level_set.h"
#include "varimap/mesh/coarsening.h"
#include "varimap/mesh/topology.h"

namespace varimap::shapes {

namespace {

constexpr double blend = 0.06;  ///< width of the transition between parts

/// On a grid of that cell, turned.
TriangleMesh grid_mesh(const Body& body, double cell, const Eigen::Matrix3d& turn) {
    Eigen::AlignedBox3d box;
    for (const Limb& limb : body.limbs())
        for (const auto& [end, radius] : {std::pair(limb.a, limb.ra), std::pair(limb.b, limb.rb)}) {
            const Vec3 margin = Vec3::Constant(radius + 0.3);
            box.extend(turn * end - margin).extend(turn * end + margin);
        }
    const BodyDistance distance(body);
    TriangleMesh mesh =
        level_set([&](const Vec3& p) { return distance(turn.transpose() * p); }, box.min(), box.max(), cell);
    mesh.vertices *= turn;  // rows: by the inverse
    return mesh;
}

/// The cell of a grid that gives about so many vertices.
double cell_for(const Body& body, int vertices, const Eigen::Matrix3d& turn) {
    constexpr double coarse = 0.1;
    return coarse * std::sqrt(double(grid_mesh(body, coarse, turn).vertex_count()) / vertices);
}

double thinnest(const Body& body) {
    double radius = std::numeric_limits<double>::infinity();
    for (const Limb& limb : body.limbs())
        if (!limb.missing) radius = std::min({radius, limb.ra, limb.rb});
    return radius;
}

bool is_sphere(const TriangleMesh& mesh) {
    return is_closed(mesh) && connected_components(mesh).count == 1 && summarise_topology(mesh).genus == 0;
}

}  // namespace

Part unbent(std::vector<Limb> limbs) {
    return {std::move(limbs), {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 0, 1, 0}};
}

double BodyDistance::operator()(const Vec3& p) const {
    double distance = smooth_distance(limbs_, p);
    for (const Ripple& ripple : relief_)
        distance -= ripple.height * std::sin(ripple.wave.dot(p) + ripple.phase);
    return distance;
}

std::vector<Limb> Body::limbs() const {
    std::vector<Limb> all;
    for (const Part& part : parts) all.insert(all.end(), part.limbs.begin(), part.limbs.end());
    return all;
}

Vec3 Body::posed(const Vec3& p) const {
    Vec3 moved = Vec3::Zero();
    double sum = 0;
    for (const Part& part : parts) {
        const double weight = std::exp(-smooth_distance(part.limbs, p) / blend);
        moved += weight * part.bend.forward(p);
        sum += weight;
    }
    return bend.forward(moved / sum);
}

TriangleMesh Body::mesh(int vertices, const Eigen::Matrix3d& turn) const {
    return grid_mesh(*this, cell_for(*this, vertices, turn), turn);
}

std::optional<TriangleMesh> Body::sphere_mesh(int vertices, const Eigen::Matrix3d& turn) const {
    const double finest = cell_for(*this, 2 * vertices, turn);
    const TriangleMesh fine = grid_mesh(*this, std::min(finest, 0.7 * thinnest(*this)), turn);
    if (!is_sphere(fine)) return std::nullopt;
    return coarsen(fine, vertices).mesh;
}

}  // namespace varimap::shapes
