#include "varimap/results/read_out.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "varimap/core/error.h"
#include "varimap/core/parallel.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/topology.h"

namespace varimap {

namespace {

constexpr double support_share = 0.05;  ///< of its row's maximum: entries from here on span the support
/// A face that agrees with the predicted normal is taken up to this multiple of the smallest distance. Where
/// a shrunken centre lies between the two sides of a thin part this decides for the right one; where the
/// prediction is wrong (a mirrored part) the other side is too far away for it to do harm.
constexpr double farther_for_agreement = 3;
constexpr double reliable_normal = 0.3;  ///< length of a mean of unit normals below which it says nothing

/// The best of the faces offered: the smallest distance; among equals the lowest face, so that the order in
/// which they are offered does not matter.
struct Best {
    SurfacePoint point;
    double squared_distance = std::numeric_limits<double>::infinity();

    void offer(const SurfacePoint& candidate, double distance) {
        if (distance > squared_distance || (distance == squared_distance && candidate.face >= point.face))
            return;
        point = candidate;
        squared_distance = distance;
    }
};

SurfacePoint prefer_agreeing(const Best& any, const Best& agreeing) {
    const double limit = farther_for_agreement * farther_for_agreement * any.squared_distance;
    return agreeing.point.face >= 0 && agreeing.squared_distance <= limit ? agreeing.point : any.point;
}

/// Closest points on the faces that touch the supports of a plan's rows.
class SupportReader {
  public:
    SupportReader(const Points& centres, const SparseMatrix& plan, const TriangleMesh& target)
        : centres_(centres),
          plan_(plan),
          target_(target),
          faces_(vertex_faces(target)),
          longest_edge_(longest_edges(target)),
          normals_(vertex_normals(target)) {}

    /// face -1 if the row is empty.
    SurfacePoint operator()(int row) const {
        Search search{centres_.row(row).transpose(), predicted_normal(row), {}, {}};
        const std::vector<int> vertices = support(row);
        const auto closer = [&](int a, int b) { return distance(search, a) < distance(search, b); };
        const auto nearest = std::min_element(vertices.begin(), vertices.end(), closer);
        if (nearest != vertices.end()) offer_faces(*nearest, search);  // so that few others need a look
        for (const int vertex : vertices) offer_faces(vertex, search);
        return prefer_agreeing(search.any, search.agreeing);
    }

  private:
    struct Search {
        Vec3 centre, normal;
        Best any, agreeing;

        /// No face farther away can matter.
        double squared_limit() const {
            return std::min(std::max(any.squared_distance, agreeing.squared_distance),
                            farther_for_agreement * farther_for_agreement * any.squared_distance);
        }
    };

    double distance(const Search& search, int vertex) const {
        return (target_.vertex(vertex) - search.centre).norm();
    }

    std::vector<int> support(int row) const {
        double maximum = 0;
        for (SparseMatrix::InnerIterator entry(plan_, row); entry; ++entry)
            maximum = std::max(maximum, entry.value());
        std::vector<int> vertices;
        for (SparseMatrix::InnerIterator entry(plan_, row); entry; ++entry)
            if (entry.value() > 0 && entry.value() >= support_share * maximum)
                vertices.push_back(int(entry.col()));
        return vertices;
    }

    /// Mean of the target's normals, weighted by the row: the side of a thin part on which most of the mass
    /// lies. Zero where the row's normals cancel.
    Vec3 predicted_normal(int row) const {
        Vec3 sum = Vec3::Zero();
        double mass = 0;
        for (SparseMatrix::InnerIterator entry(plan_, row); entry; ++entry) {
            sum += entry.value() * normals_.row(entry.col()).transpose();
            mass += entry.value();
        }
        return sum.norm() >= reliable_normal * mass ? sum : Vec3::Zero();
    }

    void offer_faces(int vertex, Search& search) const {
        const double gap = distance(search, vertex) - longest_edge_[vertex];
        if (gap > 0 && gap * gap > search.squared_limit()) return;
        for (const int face : faces_[vertex]) offer_face(face, search);
    }

    void offer_face(int face, Search& search) const {
        const auto corners = target_.faces.row(face);
        const SurfacePoint candidate{
            face, closest_barycentric(search.centre, target_.vertex(corners[0]), target_.vertex(corners[1]),
                                      target_.vertex(corners[2]))};
        const double squared = (position(target_, candidate) - search.centre).squaredNorm();
        search.any.offer(candidate, squared);
        if (face_normal(target_, face).dot(search.normal) > 0) search.agreeing.offer(candidate, squared);
    }

