#include "fuzz/forgery.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fixtures/map_shapes.h"
#include "varimap/mesh/mass.h"

namespace varimap::fuzz {
namespace {

const std::vector<double> extremes{0,
                                   -0.,
                                   1,
                                   -1,
                                   .5,
                                   1e-12,
                                   1e-30,
                                   1e-160,
                                   1e-310,
                                   1e10,
                                   1e100,
                                   1e155,
                                   1e308,
                                   -1e308,
                                   1 - 1e-12,
                                   .999999,
                                   1e-6,
                                   std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity()};

}  // namespace

void Forger::one_of(const std::vector<std::function<void()>>& edits, std::size_t at_most) {
    for (std::size_t count = 1 + below(at_most); count > 0; --count) edits[below(edits.size())]();
}

void Forger::real(double& value) {
    switch (below(4)) {
        case 0:
            value = extremes[below(extremes.size())];
            break;
        case 1:
            value = -value;
            break;
        case 2:
            value *= std::pow(10, double(below(31)) - 15);
            break;
        default:
            value *= 1 + .01 * (double(below(101)) - 50);
    }
}

void Forger::integer(int& value, int near) {
    switch (below(4)) {
        case 0:
            value = int(unsigned(value) + (below(2) ? 1u : ~0u));  // up or down, round the ends
            break;
        case 1:
            value = below(2) ? std::numeric_limits<int>::max() : -1;
            break;
        default:
            value = int(below(std::size_t(std::max(1, near))));
    }
}

template <class Matrix>
void Forger::reals(Matrix& matrix) {
    if (matrix.size() == 0) return;
    const auto any = [&]() -> double& { return matrix.data()[below(std::size_t(matrix.size()))]; };
    switch (below(9)) {
        case 0:
        case 1:
            return real(any());
        case 2:
            return std::swap(any(), any());
        case 3:
            matrix.setConstant(any());
            return;
        case 4:
            matrix *= std::pow(10, double(below(41)) - 20);
            return;
        case 5:
            matrix = -matrix;
            return;
        case 6:
            matrix.row(Eigen::Index(below(std::size_t(matrix.rows())))) =
                matrix.row(Eigen::Index(below(std::size_t(matrix.rows())))).eval();
            return;
        case 7:
            matrix.conservativeResize(std::max<Eigen::Index>(0, matrix.rows() - 1), matrix.cols());
            return;
        default:
            for (std::size_t i = 1 + below(8); i > 0; --i) real(any());
    }
}

/// Of the same sum, mostly.
void Forger::masses(Eigen::VectorXd& masses) {
    if (masses.size() == 0) return;
    double& one = masses[Eigen::Index(below(std::size_t(masses.size())))];
    double& other = masses[Eigen::Index(below(std::size_t(masses.size())))];
    switch (below(4)) {
        case 0: {
            const double left = one * std::pow(10, -double(below(300)));
            other += one - left;
            one = left;
            return;
        }
        case 1:
            masses.setConstant(1e-200);
            one = 1;
            return;
        case 2:
            std::swap(one, other);
            return;
        default:
            reals(masses);
    }
}

void Forger::integers(std::vector<int>& values) {
    if (values.empty()) return;
    const int most = *std::max_element(values.begin(), values.end());
    const auto any = [&]() -> int& { return values[below(values.size())]; };
    switch (below(7)) {
        case 0:
        case 1:
            return integer(any(), most + 1);
        case 2:
            return std::swap(any(), any());
        case 3:
            return std::reverse(values.begin(), values.end());
        case 4:
            values.assign(values.size(), any());
            return;
        case 5:
            values.pop_back();
            return;
        default:
            std::shuffle(values.begin(), values.end(), random_);
    }
}

void Forger::triangles(Faces& faces) {
    std::vector<int> corners(faces.data(), faces.data() + faces.size());
    integers(corners);
    if (Eigen::Index(corners.size()) != faces.size()) {
        faces.conservativeResize(faces.rows() - 1, 3);
    } else {
        std::copy(corners.begin(), corners.end(), faces.data());
    }
}

void Forger::points(PointMap& points) {
    if (points.empty()) return;
    SurfacePoint& one = points[below(points.size())];
    SurfacePoint& other = points[below(points.size())];
    switch (below(6)) {
        case 0:
            return integer(one.face, int(points.size()));
        case 1:
            return real(one.barycentric[Eigen::Index(below(3))]);
        case 2:
            return std::swap(one, other);
        case 3:
            points.assign(points.size(), SurfacePoint(one));
            return;
        case 4:
            points.pop_back();
            return;
        default:
            std::shuffle(points.begin(), points.end(), random_);
    }
}

void Forger::sparse(SparseMatrix& matrix) {
    if (matrix.nonZeros() == 0) return;
    switch (below(5)) {
        case 0:
            return real(matrix.valuePtr()[below(std::size_t(matrix.nonZeros()))]);
        case 1: {
            const auto row = Eigen::Index(below(std::size_t(matrix.rows())));
            matrix.prune([&](Eigen::Index r, Eigen::Index, double) { return r != row; });
            return;
        }
        case 2: {
            const std::size_t keep = 1 + below(10);
            matrix.prune([&](Eigen::Index, Eigen::Index, double) { return below(10) < keep; });
            return;
        }
        case 3:
            matrix = SparseMatrix(matrix.transpose());
            return;
        default: {
            Eigen::VectorXd values = Eigen::Map<Eigen::VectorXd>(matrix.valuePtr(), matrix.nonZeros());
            reals(values);
            std::copy(values.begin(), values.end(), matrix.valuePtr());
        }
    }
}

/// Another surface that agrees with itself: a vertex is moved, squeezed or blown up with all that depends on
/// it.
void Forger::reshape(Surface& surface) {
    TriangleMesh mesh = surface.mesh;
    const auto any = [&] { return Eigen::Index(below(std::size_t(mesh.vertex_count()))); };
    for (std::size_t i = 1 + below(10); i > 0; --i) {
        switch (below(5)) {
            case 0:
                mesh.vertices.row(any()) = mesh.vertices.row(any()).eval();
                break;
            case 1:
                mesh.vertices.row(any()) *= std::pow(10, double(below(9)) - 4);
                break;
            case 2:
                mesh.vertices.col(Eigen::Index(below(3))) *= std::pow(10, -double(below(10)));
                break;
            case 3: {
                const Eigen::Index v = any(), w = any();
                const double t = std::pow(10, -double(below(16)));
                mesh.vertices.row(v) = (t * mesh.vertices.row(v) + (1 - t) * mesh.vertices.row(w)).eval();
                break;
            }
            default:
                mesh.vertices.row(any()) *= -1;
        }
    }
    mesh.vertices /= std::sqrt(surface_area(mesh));
    surface = shapes::plain_surface(mesh);
    surface.mass = voronoi_masses(mesh);
}

void Forger::operator()(Surface& s) {
    if (below(2) == 0) return reshape(s);
    one_of({[&] { reals(s.mesh.vertices); }, [&] { triangles(s.mesh.faces); }, [&] { masses(s.mass); },
            [&] { reals(s.input.vertices); }, [&] { triangles(s.input.faces); }, [&] { points(s.on_mesh); },
            [&] { integers(s.input_face); }, [&] { points(s.on_input); }, [&] { real(s.centre[0]); },
            [&] { real(s.scale); }, [&] { flag(s.mirrored); }});
}

void Forger::operator()(Basis& b) {
    one_of({[&] { reals(b.eigenvalues); }, [&] { std::sort(b.eigenvalues.begin(), b.eigenvalues.end()); },
            [&] { reals(b.functions); }, [&] { reals(b.functions); }, [&] { reals(b.residuals); },
            [&] {
                const auto count = 1 + Eigen::Index(below(std::size_t(b.functions.cols())));
                b.functions.conservativeResize(b.functions.rows(), count);
                b.eigenvalues.conservativeResize(count);
                b.residuals.conservativeResize(count);
            },
            [&] { b.eigenvalues.tail(b.eigenvalues.size() - 1) *= std::pow(10, double(below(20)) - 10); }});
}

void Forger::level(Level& l) {
    one_of({[&] { real(l.scale); }, [&] { flag(l.full); }, [&] { integers(l.samples); },
            [&] { integers(l.cell); }, [&] { masses(l.mass); }, [&] { sparse(l.weights); },
            [&] { l.kind = LevelKind(below(3)); }},
           2);
}

void Forger::operator()(Hierarchy& h) {
    const auto any = [&]() -> Level& { return h.levels[below(h.levels.size())]; };
    one_of({[&] { level(any()); }, [&] { level(any()); }, [&] { level(any()); },
            [&] { any() = Level(any()); }, [&] { h.levels.resize(1 + below(h.levels.size())); },
            [&] { h.levels.erase(h.levels.begin() + std::ptrdiff_t(below(h.levels.size()))); },
            [&] { h.levels.insert(h.levels.begin(), 1 + below(20), Level(any())); },
            [&] { real(h.options.density); }, [&] { real(h.options.truncation); },
            [&] { real(h.options.growth); }, [&] { integer(h.options.minimum_neighbours, 1000); },
            [&] { real(h.options.sampled_share); }, [&] { integer(h.options.last_neighbours, 1000); },
            [&] { reals(h.shape.descriptors); }, [&] { reals(h.shape.bending); }},
           2);
    if (h.levels.empty()) h.levels.emplace_back();
}

void Forger::pairs(PointPairs& pairs) {
    PointMap first, second;
    for (const auto& [a, b] : pairs) first.push_back(a), second.push_back(b);
    points(below(2) ? first : second);
    pairs.clear();
    for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i)
        pairs.emplace_back(first[i], second[i]);
}

