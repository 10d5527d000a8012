#include "stages/partners/picture.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace varimap {

namespace {

constexpr double panel = 420, margin = 20;  ///< pixels

/// Directions to the right, up, and towards the viewer.
using Axes = Eigen::Matrix3d;

/// What lies in the plane of x and y is seen as it is, all else from where it is broadest.
Axes axes_of(const Points& points) {
    const Points centred = points.rowwise() - points.colwise().mean();
    if (centred.col(2).cwiseAbs().maxCoeff() < 1e-12) return Axes::Identity();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(centred.transpose() * centred);
    Axes axes = solver.eigenvectors().rowwise().reverse();
    for (int k = 0; k < 2; ++k) {  // signs are arbitrary: the larger component points forwards
        int largest;
        axes.col(k).cwiseAbs().maxCoeff(&largest);
        if (axes(largest, k) < 0) axes.col(k) *= -1;
    }
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
}

/// Maps a box onto a panel, keeping proportions.
struct Frame {
    Eigen::Array2d low, pixels_low;
    double scale;

    Frame(const Points& seen, double left) {
        low = seen.leftCols<2>().colwise().minCoeff().transpose();
        const Eigen::Array2d high = seen.leftCols<2>().colwise().maxCoeff().transpose();
        const Eigen::Array2d extent = (high - low).max(1e-12);
        scale = (panel - 2 * margin) / extent.maxCoeff();
        pixels_low = Eigen::Array2d(left, 0) + (panel - scale * extent) / 2;
    }
    Eigen::Array2d operator()(const Eigen::RowVector3d& point) const {
        const Eigen::Array2d at = pixels_low + scale * (point.head<2>().transpose().array() - low);
        return {at.x(), panel - at.y()};
    }
};

/// Red, green and blue from 0 to 1 by place: along a curve the colours of the rainbow, else one for each of
/// the first directions.
RowMatrix own_colours(const Domain& domain) {
    const Points& points = domain.mesh.vertices;
    const bool intrinsic = domain.coordinates.size() > 0;
    const RowMatrix places = intrinsic ? domain.coordinates : RowMatrix(points * axes_of(points));
    const Eigen::RowVectorXd extent = places.colwise().maxCoeff() - places.colwise().minCoeff();
    const bool is_line = (extent.array() > 1e-6 * extent.maxCoeff()).count() == 1;
    const auto unit = [&](Eigen::Index k) -> Eigen::ArrayXd {
        if (k >= places.cols()) return Eigen::ArrayXd::Constant(places.rows(), .5);
        const Eigen::ArrayXd x = places.col(k).array();
        return (x - x.minCoeff()) / std::max(x.maxCoeff() - x.minCoeff(), 1e-12);
    };
    RowMatrix colours(places.rows(), 3);
    if (is_line) {
        for (int k = 0; k < 3; ++k)
            colours.col(k) = (.5 + .45 * (2 * M_PI * (.85 * unit(0) - k / 3.0)).cos()).matrix();
    } else {
        for (int k = 0; k < 3; ++k) colours.col(k) = (.08 + .84 * unit(k)).matrix();
    }
    return colours;
}

/// Towards light grey where the partner is not certain.
RowMatrix carried_colours(const RowMatrix& colours, const std::vector<Partner>& partners) {
    RowMatrix result(Eigen::Index(partners.size()), 3);
    for (std::size_t i = 0; i < partners.size(); ++i) {
        const Eigen::RowVector3d pale = Eigen::RowVector3d::Constant(.85);
        const Partner& partner = partners[i];
        const double share = partner.point < 0 ? 0 : std::sqrt(partner.certainty);
        result.row(Eigen::Index(i)) =
            partner.point < 0 ? pale : Eigen::RowVector3d((1 - share) * pale + share * colours.row(partner.point));
    }
    return result;
}

std::string hex(const Eigen::RowVector3d& colour) {
    const Eigen::Array3i c = (255 * colour.array().max(0).min(1)).round().cast<int>().transpose();
    return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

class Drawing {
  public:
    void edges(const Domain& domain, const Points& seen, const Frame& frame) {
        for (const DomainEdge& edge : domain.edges)
            line(frame(seen.row(edge.a)), frame(seen.row(edge.b)), "#bbb", 1);
    }
    void points(const RowMatrix& colours, const Points& seen, const Frame& frame) {
        const double radius = std::clamp(40 / std::sqrt(double(seen.rows())), 1.2, 6.0);
        for (Eigen::Index i = 0; i < seen.rows(); ++i) {
            const Eigen::Array2d at = frame(seen.row(i));
            out("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"/>\n", at.x(), at.y(), radius,
                hex(colours.row(i)));
        }
    }
    /// The faces that look at the viewer, the nearest last.
    void faces(const TriangleMesh& mesh, const RowMatrix& colours, const Points& seen, const Frame& frame) {
        std::vector<int> order(std::size_t(mesh.face_count()));
        std::iota(order.begin(), order.end(), 0);
        const auto depth = [&](int f) {
            return seen(mesh.faces(f, 0), 2) + seen(mesh.faces(f, 1), 2) + seen(mesh.faces(f, 2), 2);
        };
        std::stable_sort(order.begin(), order.end(), [&](int f, int g) { return depth(f) < depth(g); });
        for (const int f : order) face({seen, mesh.faces}, f, colours, frame);
    }
    void line(const Eigen::Array2d& a, const Eigen::Array2d& b, const char* colour, double width) {
        out("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
            a.x(), a.y(), b.x(), b.y(), colour, width);
    }
    std::string svg(double width) const {
        return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                           "viewBox=\"0 0 {0} {1}\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n{2}</svg>\n",
                           width, panel, text_);
    }

  private:
    template <class... Values>
    void out(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }
    void face(const TriangleMesh& mesh, int f, const RowMatrix& colours, const Frame& frame) {
        const Vec3 normal = face_normal(mesh, f);
        if (normal.z() <= 0) return;
        Eigen::RowVector3d colour = Eigen::RowVector3d::Zero();
        std::string corners;
        for (int c = 0; c < 3; ++c) {
            const int v = mesh.faces(f, c);
            colour += colours.row(v) / 3;
            const Eigen::Array2d at = frame(mesh.vertices.row(v));
            corners += fmt::format("{:.1f},{:.1f} ", at.x(), at.y());
        }
        const std::string fill = hex((.55 + .45 * normal.normalized().z()) * colour);
        out("<polygon points=\"{0}\" fill=\"{1}\" stroke=\"{1}\"/>\n", corners, fill);
    }

    std::string text_;
};

Points seen_from(const Points& points, const Axes& axes) {
    return points * axes;
}

void draw(const Domain& domain, const RowMatrix& colours, const Points& seen, const Frame& frame,
          Drawing& drawing) {
    if (domain.is_surface()) return drawing.faces(domain.mesh, colours, seen, frame);
    drawing.edges(domain, seen, frame);
    drawing.points(colours, seen, frame);
}

}  // namespace

