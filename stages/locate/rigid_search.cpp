#include "stages/locate/rigid_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stages/locate/rigid_body.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/mesh/boundary.h"

namespace varimap {

namespace {

// Chosen on ten parts by hand, not swept.
constexpr int bases = 4, places = 250, turns = 12;  ///< poses that are tried: their product
constexpr std::size_t measured = 60;                ///< vertices of the part that misfits are measured at
constexpr std::size_t slid = 100, kept = 20;        ///< poses that differ
/// In units of sqrt(area) of the part.
constexpr double tolerance = 0.12, fine_tolerance = 0.06, landmark_tolerance = 0.3, differing = 0.15;

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
          body_(sides, share),
          face_normals_(whole_.face_count(), 3),
          samples_(spread_vertices(sketches.part.data.hierarchy, measured)) {
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
        for (const Pose& pose : poses) images.push_back(body_.images(pose));
        if (!poses.empty())
            log("{} rigid poses, misfits {:.3f} to {:.3f}", poses.size(), poses.front().misfit,
                poses.back().misfit);
        return images;
    }

  private:
    Vec3 point(int v) const { return body_.points().row(v).transpose(); }
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
        std::vector<double> depth(std::size_t(body_.points().rows()), 0);
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
        std::vector<int> where = spread_vertices(sketches_.whole.data.hierarchy, places);
        std::erase_if(where, [&](int v) { return normals.row(v).isZero(0); });
        std::vector<Pose> poses;
        for (const int base : base_vertices()) {
            if (body_.normals().row(base).isZero(0)) continue;
            const Eigen::Matrix3d from = frame(body_.normals().row(base).transpose(), 0);
            for (const int place : where)
                for (int k = 0; k < turns; ++k) {
                    Eigen::Matrix3d to =
                        frame(normals.row(place).transpose(), 2 * std::numbers::pi * k / turns);
                    to.col(2) *= body_.handedness();
                    const Eigen::Matrix3d turn = to * from.transpose();
                    poses.push_back({turn, whole_.vertex(place) - turn * point(base)});
                }
        }
        return poses;
    }

    /// Mean over the landmarks, if there are some; they may be farther off than surfaces that fit.
    double landmark_misfit(const Pose& pose) const {
        double sum = 0;
        for (std::size_t i = 0; i < sides_.landmarks_part.size(); ++i) {
            const Vec3 off = pose(point(sides_.landmarks_part[i])) - whole_.vertex(sides_.landmarks_whole[i]);
            sum += 1 - std::exp(-off.squaredNorm() / std::pow(landmark_tolerance * root_, 2));
        }
        return sum / std::max<double>(1, double(sides_.landmarks_part.size()));
    }
    void measure(std::vector<Pose>& poses, double within) const {
        parallel_for_each_index(poses.size(), std::size_t(16), [&](std::size_t k) {
            double sum = 0;
            for (const int v : samples_)
                sum += 1 - agreement(body_.closest()(poses[k](point(v))), body_.normal(poses[k], v),
                                     within * root_);
            poses[k].misfit = sum / double(samples_.size()) + landmark_misfit(poses[k]);
        });
    }
    /// The best `most` that lay the part in places that differ.
    std::vector<Pose> distinct(std::vector<Pose> poses, std::size_t most) const {
        std::stable_sort(poses.begin(), poses.end(),
                         [](const Pose& a, const Pose& b) { return a.misfit < b.misfit; });
        const Points all = body_.points()(samples_, Eigen::all);
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
            const Points from = body_.points()(samples_, Eigen::all);
            Points to(from.rows(), 3);
            Eigen::VectorXd weight(from.rows());
            for (Eigen::Index i = 0; i < from.rows(); ++i) {
                const int v = samples_[std::size_t(i)];
                const Vec3 normal = body_.normal(pose, v);
                const ClosestPoint::Hit hit = body_.closest()(pose(point(v)), normal);
                to.row(i) = position(whole_, hit.point).transpose();
                weight[i] = agreement(hit, normal, within * root_);
            }
            if (!(weight.sum() > 1e-9)) return;
            pose = body_.fitted(from, to, weight);
        }
    }

    const Sketches& sketches_;
    const Sides& sides_;
    const TriangleMesh& whole_;
    double root_;  ///< of the part's share: lengths of its mesh times this are those on the whole
    RigidBody body_;
    Points face_normals_;  ///< of the whole
    std::vector<int> samples_;
};

}  // namespace

std::vector<PointMap> rigid_guesses(const Sketches& sketches, const Sides& sides, double share) {
    return RigidSearch(sketches, sides, share).run();
}

}  // namespace varimap
