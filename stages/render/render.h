#pragma once

#include <string>
#include <vector>

#include "stages/render/params.h"
#include "varimap/mesh/triangle_mesh.h"
#include "varimap/results/candidates.h"

namespace varimap {

/// 8-bit sRGB, three bytes a pixel, rows from the top.
struct Image {
    int width = 0, height = 0;
    std::vector<unsigned char> rgb;
};

/// The source and the target from two opposite views: four panels in a row (source, source from behind,
/// target, target from behind) where the surfaces are tall, else two columns (source, target) and two rows.
///
/// The source is coloured by position (SourceColour). A point of the target gets the colour of the point of
/// the source closest to its image under target_to_source, linear on target triangles; grey where a corner
/// has no image. Landmarks, if any, are marked with dots and numbers; a line below tells the size of the
/// checkerboard's cells and, where they are shown, the number of reversed triangles, which the log has, too.
/// Throws InputError where a map does not fit the meshes.
Image render(const TriangleMesh& source, const TriangleMesh& target, const PointMap& source_to_target,
             const PointMap& target_to_source, const RenderParams& params, const PointPairs& landmarks = {});

/// Several maps beside each other, with labels: the source, then the target with the source's colours carried
/// by each of them, all from the same two views. `told`: a vertex of `source`, marked as its images on
/// `target` are. Throws InputError where a map does not fit the meshes.
Image render_candidates(const TriangleMesh& source, const TriangleMesh& target,
                        const std::vector<PointMap>& target_to_source, const TellingVertex& told,
                        const RenderParams& params);

/// How the map changes areas and angles (the rows of Fig. 15): three columns with the transported mass by the
/// mass at each vertex, the area ratio of each triangle, and its conformal distortion (quality.h), on the
/// source under source_to_target above and on the target under target_to_source below; at the bottom the
/// scales. Mass ratios are given per vertex; NaN, and triangles without an image, are grey. Throws InputError
/// where something does not fit.
Image render_distortion(const TriangleMesh& source, const TriangleMesh& target,
                        const PointMap& source_to_target, const PointMap& target_to_source,
                        const Eigen::VectorXd& source_masses, const Eigen::VectorXd& target_masses,
                        const RenderParams& params);

/// Reads `vertex,ratio` of varimap-remesh; vertices that it does not name get NaN.
Eigen::VectorXd read_csv_masses(const std::string& path, int vertices);

/// The bytes of a PNG file.
std::string to_png(const Image& image);

}  // namespace varimap
