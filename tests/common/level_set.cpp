#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "common/shapes.h"

namespace varimap::shapes {
namespace {

/// A grid over a box, cut into six tetrahedra per cell along the cell's main diagonal.
class TetrahedralGrid {
  public:
    TetrahedralGrid(const std::function<double(const Vec3&)>& f, const Vec3& low, const Vec3& high,
                    double cell)
        : f_(f), low_(low), cell_(cell) {
        for (int i = 0; i < 3; ++i) size_[i] = int(std::ceil((high[i] - low[i]) / cell)) + 1;
        value_.resize(std::size_t(size_[0]) * size_[1] * size_[2]);
        for (int n = 0; n < int(value_.size()); ++n) {
            value_[n] = f(node(n));
            if (value_[n] == 0) value_[n] = 1e-12;
        }
    }
    TriangleMesh march();

  private:
    Vec3 node(int n) const {
        return low_ + cell_ * Vec3(n % size_[0], n / size_[0] % size_[1], n / size_[0] / size_[1]);
    }
    void cut_tetrahedron(const std::array<int, 4>& corner);
    void add_face(int a, int b, int c, const Vec3& outward) {
        const Vec3 normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
        if (normal.dot(outward) < 0) std::swap(b, c);
        faces_.push_back({a, b, c});
    }
    int crossing(int a, int b);
    Vec3 project(Vec3 p) const;

    const std::function<double(const Vec3&)>& f_;
    Vec3 low_;
    double cell_;
    std::array<int, 3> size_;
    std::vector<double> value_;
    std::map<std::pair<int, int>, int> vertex_;
    std::vector<Vec3> points_;
    std::vector<std::array<int, 3>> faces_;
};

/// Kept away from the ends of the grid's edge, so that triangles do not become needles.
int TetrahedralGrid::crossing(int a, int b) {
    const auto [entry, is_new] = vertex_.try_emplace({std::min(a, b), std::max(a, b)}, int(points_.size()));
    if (is_new) {
        const double t = std::clamp(value_[a] / (value_[a] - value_[b]), 0.15, 0.85);
        points_.push_back((1 - t) * node(a) + t * node(b));
    }
    return entry->second;
}

void TetrahedralGrid::cut_tetrahedron(const std::array<int, 4>& corner) {
    std::vector<int> inside, outside;
    for (const int n : corner) (value_[n] < 0 ? inside : outside).push_back(n);
    if (inside.empty() || outside.empty()) return;
    Vec3 outward = Vec3::Zero();
    for (const int n : outside) outward += node(n) / double(outside.size());
    for (const int n : inside) outward -= node(n) / double(inside.size());
    if (inside.size() == 2) {
        const int a = crossing(inside[0], outside[0]), b = crossing(inside[0], outside[1]);
        const int c = crossing(inside[1], outside[1]), d = crossing(inside[1], outside[0]);
        add_face(a, b, c, outward);
        add_face(a, c, d, outward);
        return;
    }
    const int tip = inside.size() == 1 ? inside[0] : outside[0];
    const std::vector<int>& base = inside.size() == 1 ? outside : inside;
    add_face(crossing(tip, base[0]), crossing(tip, base[1]), crossing(tip, base[2]), outward);
}

/// Newton steps along the gradient, by central differences.
Vec3 TetrahedralGrid::project(Vec3 p) const {
    const double h = 1e-5;
    for (int step = 0; step < 8; ++step) {
        Vec3 gradient;
        for (int i = 0; i < 3; ++i)
            gradient[i] = (f_(p + h * Vec3::Unit(i)) - f_(p - h * Vec3::Unit(i))) / (2 * h);
        p -= f_(p) / gradient.squaredNorm() * gradient;
    }
    return p;
}

TriangleMesh TetrahedralGrid::march() {
    const int dx = 1, dy = size_[0], dz = size_[0] * size_[1];
    const std::array<std::array<int, 3>, 6> orders{
        {{dx, dy, dz}, {dx, dz, dy}, {dy, dx, dz}, {dy, dz, dx}, {dz, dx, dy}, {dz, dy, dx}}};
    for (int k = 0; k + 1 < size_[2]; ++k)
        for (int j = 0; j + 1 < size_[1]; ++j)
            for (int i = 0; i + 1 < size_[0]; ++i)
                for (const auto& [s, t, u] : orders) {
                    const int n = i + dy * j + dz * k;
                    cut_tetrahedron({n, n + s, n + s + t, n + s + t + u});
                }
    for (Vec3& p : points_) p = project(p);
    return make_mesh(points_, faces_);
}

}  // namespace

TriangleMesh level_set(const std::function<double(const Vec3&)>& f, const Vec3& low, const Vec3& high,
                       double cell) {
    return TetrahedralGrid(f, low, high, cell).march();
}

}  // namespace varimap::shapes
