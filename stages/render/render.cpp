#include "stages/render/render.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string_view>

#include "stages/render/distortion.h"
#include "stages/render/figure.h"
#include "stages/render/panels.h"
#include "stages/render/view.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/image/png_file.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/mesh/unit_area.h"
#include "varimap/mesh_files/text_scanner.h"
#include "varimap/quality/image_mesh.h"

namespace varimap {

namespace {

void require_fit(const PointMap& map, const TriangleMesh& from, const TriangleMesh& to, const char* name,
                 const char* from_name, const char* to_name) {
    if (int(map.size()) != from.vertex_count())
        throw InputError(fmt::format("{} has {} rows, but the {} mesh has {} vertices", name, map.size(),
                                     from_name, from.vertex_count()));
    for (size_t v = 0; v < map.size(); ++v)
        if (map[v].face >= to.face_count())
            throw InputError(fmt::format("{} sends vertex {} to face {}, but the {} mesh has {} faces", name,
                                         v, map[v].face, to_name, to.face_count()));
}

std::vector<bool> have_image(const PointMap& map) {
    std::vector<bool> result;
    for (const SurfacePoint& point : map) result.push_back(point.face >= 0);
    return result;
}

void require_visible(const TriangleMesh& source, const TriangleMesh& target) {
    if (!(surface_area(source) > 0) || !(surface_area(target) > 0))
        throw InputError("a mesh without area cannot be shown");
}

/// Colour at the source's point closest to the image of a point of the target; `map`: of the target's
/// vertices, from which `back` was made.
Colour carried_colour(const PointMap& map, const ImageMesh& back, const ClosestPoint& closest,
                      const SourceColour& colour, const SurfacePoint& point) {
    if (!back.is_mapped(point.face)) return unmapped_colour;
    const int near = map[std::size_t(back.image.faces(point.face, 0))].face;
    return colour(position(back.target, closest(position(back.image, point), near).point));
}

std::string checkerboard_text(double cell, const TriangleMesh& source) {
    return fmt::format("squares are {:.3g} sqrt(area) wide: {:.3g} in the source's file", cell,
                       cell * std::sqrt(surface_area(source)));
}

/// Each map has a row for every vertex of the one mesh, on faces of the other.
void require_fit(const PointMap& source_to_target, const PointMap& target_to_source,
                 const TriangleMesh& source, const TriangleMesh& target) {
    require_fit(source_to_target, source, target, "source_to_target", "source", "target");
    require_fit(target_to_source, target, source, "target_to_source", "target", "source");
}

}  // namespace

Image render(const TriangleMesh& source, const TriangleMesh& target, const PointMap& source_to_target,
             const PointMap& target_to_source, const RenderParams& params, const PointPairs& landmarks) {
    require_visible(source, target);
    require_fit(source_to_target, target_to_source, source, target);
    const ImageMesh there(source_to_target, source, target), back(target_to_source, target, source);
    const SourceColour colour(there.source, params.checker);
    const ClosestPoint closest(there.source);
    const auto flags = [&](const ImageMesh& images) {
        return params.flips ? reversed_faces(images, params.mirror)
                            : std::vector<bool>(size_t(images.source.face_count()));
    };
    const std::vector<bool> source_flags = flags(there), target_flags = flags(back);
    const Figure source_figure(
        there.source, [&](const SurfacePoint& p) { return colour(position(there.source, p)); }, source_flags);
    const Figure target_figure(
        back.source,
        [&](const SurfacePoint& p) { return carried_colour(target_to_source, back, closest, colour, p); },
        target_flags);
    const View source_view = natural_view(source, params.up);
    const View target_view =
        matching_view(back.source, back.image.vertices, have_image(target_to_source), source_view);
    std::vector<Vec3> source_points, target_points;
    for (const auto& [on_source, on_target] : landmarks) {
        source_points.push_back(position(there.source, on_source));
        target_points.push_back(position(back.source, on_target));
    }
    std::vector<std::string> caption{checkerboard_text(params.checker, source)};
    if (params.flips) {
        caption.push_back(reversed_text(source_flags, target_flags));
        log("{}", caption.back());
    }
    return draw_panels({{&source_figure, source_view, "source", std::move(source_points)},
                        {&target_figure, target_view, "target", std::move(target_points)}},
                       caption, params);
}

Image render_candidates(const TriangleMesh& source, const TriangleMesh& target,
                        const std::vector<PointMap>& target_to_source, const TellingVertex& told,
                        const RenderParams& params) {
    const TriangleMesh at_unit_area = unit_area(source);
    const SourceColour colour(at_unit_area, params.checker);
    const ClosestPoint closest(at_unit_area);
    const auto figure = [](const TriangleMesh& mesh, const Figure::Paint& paint) {
        return std::make_unique<Figure>(mesh, paint, std::vector<bool>(size_t(mesh.face_count())));
    };
    const View source_view = natural_view(source, params.up);
    std::vector<std::unique_ptr<Figure>> figures;
    figures.push_back(
        figure(at_unit_area, [&](const SurfacePoint& p) { return colour(position(at_unit_area, p)); }));
    const auto marked = [](const TriangleMesh& mesh, int vertex) {
        return vertex < 0 ? std::vector<Vec3>() : std::vector<Vec3>{mesh.vertex(vertex)};
    };
    std::vector<Exhibit> exhibits{
        {figures[0].get(), source_view, "source", marked(at_unit_area, told.source)}};
    for (const PointMap& map : target_to_source) {
        require_fit(map, target, source, "a candidate", "target", "source");
        const auto back = std::make_shared<ImageMesh>(map, target, source);
        figures.push_back(figure(back->source, [&, back](const SurfacePoint& p) {
            return carried_colour(map, *back, closest, colour, p);
        }));
        const View view = exhibits.size() > 1 ? exhibits[1].view  // the same for all, for comparison
                                              : matching_view(back->source, back->image.vertices,
                                                              have_image(map), source_view);
        exhibits.push_back(
            {figures.back().get(), view, fmt::format("candidate {}", exhibits.size()),
             marked(back->source, told.images.empty() ? -1 : told.images[exhibits.size() - 1])});
    }
    return draw_panels(exhibits, {}, params);
}

Image render_distortion(const TriangleMesh& source, const TriangleMesh& target,
                        const PointMap& source_to_target, const PointMap& target_to_source,
                        const Eigen::VectorXd& source_masses, const Eigen::VectorXd& target_masses,
                        const RenderParams& params) {
    require_visible(source, target);
    require_fit(source_to_target, target_to_source, source, target);
    const ImageMesh back(target_to_source, target, source);
    const View source_view = natural_view(source, params.up);
    const View target_view =
        matching_view(back.source, back.image.vertices, have_image(target_to_source), source_view);
    return draw_distortion({unit_area(source), measure_triangles(source_to_target, source, target),
                            source_masses, moved(source_view, params.azimuth, params.elevation)},
                           {unit_area(target), measure_triangles(target_to_source, target, source),
                            target_masses, moved(target_view, params.azimuth, params.elevation)},
                           params);
}

std::string to_png(const Image& image) {
    return encode_png(image.width, image.height, image.rgb);
}

Eigen::VectorXd read_csv_masses(const std::string& path, int vertices) {
    const std::string bytes = read_file(path);
    std::string_view lines = bytes;
    if (split_off_line(lines) != "vertex,ratio") fail_at(path, 1, "expected vertex,ratio");
    Eigen::VectorXd masses = Eigen::VectorXd::Constant(vertices, std::nan(""));
    for (int number = 2; !lines.empty(); ++number) {
        const std::string_view line = split_off_line(lines);
        const std::size_t comma = line.find(',');
        long long vertex = -1;
        double ratio = 0;
        if (comma == line.npos || !to_integer(line.substr(0, comma), vertex) || vertex < 0 ||
            vertex >= vertices || !to_number(line.substr(comma + 1), ratio))
            fail_at(path, number, fmt::format("expected a vertex below {} and its ratio", vertices));
        masses[vertex] = ratio;
    }
    return masses;
}

}  // namespace varimap
