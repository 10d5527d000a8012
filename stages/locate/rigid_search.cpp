#include "stages/locate/rigid_search.h"

#include <algorithm>
#include <cmath>

#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/core/rotation.h"
#include "varimap/mesh/boundary.h"
#include "varimap/mesh/closest_point.h"

namespace varimap {

namespace {

// Chosen on ten parts by hand, not swept.
constexpr int bases = 4, places = 250, turns = 12;  ///< poses that are tried: their product
constexpr std::size_t measured = 60;                ///< vertices of the part that misfits are measured at
constexpr std::size_t slid = 100, kept = 20;         ///< poses that differ
/// In units of sqrt(area) of the part.
constexpr double tolerance = 0.12, fine_tolerance = 0.06, landmark_tolerance = 0.3, differing = 0.15;

/// x -> turn x + shift, of a part as large as it is on the whole.
struct Pose {
    Eigen::Matrix3d turn;
    Vec3 shift;
    double misfit = 0;

    Vec3 operator()(const Vec3& x) const { return turn * x + shift; }
};

/// A unit vector of the plane with this normal, its turn by a right angle, and the normal.
Eigen::Matrix3d frame(const Vec3& normal, double angle) {
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const Vec3 x = std::cos(angle) * u + std::sin(angle) * v;
    Eigen::Matrix3d axes;
    axes << x, normal.cross(x), normal;
    return axes;
}

class RigidSearch {
  public:
    RigidSearch(const Sketches& sketches, const Sides& sides, double share)
        : sketches_(sketches),
          sides_(sides),
          whole_(sides.whole.mesh),
          root_(std::sqrt(share)),
          handedness_(sides.are_opposed() ? -1 : 1),
          points_(root_ * sides.part.mesh.vertices),
          normals_(vertex_normals(sides.part.mesh)),
          face_normals_(whole_.face_count(), 3),
          samples_(spread_vertices(sketches.part.data.hierarchy, measured)),
          closest_(whole_) {
        for (int f = 0; f < whole_.face_count(); ++f)
            face_normals_.row(f) = face_normal(whole_, f).normalized().transpose();
    }

    std::vector<PointMap> run() const {
        std::vector<Pose> poses = all_poses();
        measure(poses, tolerance);
        poses = distinct(std::move(poses), slid);
        parallel_for_each_index(poses.size(), std::size_t(1), [&](std::size_t k) {
            slide(poses[k], tolerance, 8);
            slide(poses[k], fine_tolerance, 6);
        });
        measure(poses, fine_tolerance);
        poses = distinct(std::move(poses), kept);
        std::vector<PointMap> images;
        for (const Pose& pose : poses) images.push_back(images_of(pose));
        if (!poses.empty())
            log("{} rigid poses, misfits {:.3f} to {:.3f}", poses.size(), poses.front().misfit,
                poses.back().misfit);
        return images;
    }

  private:
    /// Of the faces that the part's vertices should lie on.
    Vec3 normal(const Pose& pose, int v) const {
        return handedness_ * (pose.turn * normals_.row(v).transpose());
    }
    double agreement(const ClosestPoint::Hit& hit, const Vec3& normal, double within) const {
        return std::exp(-hit.squared_distance / (within * within)) *
               std::max(0.0, face_normals_.row(hit.point.face).dot(normal));
    }

    /// Vertices far from the rim, which are sure to have a partner, and from each other.
    std::vector<int> base_vertices() const {
        const Boundary rim = find_boundary(sketches_.part.mesh());
        if (rim.edges.empty())
            return {samples_.begin(),
                    samples_.begin() + std::min<std::ptrdiff_t>(bases, std::ptrdiff_t(samples_.size()))};
        std::vector<int> on_rim;
        for (const auto& edge : rim.edges) on_rim.push_back(edge[0]);
        std::vector<double> depth(std::size_t(points_.rows()), 0);
        GeodesicBall(sketches_.part.graph).grow(on_rim, [&](int v, double distance) {
            depth[std::size_t(v)] = distance;
            return true;
        });
        std::vector<int> chosen{int(std::max_element(depth.begin(), depth.end()) - depth.begin())};
        const double enough = 0.3 * depth[std::size_t(chosen.front())];
        for (const int v : samples_)
            if (int(chosen.size()) < bases && v != chosen.front() && depth[std::size_t(v)] > enough)
                chosen.push_back(v);
        return chosen;
    }
    std::vector<Pose> all_poses() const {
        const Points normals = vertex_normals(whole_);
        std::vector<Pose> poses;
        for (const int base : base_vertices()) {
            const Eigen::Matrix3d from = frame(normals_.row(base).transpose(), 0);
            for (const int place : spread_vertices(sketches_.whole.data.hierarchy, places))
                for (int k = 0; k < turns; ++k) {
                    Eigen::Matrix3d to = frame(normals.row(place).transpose(), 2 * M_PI * k / turns);
                    to.col(2) *= handedness_;
                    const Eigen::Matrix3d turn = to * from.transpose();
                    poses.push_back({turn, whole_.vertex(place) - turn * points_.row(base).transpose()});
                }
        }
        return poses;
    }