std::string picture_of(const PicturedDomain& source, const PicturedDomain& target, const Points& centres,
                       Layout layout) {
    const Points &a = source.domain.mesh.vertices, &b = target.domain.mesh.vertices;
    const RowMatrix colours = own_colours(source.domain), carried = carried_colours(colours, target.partners);
    Drawing drawing;
    if (layout == Layout::beside) {
        const Points seen_a = seen_from(a, axes_of(a)), seen_b = seen_from(b, axes_of(b));
        draw(source.domain, colours, seen_a, {seen_a, 0}, drawing);
        draw(target.domain, carried, seen_b, {seen_b, panel}, drawing);
        return drawing.svg(2 * panel);
    }
    Points both(a.rows() + b.rows(), 3);
    both << a, b;
    const Axes axes = axes_of(both);
    // The target below the source, so that neither hides the other.
    const Points seen_a = seen_from(a, axes);
    Points seen_b = seen_from(b, axes), images = seen_from(centres, axes);
    const double lower = seen_b.col(1).maxCoeff() - seen_a.col(1).minCoeff() + .15;
    seen_b.col(1).array() -= lower;
    images.col(1).array() -= lower;
    both << seen_a, seen_b;
    const Frame frame(both, 0);
    for (Eigen::Index i = 0; i < a.rows(); ++i)
        drawing.line(frame(seen_a.row(i)), frame(images.row(i)), "#bbb", .6);
    draw(source.domain, colours, seen_a, frame, drawing);
    draw(target.domain, carried, seen_b, frame, drawing);
    return drawing.svg(panel);
}

}  // namespace varimap
