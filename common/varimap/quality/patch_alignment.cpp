#include "varimap/quality/patch_alignment.h"

#include <cmath>

#include "varimap/core/parallel.h"
#include "varimap/core/rotation.h"

namespace varimap {

void PatchAlignment::add_patches(const RowMatrix& distance, double radius, const Eigen::VectorXd& weight) {
    for (Eigen::Index k = 0; k < distance.rows(); ++k) {
        Patch patch{{}, weight[k]};
        for (int v = 0; v < int(distance.cols()); ++v)
            if (distance(k, v) < radius) patch.vertices.push_back(v);
        patches_.push_back(std::move(patch));
    }
}

double PatchAlignment::aligned(const Patch& patch, const Points& images, const Points& image_normals,
                               bool opposed) const {
    double mass = 0;
    Vec3 centre = Vec3::Zero(), image_centre = Vec3::Zero();
    for (const int v : patch.vertices) {
        mass += mass_[v];
        centre += mass_[v] * vertices_.row(v).transpose();
        image_centre += mass_[v] * images.row(v).transpose();
    }
    centre /= mass, image_centre /= mass;
    Eigen::Matrix3d of_points = Eigen::Matrix3d::Zero(), of_normals = Eigen::Matrix3d::Zero();
    double spread = 0, image_spread = 0;
    for (const int v : patch.vertices) {
        const double share = mass_[v] / mass;
        const Vec3 x = vertices_.row(v).transpose() - centre, y = images.row(v).transpose() - image_centre;
        spread += share * x.squaredNorm();
        image_spread += share * y.squaredNorm();
        of_points += share * y * x.transpose();
        of_normals += share * image_normals.row(v).transpose() * normals_.row(v);
    }
    if (const double scale = std::sqrt(spread * image_spread); scale > 0) of_normals += of_points / scale;
    return nearest_rotation(of_normals, opposed).cwiseProduct(of_normals).sum() / 2;  // trace(R' M)
}

double PatchAlignment::operator()(const Points& images, const Points& image_normals, bool opposed) const {
    std::vector<double> of_patch(patches_.size());
    parallel_for_each_index(of_patch.size(), std::size_t(16), [&](std::size_t k) {
        of_patch[k] = aligned(patches_[k], images, image_normals, opposed);
    });
    double sum = 0, weight = 0;
    for (std::size_t k = 0; k < of_patch.size(); ++k) {
        sum += patches_[k].weight * of_patch[k];
        weight += patches_[k].weight;
    }
    return sum / weight;
}

}  // namespace varimap
