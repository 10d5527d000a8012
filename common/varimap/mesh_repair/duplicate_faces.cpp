#include "varimap/mesh_repair/duplicate_faces.h"

#include <algorithm>
#include <array>

#include "varimap/core/index_set.h"
#include "varimap/mesh/topology.h"

namespace varimap {
namespace {

constexpr double largest_fin = 1e-3;  ///< share of the area

/// The vertices of a face in ascending order, and whether that is an even permutation of its corners.
struct Key {
    std::array<int, 3> vertices;
    bool even = true;
};

Key key_of(const TriangleMesh& mesh, int f) {
    Key key{{mesh.faces(f, 0), mesh.faces(f, 1), mesh.faces(f, 2)}};
    for (const auto& [i, k] : {std::pair{0, 1}, {1, 2}, {0, 1}})
        if (key.vertices[std::size_t(i)] > key.vertices[std::size_t(k)]) {
            std::swap(key.vertices[std::size_t(i)], key.vertices[std::size_t(k)]);
            key.even = !key.even;
        }
    return key;
}

/// What is left of faces that lie on each other, first to last.
class Thinning {
  public:
    explicit Thinning(const TriangleMesh& mesh)
        : mesh_(mesh),
          keep_(std::size_t(mesh.face_count()), 1),
          back_to_back_(std::size_t(mesh.face_count()), 0) {
        for (int f = 0; f < mesh.face_count(); ++f) keys_.push_back(key_of(mesh, f));
    }
    std::vector<char> run();

  private:
    void thin_group(const int* begin, const int* end);
    void drop_fins();
    bool is_fin(const std::vector<int>& part, const Edges& edges) const;

    const TriangleMesh& mesh_;
    std::vector<Key> keys_;
    std::vector<char> keep_, back_to_back_;
};

void Thinning::thin_group(const int* begin, const int* end) {
    const auto even = std::count_if(begin, end, [&](int f) { return keys_[std::size_t(f)].even; });
    const auto odd = end - begin - even;
    const auto is_majority = [&](int f) { return even == odd || keys_[std::size_t(f)].even == (even > odd); };
    const int* left = std::find_if(begin, end, is_majority);
    for (const int* f = begin; f != end; ++f) {
        keep_[std::size_t(*f)] = f == left;
        back_to_back_[std::size_t(*f)] = even == odd;
    }
}

bool Thinning::is_fin(const std::vector<int>& part, const Edges& edges) const {
    bool attached = false;
    for (const int f : part)
        for (int half_edge = 3 * f; half_edge < 3 * f + 3; ++half_edge) {
            const auto around = edges.half_edges[edges.of_half_edge[std::size_t(half_edge)]];
            const auto others = std::count_if(around.begin(), around.end(), [&](int other) {
                return keep_[std::size_t(other / 3)] && !back_to_back_[std::size_t(other / 3)];
            });
            if (others == 1) return false;
            attached = attached || others > 1;
        }
    return attached;
}

void Thinning::drop_fins() {
    const Edges edges = find_edges(mesh_);
    const double limit = largest_fin * surface_area(mesh_);
    for (const std::vector<int>& part : face_components(edges, back_to_back_)) {
        double area = 0;
        for (const int f : part)
            if (keep_[std::size_t(f)]) area += face_normal(mesh_, f).norm() / 2;
        if (area > limit || !is_fin(part, edges)) continue;
        for (const int f : part) keep_[std::size_t(f)] = 0;
    }
}

std::vector<char> Thinning::run() {
    std::vector<int> order = all_indices(mesh_.face_count());
    const auto vertices = [&](int f) -> const std::array<int, 3>& { return keys_[std::size_t(f)].vertices; };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return vertices(a) < vertices(b); });
    bool any = false;
    for (std::size_t i = 0, end; i < order.size(); i = end) {
        for (end = i + 1; end < order.size() && vertices(order[end]) == vertices(order[i]);) ++end;
        if (end - i > 1) thin_group(order.data() + i, order.data() + end), any = true;
    }
    if (any) drop_fins();
    return keep_;
}

}  // namespace

std::vector<char> without_duplicates(const TriangleMesh& mesh) {
    return Thinning(mesh).run();
}

}  // namespace varimap
