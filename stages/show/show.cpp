#include "stages/show/show.h"

#include <fmt/format.h>

#include <cmath>

#include "varimap/core/error.h"
#include "varimap/core/parallel.h"
#include "varimap/picture/drawing.h"

namespace varimap {

namespace {

void require_point(int point, const Domain& domain) {
    if (point >= domain.mesh.vertex_count())
        throw UsageError(fmt::format("--point {}: there are {} points", point, domain.mesh.vertex_count()));
}

/// Whether a vertex is on the near side; points of no surface always are.
class FacesViewer {
  public:
    FacesViewer(const Domain& domain, const Points& seen)
        : normals_(domain.is_surface() ? vertex_normals({seen, domain.mesh.faces}) : Points()) {}
    bool operator()(int v) const { return normals_.rows() == 0 || normals_(v, 2) > 0; }

  private:
    Points normals_;
};

/// Whether a weight is centred on its point (Sec. 3.2): how far its maximum lies from the point, and the
/// centre of mass of the neighbourhood in which it is above one half.
struct Centring {
    double maximum, centre;
};

Centring centring(const Domain& domain, const Eigen::VectorXd& weight, int point) {
    const Points& places = domain.mesh.vertices;
    Eigen::Index largest;
    weight.maxCoeff(&largest);
    const Eigen::VectorXd inside = (weight.array() > .5).select(weight.cwiseProduct(domain.mass), 0);
    const Eigen::RowVector3d mean = inside.transpose() * places / inside.sum();
    return {(places.row(largest) - places.row(point)).norm(), (mean - places.row(point)).norm()};
}

const std::string purple = "#7020a0", green = "#108030", black = "#202020";

}  // namespace

std::string show_weights(const Domain& domain, const Basis& basis, int point, double time) {
    require_point(point, domain);
    const RowMatrix embedding = diffusion_embedding(basis, time * coarsest_time(basis));
    const Eigen::VectorXd kernel = embedding * embedding.row(point).transpose();
    const Eigen::VectorXd diagonal = embedding.rowwise().squaredNorm();
    const double own = diagonal[point];
    const Eigen::VectorXd weights[3] = {kernel / kernel.maxCoeff(),
                                        kernel.cwiseQuotient((own * diagonal).cwiseSqrt()),
                                        2 * kernel.cwiseQuotient((own + diagonal.array()).matrix())};
    const char* names[3] = {"K / max K", "K / sqrt(K K)", "2 K / (K + K), Eq. 7"};
    const Points seen = domain.mesh.vertices * viewing_axes(domain.mesh.vertices);
    const FacesViewer faces_viewer(domain, seen);
    Drawing drawing;
    for (int k = 0; k < 3; ++k) {
        const Frame frame(seen, k);
        drawing.domain(domain, colours_by_value(weights[k]), seen, frame);
        for (Eigen::Index v = 0; v < kernel.size(); v += 3)
            if (weights[k][v] > .5 && faces_viewer(int(v)))
                drawing.dot(seen.row(v), 1.8 * weights[k][v], green, frame);
        drawing.dot(seen.row(point), 4, purple, frame);
        const Centring off = centring(domain, weights[k], point);
        drawing.label(
            k, fmt::format("{}: maximum {:.3f}, centre {:.3f} away", names[k], off.maximum, off.centre));
    }
    return drawing.svg(3);
}

std::string show_samples(const Domain& domain, const Hierarchy& hierarchy) {
    const Points seen = domain.mesh.vertices * viewing_axes(domain.mesh.vertices);
    const Frame frame(seen, 0);
    const std::vector<int>& samples = hierarchy.last_diffusion_level().samples;
    Drawing drawing;
    drawing.domain(domain, colours_by_value(Eigen::VectorXd::Zero(seen.rows())), seen, frame);
    const FacesViewer faces_viewer(domain, seen);
    for (const int v : samples)
        if (faces_viewer(v)) drawing.dot(seen.row(v), 1.8, black, frame);
    drawing.label(0, fmt::format("{} samples", samples.size()));
    return drawing.svg(1);
}

std::string show_row(const Domain& A, const Domain& B, const SamplePlan& plan, int point) {
    require_point(point, A);
    const Points &a = A.mesh.vertices, &b = B.mesh.vertices;
    int row = 0;  // the sample nearest in space
    for (int k = 1; k < int(plan.samples_A.size()); ++k)
        if ((a.row(plan.samples_A[std::size_t(k)]) - a.row(point)).squaredNorm() <
            (a.row(plan.samples_A[std::size_t(row)]) - a.row(point)).squaredNorm())
            row = k;
    const Points seen_a = a * viewing_axes(a), seen_b = b * viewing_axes(b);
    const Frame left(seen_a, 0), right(seen_b, 1);
    Drawing drawing;
    drawing.domain(A, colours_by_value(Eigen::VectorXd::Zero(a.rows())), seen_a, left);
    drawing.dot(seen_a.row(plan.samples_A[std::size_t(row)]), 5, purple, left);
    drawing.domain(B, colours_by_value(Eigen::VectorXd::Zero(b.rows())), seen_b, right);
    int entries = 0;
    for (SparseMatrix::InnerIterator entry(plan.entries, row); entry; ++entry, ++entries)
        drawing.dot(seen_b.row(plan.samples_B[std::size_t(entry.col())]),
                    1.5 + 5 * std::sqrt(entry.value() / plan.transported_A[row]), green, right);
    drawing.label(0, fmt::format("one of {} samples", plan.samples_A.size()));
    drawing.label(1, fmt::format("{} entries among {} samples", entries, plan.samples_B.size()));
    return drawing.svg(2);
}

std::string show_centres(const Domain& A, const Domain& B, const Points& centres) {
    const Points& b = B.mesh.vertices;
    Eigen::VectorXd nearest(b.rows());
    parallel_for_each_index(b.rows(), Eigen::Index(64), [&](Eigen::Index v) {
        nearest[v] = std::sqrt((centres.rowwise() - b.row(v)).rowwise().squaredNorm().minCoeff());
    });
    const Eigen::Matrix3d axes = viewing_axes(b);
    const Points seen = centres * axes;
    Drawing drawing;
    drawing.wires({centres, A.mesh.faces}, seen, {b * axes, 0});
    drawing.label(0, fmt::format("mean distance to the nearest vertex {:.4f}", B.mass.dot(nearest)));
    return drawing.svg(1);
}

std::string show_wires(const TriangleMesh& mesh) {
    const Points seen = mesh.vertices * viewing_axes(mesh.vertices);
    Drawing drawing;
    drawing.wires(mesh, seen, {seen, 0});
    return drawing.svg(1);
}

}  // namespace varimap
