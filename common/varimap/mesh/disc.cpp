#include "varimap/mesh/disc.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "varimap/core/index_set.h"
#include "varimap/core/linear_algebra.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/face_geometry.h"

namespace varimap {

namespace {

int index_in(const std::vector<int>& ascending, int value) {
    const auto found = std::lower_bound(ascending.begin(), ascending.end(), value);
    return found != ascending.end() && *found == value ? int(found - ascending.begin()) : -1;
}

}  // namespace

SubMesh::SubMesh(const TriangleMesh& whole, std::vector<int> faces) : face(std::move(faces)) {
    vertex = vertices_of(whole, face);
    mesh.vertices.resize(Eigen::Index(vertex.size()), 3);
    for (std::size_t v = 0; v < vertex.size(); ++v)
        mesh.vertices.row(Eigen::Index(v)) = whole.vertices.row(vertex[v]);
    mesh.faces.resize(Eigen::Index(face.size()), 3);
    for (std::size_t f = 0; f < face.size(); ++f)
        for (int k = 0; k < 3; ++k)
            mesh.faces(Eigen::Index(f), k) = index_in(vertex, whole.faces(face[f], k));
}

SurfacePoint SubMesh::on_part(const SurfacePoint& point) const {
    return {index_in(face, point.face), point.barycentric};
}

std::vector<int> disc_boundary(const TriangleMesh& mesh) {
    const Edges edges = find_edges(mesh);
    std::vector<BoundaryLoop> loops = boundary_loops(mesh, edges);
    // With one loop, no vertex of which is met twice, Euler's number 1 leaves neither handles nor other
    // parts.
    if (loops.size() != 1 || mesh.vertex_count() - edges.size() + mesh.face_count() != 1) return {};
    const int boundary_edges = 2 * edges.size() - 3 * mesh.face_count();
    if (int(loops[0].size()) != boundary_edges) return {};
    std::reverse(loops[0].begin() + 1, loops[0].end());
    return std::move(loops[0]);
}

namespace {

/// Of the weights. Without, a finger's tip is so small in a chart that all of another's lies in one of its
/// faces. Tried: 0 to 3; of 14 pairs 239, 72, 103 and 97 faces end reversed, 88, 46, 81 and 79 of them one's.
constexpr int evening_rounds = 2;
/// So many where something is left this much smaller than something else: one layout in four of more than
/// 150 faces, some with limbs of 1e-22 after two rounds.
constexpr int most_evening_rounds = 5;
constexpr double flat_face = 1e-6;

/// Corners of a disc that pull at each other.
struct Spring {
    int a, b;
    double weight;
};

/// Mean-value weights (Floater 2003), made symmetric.
std::vector<Spring> mean_value_springs(const TriangleMesh& disc) {
    std::vector<Spring> springs;
    for (int f = 0; f < disc.face_count(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = disc.faces(f, k);
            const Vec3 a = disc.vertex(disc.faces(f, (k + 1) % 3)) - disc.vertex(v);
            const Vec3 b = disc.vertex(disc.faces(f, (k + 2) % 3)) - disc.vertex(v);
            const double half = std::tan(angle_between(a, b) / 2);
            // Bounds keep needles from making the system singular.
            const auto weight = [&](const Vec3& side) {
                return std::clamp(half, 1e-3, 1e3) / std::max(side.norm(), 1e-12);
            };
            springs.push_back({v, disc.faces(f, (k + 1) % 3), weight(a)});
            springs.push_back({v, disc.faces(f, (k + 2) % 3), weight(b)});
        }
    return springs;
}

/// Where springs come to rest.
class Embedding {
  public:
    Embedding(int vertex_count, const std::vector<int>& boundary, const Points& rim)
        : unknown_(vertex_count, 0), positions_(Points::Zero(vertex_count, 3)) {
        for (std::size_t i = 0; i < boundary.size(); ++i) {
            unknown_[boundary[i]] = -1;
            positions_.row(boundary[i]).leftCols<2>() = rim.row(Eigen::Index(i)).leftCols<2>();
        }
        for (int& u : unknown_)
            if (u == 0) u = count_++;
    }

    const Points& relax(const std::vector<Spring>& springs) {
        if (count_ == 0) return positions_;
        std::vector<Eigen::Triplet<double>> entries;
        Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count_, 2);
        const auto add = [&](int v, int w, double weight) {
            if (unknown_[v] < 0) return;
            entries.emplace_back(unknown_[v], unknown_[v], weight);
            if (unknown_[w] >= 0)
                entries.emplace_back(unknown_[v], unknown_[w], -weight);
            else
                right.row(unknown_[v]) += weight * positions_.row(w).leftCols<2>();
        };
        for (const auto& [a, b, weight] : springs) {
            add(a, b, weight);
            add(b, a, weight);
        }
        Eigen::SparseMatrix<double> system(count_, count_);
        system.setFromTriplets(entries.begin(), entries.end());
        // The same entries every time.
        if (solver_.rows() == 0) solver_.analyzePattern(system);
        solver_.factorize(system);
        const Eigen::MatrixXd solution = solver_.solve(right);
        for (int v = 0; v < unknown_.size(); ++v)
            if (unknown_[v] >= 0) positions_.row(v).leftCols<2>() = solution.row(unknown_[v]);
        return positions_;
    }

  private:
    VertexData<int> unknown_;  ///< -1 on the rim
    Points positions_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
    int count_ = 0;
};

/// Per vertex: area around it in the plane, by that on the disc.
VertexData<double> area_ratios(const TriangleMesh& disc, const Points& positions) {
    const TriangleMesh flat{positions, disc.faces};
    VertexData<double> there(disc.vertex_count(), 0), here(disc.vertex_count(), 0);
    for (int f = 0; f < disc.face_count(); ++f)
        for (int k = 0; k < 3; ++k) {
            there[disc.faces(f, k)] += face_normal(flat, f).norm();
            here[disc.faces(f, k)] += face_normal(disc, f).norm();
        }
    for (int v = 0; v < disc.vertex_count(); ++v)
        there[v] = here[v] > 0 ? std::clamp(there[v] / here[v], 1e-40, 1e12) : 1;
    return there;
}

}  // namespace

Points even_embedding(const TriangleMesh& disc, const std::vector<int>& boundary, const Points& rim) {
    std::vector<Spring> springs = mean_value_springs(disc);
    Embedding embedding(disc.vertex_count(), boundary, rim);
    Points positions = embedding.relax(springs);
    for (int round = 0; round < most_evening_rounds; ++round) {
        const VertexData<double> ratio = area_ratios(disc, positions);
        const auto [least, most] = std::minmax_element(ratio.begin(), ratio.end());
        const bool is_extra = round >= evening_rounds;
        if (is_extra && *least > flat_face * *most) break;
        const double exponent = is_extra ? 0.75 : 0.5;
        for (auto& [a, b, weight] : springs) weight *= std::pow(ratio[a] * ratio[b], exponent);
        positions = embedding.relax(springs);
    }
    return positions;
}

TriangleMesh circular_chart(const TriangleMesh& disc, const std::vector<int>& boundary) {
    const std::size_t n = boundary.size();
    std::vector<double> at(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i)
        at[i + 1] = at[i] + (disc.vertex(boundary[(i + 1) % n]) - disc.vertex(boundary[i])).norm();
    Points rim = Points::Zero(Eigen::Index(n), 3);
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * at[i] / at[n];
        rim.row(Eigen::Index(i)) << std::cos(angle), std::sin(angle), 0;
    }
    return {even_embedding(disc, boundary, rim), disc.faces};
}