void Forger::operator()(Candidates& c) {
    if (c.maps.empty()) return;
    const auto map = [&]() -> Correspondences& { return c.maps[below(c.maps.size())]; };
    one_of({[&] { pairs(map().from_A); }, [&] { pairs(map().from_A); }, [&] { pairs(map().from_B); },
            [&] { pairs(map().from_B); },
            [&] {
                if (!c.previews.empty()) points(c.previews[below(c.previews.size())]);
            },
            [&] {
                if (!c.previews.empty()) points(c.previews[below(c.previews.size())]);
            },
            [&] { real(c.list[0].reversed_mass); }, [&] { real(c.list[0].score); },
            [&] { integer(c.list[0].self_map_A, 3); }, [&] { std::swap(c.maps.front(), c.maps.back()); },
            [&] { c.previews.resize(below(3 + c.previews.size()), PointMap(3)); }});
}

void Forger::sample_plan(SamplePlan& p) {
    one_of({[&] { integers(p.samples_A); }, [&] { integers(p.samples_B); }, [&] { masses(p.mass_A); },
            [&] { masses(p.mass_B); }, [&] { masses(p.transported_A); }, [&] { masses(p.transported_B); },
            [&] { real(p.area_bound); }, [&] { sparse(p.entries); }, [&] { sparse(p.entries); }},
           2);
}

