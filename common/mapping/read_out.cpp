#include <cmath>
#include <limits>
#include <memory>

#include "common/mapping/plan.h"
#include "common/mesh/closest_point.h"
#include "common/mesh/surface.h"
#include "common/stage/error.h"
#include "common/stage/parallel.h"

namespace varimap {

namespace {

constexpr double support_share = 0.05;  ///< of its row's maximum: entries from here on span the support
/// A face that agrees with the predicted normal is taken up to this multiple of the smallest distance. Where
/// a shrunken centre lies between the two sides of a thin part this decides for the right one; where the
/// prediction is wrong (a mirrored part) the other side is too far away for it to do harm.
constexpr double reach_for_agreement = 3;
constexpr double reliable_normal = 0.3;  ///< length of a mean of unit normals below which it says nothing

/// Faces around each vertex, in ascending order, and how far they reach from it.
struct VertexFaces {
    std::vector<int> offset, face;
    std::vector<double> reach;

    explicit VertexFaces(const TriangleMesh& mesh)
        : offset(std::size_t(mesh.vertex_count()) + 1),
          face(std::size_t(mesh.faces.size())),
          reach(std::size_t(mesh.vertex_count())) {
        for (Eigen::Index k = 0; k < mesh.faces.size(); ++k) ++offset[std::size_t(mesh.faces.data()[k]) + 1];
        for (std::size_t v = 1; v < offset.size(); ++v) offset[v] += offset[v - 1];
        std::vector<int> next(offset.begin(), offset.end() - 1);
        for (Eigen::Index k = 0; k < mesh.faces.size(); ++k) {
            const int v = mesh.faces.data()[k];
            face[std::size_t(next[std::size_t(v)]++)] = int(k / 3);
            for (int corner = 0; corner < 3; ++corner)
                reach[std::size_t(v)] = std::max(
                    reach[std::size_t(v)], (mesh.vertex(mesh.faces(k / 3, corner)) - mesh.vertex(v)).norm());
        }
    }
};

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
    const double limit = reach_for_agreement * reach_for_agreement * any.squared_distance;
    return agreeing.point.face >= 0 && agreeing.squared_distance <= limit ? agreeing.point : any.point;
}

/// Closest points on the faces that touch the supports of a plan's rows.
class SupportReader {
  public:
    SupportReader(const Points& centres, const SparseMatrix& plan, const TriangleMesh& target)
        : centres_(centres),
          plan_(plan),
          target_(target),
          around_(target),
          normals_(vertex_normals(target)) {}

    /// face -1 if the row is empty.
    SurfacePoint operator()(int row) const {
        const Vec3 centre = centres_.row(row).transpose();
        const Vec3 normal = predicted_normal(row);
        const double threshold = support_share * row_maximum(row);
        Best any, agreeing;
        for (SparseMatrix::InnerIterator entry(plan_, row); entry; ++entry)
            if (entry.value() > 0 && entry.value() >= threshold)
                offer_faces(int(entry.col()), centre, normal, any, agreeing);
        return prefer_agreeing(any, agreeing);
    }

  private:
    double row_maximum(int row) const {
        double maximum = 0;
        for (SparseMatrix::InnerIterator entry(plan_, row); entry; ++entry)
            maximum = std::max(maximum, entry.value());
        return maximum;
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

    void offer_faces(int vertex, const Vec3& centre, const Vec3& normal, Best& any, Best& agreeing) const {
        const double gap = (target_.vertex(vertex) - centre).norm() - around_.reach[std::size_t(vertex)];
        if (gap > 0 && gap * gap > std::max(any.squared_distance, agreeing.squared_distance)) return;
        for (int k = around_.offset[std::size_t(vertex)]; k < around_.offset[std::size_t(vertex) + 1]; ++k) {
            SurfacePoint candidate{around_.face[std::size_t(k)], {}};
            const auto corners = target_.faces.row(candidate.face);
            candidate.barycentric = closest_barycentric(
                centre, target_.vertex(corners[0]), target_.vertex(corners[1]), target_.vertex(corners[2]));
            const double distance = (position(target_, candidate) - centre).squaredNorm();
            any.offer(candidate, distance);
            if (face_normal(target_, candidate.face).dot(normal) > 0) agreeing.offer(candidate, distance);
        }
    }

    const Points& centres_;
    const SparseMatrix& plan_;
    const TriangleMesh& target_;
    VertexFaces around_;
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

SurfacePoint at_vertex(const TriangleMesh& mesh, int vertex) {
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int corner = 0; corner < 3; ++corner)
            if (mesh.faces(f, corner) == vertex) return {f, Vec3::Unit(corner)};
    throw ArtifactError("landmark " + std::to_string(vertex) + " lies on no face; rerun varimap-diffuse");
}

void require_matching(const Points& centres, const TriangleMesh& mesh) {
    if (centres.rows() != mesh.vertex_count())
        throw ArtifactError("the plan has centres for " + std::to_string(centres.rows()) +
                            " vertices, its surface has " + std::to_string(mesh.vertex_count()) +
                            "; rerun varimap-diffuse and varimap-refine");
    if (!centres.allFinite())
        throw ConvergenceError(
            "the plan has centres that are not finite; rerun varimap-refine with a larger gamma");
}

}  // namespace

VertexMaps read_out(const Plan& plan, const Surface& A, const Surface& B) {
    require_matching(plan.position_A, A.mesh);
    require_matching(plan.position_B, B.mesh);
    VertexMaps maps;
    if (is_every_vertex(plan.samples_A, A.mesh) && is_every_vertex(plan.samples_B, B.mesh)) {
        maps.A_to_B = supported_images(plan.position_A, plan.plan, A.mesh, B.mesh);
        const SparseMatrix transposed = plan.plan.transpose();
        maps.B_to_A = supported_images(plan.position_B, transposed, B.mesh, A.mesh);
    } else {
        maps.A_to_B = nearest_images(plan.position_A, A.mesh, B.mesh);
        maps.B_to_A = nearest_images(plan.position_B, B.mesh, A.mesh);
    }
    for (const auto& [a, b] : plan.landmarks) {
        maps.A_to_B[std::size_t(a)] = at_vertex(B.mesh, b);
        maps.B_to_A[std::size_t(b)] = at_vertex(A.mesh, a);
    }
    return maps;
}

}  // namespace varimap