std::vector<int> FaceSets::widened(std::vector<int> faces, int count) {
    mark(faces, 1);
    std::size_t begin = 0;
    for (int ring = 0; ring < count; ++ring) {
        const std::size_t end = faces.size();
        for (std::size_t i = begin; i < end; ++i)
            for (int k = 0; k < 3; ++k)
                for (const int f : faces_[mesh_.faces(faces[i], k)])
                    if (!marks_[f]) {
                        marks_[f] = 1;
                        faces.push_back(f);
                    }
        begin = end;
    }
    mark(faces, 0);
    make_set(faces);
    return faces;
}

std::vector<int> FaceSets::enclosed(std::vector<int> faces, const std::vector<int>& seeds, int most) {
    constexpr char taken = 1, outside = 2, present = 3;
    std::vector<int> all_outside;
    mark(faces, taken);
    for (const int seed : seeds) {
        if (marks_[seed]) continue;
        std::vector<int> part{seed};
        marks_[seed] = present;
        bool is_outside = false;
        for (std::size_t i = 0; i < part.size() && !is_outside; ++i) {
            neighbours(part[i], [&](int f) {
                is_outside = is_outside || marks_[f] == outside;
                if (marks_[f]) return;
                marks_[f] = present;
                part.push_back(f);
            });
            is_outside = is_outside || int(part.size()) > most;
        }
        mark(part, is_outside ? outside : taken);
        std::vector<int>& to = is_outside ? all_outside : faces;
        to.insert(to.end(), part.begin(), part.end());
    }
    mark(all_outside, 0);
    mark(faces, 0);
    make_set(faces);
    return faces;
}

std::vector<int> FaceSets::filled(std::vector<int> faces, int most) {
    std::vector<int> seeds;
    mark(faces, 1);
    for (const int f : faces)
        neighbours(f, [&](int g) {
            if (!marks_[g]) seeds.push_back(g);
        });
    mark(faces, 0);
    make_set(seeds);
    return enclosed(std::move(faces), seeds, most);
}

}  // namespace varimap