void Forger::trace(Trace& trace) {
    if (trace.empty()) return;
    TraceRow& row = trace[below(trace.size())];
    one_of({[&] { integer(row.level, 20); }, [&] { integer(row.euclidean, 2); },
            [&] { integer(row.iteration, 20); }, [&] { integer(row.samples_A, 1000); },
            [&] { real(row.energy); }, [&] { real(row.entries); },
            [&] { trace.resize(below(trace.size())); }});
}

void Forger::pair(SolvedPair& p) {
    PairRecord& r = p.record;
    const auto landmark = [&]() -> std::pair<MeshVertex, MeshVertex>& {
        if (r.landmarks.empty()) r.landmarks.push_back({{0}, {0}});
        return r.landmarks[below(r.landmarks.size())];
    };
    one_of({[&] { sample_plan(p.plan); }, [&] { sample_plan(p.plan); }, [&] { trace(p.trace); },
            [&] { integer(landmark().first.index, 50); }, [&] { integer(landmark().second.index, 50); },
            [&] { r.landmarks.push_back(landmark()); }, [&] { real(r.landmark_weight); },
            [&] { r.landmark_checks.resize(r.landmarks.size() + below(2)); },
            [&] {
                r.landmark_points.resize(r.landmarks.size(), {{0, Vec3::UnitX()}, {0, Vec3::UnitY()}});
                if (r.landmark_points.empty()) return;
                integer(r.landmark_points[0].first.face, 100);
                real(r.landmark_points[0].second.barycentric[0]);
            },
            [&] { r.candidates.resize(below(3)); }, [&] { integer(r.candidate, 3); }});
}

void Forger::operator()(Diffusion& d) {
    one_of({[&] { pair(d); }, [&] { integers(d.image_vertex_A); }, [&] { integers(d.image_vertex_B); }}, 2);
}

void Forger::operator()(Plan& p) {
    one_of({[&] { pair(p); }, [&] { reals(p.centre_A); }, [&] { reals(p.centre_B); }}, 2);
}

void Forger::operator()(SurfaceMap& m) {
    one_of({[&] { points(m.A_to_B); }, [&] { points(m.B_to_A); },
            [&] { real(m.untangling.A_to_B.flipped_area_percent_before); },
            [&] { integer(m.untangling.B_to_A.sweeps, 100); }});
}

}  // namespace varimap::fuzz