    const Points& centres_;
    const SparseMatrix& plan_;
    const TriangleMesh& target_;
    Adjacency faces_;
    VertexData<double> longest_edge_;
    Points normals_;
};

/// Closest points on the whole target; the normals predicted for them are those of the source's faces with
/// the centres as corners.
class NearestReader {
  public:
    NearestReader(const Points& centres, const TriangleMesh& source, const TriangleMesh& target)
        : centres_(centres), closest_(target), normals_(vertex_normals({centres, source.faces})) {}

    SurfacePoint operator()(int row) const {
        const Vec3 centre = centres_.row(row).transpose(), normal = normals_.row(row).transpose();
        const auto any = closest_(centre);
        if (normal.isZero(0)) return any.point;
        const auto agreeing = closest_(centre, normal);
        return prefer_agreeing({any.point, any.squared_distance},
                               {agreeing.point, agreeing.squared_distance});
    }

  private:
    const Points& centres_;
    ClosestPoint closest_;
    Points normals_;
};

bool is_every_vertex(const std::vector<int>& samples, const TriangleMesh& mesh) {
    if (int(samples.size()) != mesh.vertex_count()) return false;
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (samples[i] != int(i)) return false;
    return true;
}

PointMap nearest_images(const Points& centres, const TriangleMesh& source, const TriangleMesh& target) {
    PointMap images(std::size_t(source.vertex_count()));
    const NearestReader read(centres, source, target);
    parallel_for_each_index<int>(int(images.size()), 64, [&](int i) { images[std::size_t(i)] = read(i); });
    return images;
}

PointMap supported_images(const Points& centres, const SparseMatrix& plan, const TriangleMesh& source,
                          const TriangleMesh& target) {
    PointMap images(std::size_t(source.vertex_count()));
    const SupportReader read(centres, plan, target);
    parallel_for_each_index<int>(int(images.size()), 64, [&](int i) { images[std::size_t(i)] = read(i); });
    std::unique_ptr<NearestReader> nearest;
    for (std::size_t i = 0; i < images.size(); ++i) {
        if (images[i].face >= 0) continue;
        if (!nearest) nearest = std::make_unique<NearestReader>(centres, source, target);
        images[i] = (*nearest)(int(i));
    }
    return images;
}

void require_vertices(Eigen::Index count, const TriangleMesh& mesh) {
    if (count != mesh.vertex_count())
        throw ArtifactError("the plan has images for " + std::to_string(count) +
                            " vertices, its surface has " + std::to_string(mesh.vertex_count()) +
                            "; rerun varimap-diffuse and varimap-refine");
}

}  // namespace

void pin_landmarks(MapPair& maps, const PairRecord& record, const Surface& A, const Surface& B) {
    if (!record.pins_landmarks() || !record.landmark_points.empty()) return;  // points lie between vertices
    const PointMap on_A = points_at_vertices(A.mesh), on_B = points_at_vertices(B.mesh);
    for (const auto& [a, b] : record.landmarks) {
        maps.A_to_B[std::size_t(a.index)] = on_B[std::size_t(b.index)];
        maps.B_to_A[std::size_t(b.index)] = on_A[std::size_t(a.index)];
    }
}

PointMap images_at(const std::vector<int>& vertices, const TriangleMesh& target) {
    const PointMap points = points_at_vertices(target);
    PointMap images;
    for (const int vertex : vertices) images.push_back(points[std::size_t(vertex)]);
    return images;
}

MapPair read_out(const Plan& plan, const Surface& A, const Surface& B) {
    require_vertices(plan.centre_A.rows(), A.mesh);
    require_vertices(plan.centre_B.rows(), B.mesh);
    MapPair maps;
    if (is_every_vertex(plan.plan.samples_A, A.mesh) && is_every_vertex(plan.plan.samples_B, B.mesh)) {
        maps.A_to_B = supported_images(plan.centre_A, plan.plan.entries, A.mesh, B.mesh);
        const SparseMatrix transposed = plan.plan.entries.transpose();
        maps.B_to_A = supported_images(plan.centre_B, transposed, B.mesh, A.mesh);
    } else {
        maps.A_to_B = nearest_images(plan.centre_A, A.mesh, B.mesh);
        maps.B_to_A = nearest_images(plan.centre_B, B.mesh, A.mesh);
    }
    pin_landmarks(maps, plan.record, A, B);
    return maps;
}

MapPair read_out(const Diffusion& diffusion, const Surface& A, const Surface& B) {
    require_vertices(Eigen::Index(diffusion.image_vertex_A.size()), A.mesh);
    require_vertices(Eigen::Index(diffusion.image_vertex_B.size()), B.mesh);
    MapPair maps{images_at(diffusion.image_vertex_A, B.mesh), images_at(diffusion.image_vertex_B, A.mesh)};
    pin_landmarks(maps, diffusion.record, A, B);
    return maps;
}

}  // namespace varimap