    /// Mean over the landmarks, if there are some; they may be farther off than surfaces that fit.
    double landmark_misfit(const Pose& pose) const {
        double sum = 0;
        for (std::size_t i = 0; i < sides_.landmarks_part.size(); ++i) {
            const Vec3 off = pose(points_.row(sides_.landmarks_part[i]).transpose()) -
                             whole_.vertex(sides_.landmarks_whole[i]);
            sum += 1 - std::exp(-off.squaredNorm() / std::pow(landmark_tolerance * root_, 2));
        }
        return sum / std::max<double>(1, double(sides_.landmarks_part.size()));
    }
    void measure(std::vector<Pose>& poses, double within) const {
        parallel_for_each_index(poses.size(), std::size_t(16), [&](std::size_t k) {
            double sum = 0;
            for (const int v : samples_)
                sum += 1 - agreement(closest_(poses[k](points_.row(v).transpose())), normal(poses[k], v),
                                     within * root_);
            poses[k].misfit = sum / double(samples_.size()) + landmark_misfit(poses[k]);
        });
    }
    /// The best `most` that lay the part in places that differ.
    std::vector<Pose> distinct(std::vector<Pose> poses, std::size_t most) const {
        std::stable_sort(poses.begin(), poses.end(),
                         [](const Pose& a, const Pose& b) { return a.misfit < b.misfit; });
        const Points all = points_(samples_, Eigen::all);
        const auto laid = [&](const Pose& pose) {
            return Points((all * pose.turn.transpose()).rowwise() + pose.shift.transpose());
        };
        std::vector<Pose> result;
        std::vector<Points> where;
        for (const Pose& pose : poses) {
            if (result.size() >= most) break;
            Points here = laid(pose);
            if (std::any_of(where.begin(), where.end(), [&](const Points& there) {
                    return (here - there).rowwise().norm().mean() < differing * root_;
                }))
                continue;
            result.push_back(pose);
            where.push_back(std::move(here));
        }
        return result;
    }
    /// Steps of iterated closest points, each weighted by how well it agrees.
    void slide(Pose& pose, double within, int steps) const {
        for (int step = 0; step < steps; ++step) {
            Points from(Eigen::Index(samples_.size()), 3), to(from);
            Eigen::VectorXd weight(from.rows());
            for (Eigen::Index i = 0; i < from.rows(); ++i) {
                const int v = samples_[std::size_t(i)];
                const ClosestPoint::Hit hit = closest_(pose(points_.row(v).transpose()), normal(pose, v));
                from.row(i) = points_.row(v);
                to.row(i) = position(whole_, hit.point).transpose();
                weight[i] = agreement(hit, normal(pose, v), within * root_);
            }
            const double sum = weight.sum();
            if (!(sum > 1e-9)) return;
            const Eigen::RowVector3d from_mean = weight.transpose() * from / sum,
                                     to_mean = weight.transpose() * to / sum;
            pose.turn = nearest_rotation(
                (to.rowwise() - to_mean).transpose() * weight.asDiagonal() * (from.rowwise() - from_mean),
                handedness_ < 0);
            pose.shift = (to_mean - from_mean * pose.turn.transpose()).transpose();
        }
    }
    PointMap images_of(const Pose& pose) const {
        PointMap images;
        for (int v = 0; v < int(points_.rows()); ++v)
            images.push_back(closest_(pose(points_.row(v).transpose()), normal(pose, v)).point);
        return images;
    }

    const Sketches& sketches_;
    const Sides& sides_;
    const TriangleMesh& whole_;
    double root_;        ///< of the part's share: lengths of its mesh times this are those on the whole
    double handedness_;  ///< -1: of surfaces of opposite handedness, where poses are reflections
    Points points_, normals_, face_normals_;
    std::vector<int> samples_;
    ClosestPoint closest_;
};

}  // namespace

std::vector<PointMap> rigid_guesses(const Sketches& sketches, const Sides& sides, double share) {
    return RigidSearch(sketches, sides, share).run();
}

}  // namespace varimap
