#include "varimap/results/map_arrays.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "varimap/artifact/npy.h"
#include "varimap/mesh/face_geometry.h"

namespace varimap {

namespace {

/// Rows of values of vertices: which of them, and how much of each.
struct Csr {
    std::vector<double> data;
    std::vector<std::int32_t> indices, indptr{0};

    void add_row(const SurfacePoint& point, const TriangleMesh& target) {
        std::array<int, 3> order{0, 1, 2};
        if (point.face >= 0)
            std::sort(order.begin(), order.end(), [&](int a, int b) {
                return target.faces(point.face, a) < target.faces(point.face, b);
            });
        for (const int k : order) {
            if (point.face < 0 || point.barycentric[k] == 0) continue;
            data.push_back(point.barycentric[k]);
            indices.push_back(target.faces(point.face, k));
        }
        indptr.push_back(std::int32_t(data.size()));
    }
};

}  // namespace

std::string to_npz(const PointMap& map, const TriangleMesh& target) {
    const auto n = static_cast<long long>(map.size());
    std::vector<std::int32_t> faces, nearest;
    std::vector<double> barycentric;
    Csr csr;
    for (const SurfacePoint& point : map) {
        faces.push_back(point.face);
        nearest.push_back(nearest_vertex(target, point));
        barycentric.insert(barycentric.end(), point.barycentric.begin(), point.barycentric.end());
        csr.add_row(point, target);
    }
    std::vector<std::pair<std::string, std::string>> files{
        {"face.npy", to_npy("<i4", {n}, faces)},
        {"barycentric.npy", to_npy("<f8", {n, 3}, barycentric)},
        {"nearest_vertex.npy", to_npy("<i4", {n}, nearest)}};
    for (auto& file : csr_files(n, target.vertex_count(), csr.data, csr.indices, csr.indptr))
        files.push_back(std::move(file));
    return to_zip(files);
}

}  // namespace varimap
