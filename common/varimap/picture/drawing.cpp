#include "varimap/picture/drawing.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>

namespace varimap {

namespace {

constexpr double panel = 420, margin = 20;  ///< pixels

template <class... Values>
void print(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

std::string hex(const Eigen::RowVector3d& colour) {
    const Eigen::Array3i c = (255 * colour.array().max(0).min(1)).round().cast<int>().transpose();
    return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

/// Faces that look at the viewer, the farthest first.
std::vector<int> visible_faces(const TriangleMesh& seen) {
    std::vector<int> order;
    for (int f = 0; f < seen.face_count(); ++f)
        if (face_normal(seen, f).z() > 0) order.push_back(f);
    const auto depth = [&](int f) {
        return seen.vertices(seen.faces(f, 0), 2) + seen.vertices(seen.faces(f, 1), 2) +
               seen.vertices(seen.faces(f, 2), 2);
    };
    std::stable_sort(order.begin(), order.end(), [&](int f, int g) { return depth(f) < depth(g); });
    return order;
}

}  // namespace

Eigen::Matrix3d viewing_axes(const Points& points) {
    const Points centred = points.rowwise() - points.colwise().mean();
    const double rounding = 1e-12 * points.cwiseAbs().maxCoeff();
    if (centred.col(2).cwiseAbs().maxCoeff() <= rounding) return Eigen::Matrix3d::Identity();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(centred.transpose() * centred);
    Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse();
    for (int k = 0; k < 2; ++k) {  // signs are arbitrary: the larger component points forwards
        int largest;
        axes.col(k).cwiseAbs().maxCoeff(&largest);
        if (axes(largest, k) < 0) axes.col(k) *= -1;
    }
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
}

Colours colours_by_place(const Domain& domain) {
    const Points& points = domain.mesh.vertices;
    const bool intrinsic = domain.coordinates.size() > 0;
    const RowMatrix places = intrinsic ? domain.coordinates : RowMatrix(points * viewing_axes(points));
    const Eigen::RowVectorXd extent = places.colwise().maxCoeff() - places.colwise().minCoeff();
    const bool is_line = (extent.array() > 1e-6 * extent.maxCoeff()).count() == 1;
    const auto unit = [&](Eigen::Index k) -> Eigen::ArrayXd {
        if (k >= places.cols()) return Eigen::ArrayXd::Constant(places.rows(), .5);
        return (places.col(k).array() - places.col(k).minCoeff()) /
               std::max(extent[k], std::numeric_limits<double>::min());
    };
    Colours colours(places.rows(), 3);
    for (int k = 0; k < 3; ++k)
        colours.col(k) =
            is_line ? Eigen::ArrayXd(.5 + .45 * (2 * std::numbers::pi * (.85 * unit(0) - k / 3.0)).cos())
                    : Eigen::ArrayXd(.08 + .84 * unit(k));
    return colours;
}

Colours colours_by_value(const Eigen::VectorXd& values) {
    const Eigen::RowVector3d pale(.88, .88, .9), deep(.75, 0, .1);
    Colours colours(values.size(), 3);
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        const double share = std::clamp(values[i], 0.0, 1.0);
        colours.row(i) = (1 - share) * pale + share * deep;
    }
    return colours;
}

Frame::Frame(const Points& seen, int column) {
    low_ = seen.leftCols<2>().colwise().minCoeff().transpose();
    const Eigen::Array2d high = seen.leftCols<2>().colwise().maxCoeff().transpose();
    const Eigen::Array2d extent = (high - low_).max(std::numeric_limits<double>::min());
    scale_ = (panel - 2 * margin) / extent.maxCoeff();
    pixels_low_ = Eigen::Array2d(column * panel, 0) + (panel - scale_ * extent) / 2;
}

Eigen::Array2d Frame::operator()(const Eigen::RowVector3d& point) const {
    const Eigen::Array2d at = pixels_low_ + scale_ * (point.head<2>().transpose().array() - low_);
    return {at.x(), panel - at.y()};
}

void Drawing::domain(const Domain& domain, const Colours& colours, const Points& seen, const Frame& frame) {
    if (domain.is_surface()) return faces({seen, domain.mesh.faces}, &colours, frame);
    for (const DomainEdge& edge : domain.edges) line(seen.row(edge.a), seen.row(edge.b), "#bbb", 1, frame);
    const double radius = std::clamp(40 / std::sqrt(double(seen.rows())), 1.2, 6.0);
    for (Eigen::Index i = 0; i < seen.rows(); ++i) dot(seen.row(i), radius, hex(colours.row(i)), frame);
}

void Drawing::wires(const TriangleMesh& mesh, const Points& seen, const Frame& frame) {
    faces({seen, mesh.faces}, nullptr, frame);
}

void Drawing::faces(const TriangleMesh& seen, const Colours* colours, const Frame& frame) {
    for (const int f : visible_faces(seen)) {
        Eigen::RowVector3d colour = Eigen::RowVector3d::Zero();
        std::string corners;
        for (int c = 0; c < 3; ++c) {
            const int v = seen.faces(f, c);
            if (colours) colour += colours->row(v) / 3;
            const Eigen::Array2d at = frame(seen.vertices.row(v));
            corners += fmt::format("{:.1f},{:.1f} ", at.x(), at.y());
        }
        const double light = .55 + .45 * face_normal(seen, f).normalized().z();
        const std::string fill = colours ? hex(light * colour) : "#fff", stroke = colours ? fill : "#445";
        print(text_, "<polygon points=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>\n", corners,
              fill, stroke, colours ? 1 : .4);
    }
}

void Drawing::dot(const Eigen::RowVector3d& point, double radius, const std::string& colour,
                  const Frame& frame) {
    const Eigen::Array2d at = frame(point);
    print(text_, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"/>\n", at.x(), at.y(), radius,
          colour);
}

void Drawing::line(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const std::string& colour,
                   double width, const Frame& frame) {
    const Eigen::Array2d from = frame(a), to = frame(b);
    print(
        text_,
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
        from.x(), from.y(), to.x(), to.y(), colour, width);
}

void Drawing::label(int column, const std::string& text) {
    print(text_,
          "<text x=\"{}\" y=\"16\" font-family=\"sans-serif\" font-size=\"13\" "
          "text-anchor=\"middle\">{}</text>\n",
          (column + .5) * panel, text);
}

std::string Drawing::svg(int columns) const {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n{2}</svg>\n",
        columns * panel, panel, text_);
}

}  // namespace varimap
