#include "stages/register/results.h"

#include <fmt/format.h>

#include <limits>

#include "varimap/artifact/file_status.h"
#include "varimap/artifact/npy.h"
#include "varimap/landmarks/csv_fields.h"
#include "varimap/mesh_files/mesh_file.h"
#include "varimap/results/map_table.h"

namespace varimap {

ResultFolder::ResultFolder(Stage& stage, const std::string& path) : stage_(stage), path_(path) {
    make_folder(path);
    make_folder((path_ / "specimens").string());
}

void ResultFolder::write(const std::string& name, const std::string& bytes) const {
    stage_.write_file((path_ / name).string(), bytes);
}

namespace {

/// A comma-separated field: in quotes, unless it is plain.
std::string field(const std::string& text) {
    return text.find_first_of(",\"\r\n") == std::string::npos ? text : in_quotes(text);
}

std::string points_csv(const Points& points) {
    std::string text = "vertex,x,y,z\n";
    for (Eigen::Index v = 0; v < points.rows(); ++v)
        text += fmt::format("{},{},{},{}\n", v, points(v, 0), points(v, 1), points(v, 2));
    return text;
}

std::string array_of(const std::vector<Points>& shapes) {
    std::vector<double> numbers;
    for (const Points& shape : shapes)
        numbers.insert(numbers.end(), shape.data(), shape.data() + shape.size());
    return to_npy("<f8", {(long long)(shapes.size()), (long long)(shapes.front().rows()), 3}, numbers);
}

/// Points of the vertices of an extent by the template's numbers; its other vertices at one place.
Points on_template(const Points& points, const Extent& extent, int vertices,
                   const Eigen::RowVector3d& others) {
    Points all = others.replicate(vertices, 1);
    all(extent.vertices, Eigen::all) = points;
    return all;
}

/// A mesh with the template's vertices, of which no face uses those beyond the extent. Their place is that
/// of another, since many programs take no mesh with places that are not numbers.
std::string ply_of(const Points& points, const Extent& extent, const Registration& all, Space space,
                   bool mirrored = false) {
    Faces faces = extent.faces;
    if (mirrored) faces.col(1).swap(faces.col(2));  // or it would be inside out
    return to_ply({on_template(points, extent, all.first.vertex_count(), points.row(0)), faces, space},
                  PlyFormat::ascii);
}

std::string aligned_npy(const ShapeComparison& shapes, const Extents& extents, int vertices) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    std::vector<Points> aligned;
    for (std::size_t i = 0; i < shapes.aligned.size(); ++i)
        aligned.push_back(
            on_template(shapes.aligned[i], extents.of(i), vertices, Eigen::RowVector3d::Constant(none)));
    return array_of(aligned);
}

void write_component_meshes(const ResultFolder& folder, const Registration& all, const Extent& common,
                            const ShapeComparison& shapes) {
    const Points& mean = shapes.mean;
    for (std::size_t k = 0; k < shapes.components.displacement.size(); ++k) {
        const Points two = 2 * shapes.components.displacement[k];
        folder.write(fmt::format("component_{}_minus.ply", k + 1),
                     ply_of(mean - two, common, all, all.first.space));
        folder.write(fmt::format("component_{}_plus.ply", k + 1),
                     ply_of(mean + two, common, all, all.first.space));
    }
}

std::string components_csv(const PrincipalComponents& components) {
    std::string text = "component,variance,share\n";
    for (Eigen::Index k = 0; k < components.variance.size(); ++k) {
        const double share =
            components.total_variance > 0 ? components.variance[k] / components.total_variance : 0;
        text += fmt::format("{},{},{}\n", k + 1, components.variance[k], share);
    }
    return text;
}

/// Parts have no scores.
std::string specimens_csv(const Registration& all, const ShapeComparison& shapes) {
    const Eigen::MatrixXd& scores = shapes.components.scores;
    const auto yes_or_no = [](bool is) { return is ? "yes" : "no"; };
    std::string text = "specimen,size,distance,outlier,part,mirrored";
    for (Eigen::Index k = 0; k < scores.cols(); ++k) text += fmt::format(",pc{}", k + 1);
    text += "\n";
    Eigen::Index whole = 0;
    for (std::size_t i = 0; i < all.names.size(); ++i) {
        text += fmt::format("{},{},{},{},{},{}", field(all.names[i]), shapes.sizes[i], shapes.distances[i],
                            yes_or_no(shapes.is_outlier[i]), yes_or_no(all.is_part[i]),
                            yes_or_no(all.is_mirrored[i]));
        for (Eigen::Index k = 0; k < scores.cols(); ++k)
            text += all.is_part[i] ? "," : fmt::format(",{}", scores(whole, k));
        if (!all.is_part[i]) ++whole;
        text += "\n";
    }
    return text;
}

/// Each vertex of a mesh with these faces at itself; nowhere without a face.
PointMap identity_map(const Faces& faces, int vertices) {
    PointMap identity(std::size_t(vertices), SurfacePoint{});
    for (int f = 0; f < int(faces.rows()); ++f)
        for (int corner = 0; corner < 3; ++corner)
            identity[std::size_t(faces(f, corner))] = {f, Vec3::Unit(corner)};
    return identity;
}

}  // namespace

void write_points(const ResultFolder& folder, const Registration& all, const Extents& extents) {
    folder.write("points.npy", array_of(all.points));
    for (std::size_t i = 0; i < all.names.size(); ++i) {
        folder.write("specimens/" + all.names[i] + ".csv", points_csv(all.points[i]));
        folder.write(
            "specimens/" + all.names[i] + ".ply",
            ply_of(extents.of(i).of(all.points[i]), extents.of(i), all, all.spaces[i], all.is_mirrored[i]));
    }
}

void write_landmarks(const ResultFolder& folder, const Registration& all) {
    std::string csv = "specimen,landmark,x,y,z,confidence,round_trip,spread\n";
    std::vector<Points> positions;
    for (std::size_t i = 0; i < all.transferred.size(); ++i) {
        const TransferredLandmarks& found = all.transferred[i];
        positions.push_back(found.positions);
        for (Eigen::Index k = 0; k < found.positions.rows(); ++k)
            csv += fmt::format("{},{},{},{},{},{:.4f},{:.6f},{:.6f}\n", field(all.names[i]),
                               field(all.landmarks->names[std::size_t(k)]), found.positions(k, 0),
                               found.positions(k, 1), found.positions(k, 2), found.confidence[k],
                               found.round_trip[k], found.spread[k]);
    }
    folder.write("landmarks.csv", csv);
    folder.write("landmarks.npy", array_of(positions));
}

void write_shapes(const ResultFolder& folder, const Registration& all, const Extents& extents,
                  const ShapeComparison& shapes) {
    const int vertices = all.first.vertex_count();
    const Extent& common = extents.common();
    folder.write("aligned.npy", aligned_npy(shapes, extents, vertices));
    folder.write("mean.ply", ply_of(shapes.mean, common, all, all.first.space));
    write_component_meshes(folder, all, common, shapes);
    folder.write("specimens.csv", specimens_csv(all, shapes));
    folder.write("components.csv", components_csv(shapes.components));
    folder.write("identity.csv", to_csv(identity_map(common.faces, vertices)));
}

}  // namespace varimap
