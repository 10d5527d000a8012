#include "stages/transfer/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "stages/transfer/seams.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"

namespace varimap {

namespace {

constexpr double square_tolerance = 1e-3;
constexpr double rim = 1e-6;            ///< of a face, in barycentric coordinates, where rounding decides
constexpr double few_overlaps = 1e-3;   ///< of what is drawn: rounding along seams makes that
constexpr double grey_tolerance = .01;  ///< many programs write a grey Kd beside every image

/// Colours of the source's faces by their materials.
class Paint {
  public:
    Paint(const TriangleMesh& mesh, const Texture& texture) : atlas_(mesh, texture.model) {
        for (const std::string& name : texture.model.materials) {
            const Material* material = texture.materials.find(name);
            paints_.push_back(material == nullptr ? Entry{} : entry_of(*material));
        }
    }
    Rgba operator()(const SurfacePoint& point) const {
        const int material = atlas_.material(point.face);
        const Entry none, &entry = material < 0 ? none : paints_[std::size_t(material)];
        if (entry.image.width == 0) return entry.colour;
        const Vec2 uv = entry.scale.cwiseProduct(atlas_(point)) + entry.offset;
        Rgba colour = sample_image(entry.image, uv);
        colour[3] *= entry.colour[3] / 255;
        return colour;
    }

  private:
    struct Entry {
        Rgba colour{204, 204, 204, 255};
        TextureImage image;
        Vec2 scale = Vec2::Ones(), offset = Vec2::Zero();  ///< of texture coordinates
    };
    static Entry entry_of(const Material& material) {
        const Vec3 rgb = 255 * material.colour.cwiseMax(0).cwiseMin(1);
        Entry entry{{rgb[0], rgb[1], rgb[2], 255 * material.opacity},
                    {},
                    material.texture_scale,
                    material.texture_offset};
        if (material.texture.empty()) return entry;
        entry.image = read_png(material.texture);
        if (material.colour.maxCoeff() - material.colour.minCoeff() > grey_tolerance)
            warn("{}: is baked as it is, not times the colour Kd of its material", material.texture);
        return entry;
    }
    Atlas atlas_;
    std::vector<Entry> paints_;
};

/// What of the target lies on the centre of each pixel.
struct PixelLayout {
    std::vector<SurfacePoint> on;  ///< the first face that lies there
    std::vector<char> overlapped;  ///< whether another one lies there, too
};

/// The first and the last pixel of a row between whose centres and a triangle a common point may lie.
std::pair<int, int> pixels_of_row(const Eigen::Matrix<double, 2, 3>& corner, int y, int n) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int k = 0; k < 3; ++k) {
        const Vec2 a = corner.col(k), b = corner.col((k + 1) % 3);
        if (std::min(a[1], b[1]) > y || std::max(a[1], b[1]) < y) continue;
        const double rise = b[1] - a[1];
        const double from = rise == 0 ? a[0] : a[0] + (y - a[1]) / rise * (b[0] - a[0]);
        const double to = rise == 0 ? b[0] : from;
        low = std::min({low, from, to});
        high = std::max({high, from, to});
    }
    if (low > high) return {0, -1};
    // Rounding decides on the rim: barycentric coordinates do.
    return {std::max(0, int(std::floor(low))), std::min(n - 1, int(std::ceil(high)))};
}

/// Lays a face on the pixels on whose centres it lies, of n x n, and returns how many these are. `corner`: in
/// pixels from the centre of the first one.
int lay(PixelLayout& layout, int face, const Eigen::Matrix<double, 2, 3>& corner, int n) {
    Eigen::Matrix2d sides;
    sides << corner.col(1) - corner.col(0), corner.col(2) - corner.col(0);
    if (!(std::abs(sides.determinant()) > 1e-12)) return 0;
    const Eigen::Matrix2d inverse = sides.inverse();
    const int top = std::max(0, int(std::ceil(corner.row(1).minCoeff()))),
              bottom = std::min(n - 1, int(corner.row(1).maxCoeff()));
    int laid = 0;
    for (int y = top; y <= bottom; ++y) {
        const auto [left, right] = pixels_of_row(corner, y, n);
        for (int x = left; x <= right; ++x) {
            const Vec2 b = inverse * (Vec2(x, y) - corner.col(0));
            const Vec3 at(1 - b.sum(), b[0], b[1]);
            if (at.minCoeff() < 0) continue;
            ++laid;
            const std::size_t pixel = std::size_t(y) * std::size_t(n) + std::size_t(x);
            SurfacePoint& first = layout.on[pixel];
            if (first.face < 0)
                first = {face, at};
            else if (std::min(at.minCoeff(), first.barycentric.minCoeff()) > rim)
                layout.overlapped[pixel] = 1;
        }
    }
    return laid;
}

PixelLayout faces_on_pixels(const ObjModel& target, const std::string& path, int n) {
    const std::size_t pixels = std::size_t(n) * std::size_t(n);
    constexpr int most_layers = 32;  // in the mean; what is drawn twice on purpose has a few
    double laid = 0;
    PixelLayout layout{std::vector<SurfacePoint>(pixels), std::vector<char>(pixels, 0)};
    for (int f = 0; f < int(target.uv_of.rows()); ++f) {
        Eigen::Matrix<double, 2, 3> corner;
        for (int k = 0; k < 3; ++k) {
            const Vec2& uv = target.uv[std::size_t(target.uv_of(f, k))];
            corner.col(k) = Vec2(uv[0] * n - .5, (1 - uv[1]) * n - .5);
        }
        laid += lay(layout, f, corner, n);
        if (laid > most_layers * double(pixels))
            throw InputError(fmt::format(
                "{}: more than {} faces lie over each other in its texture coordinates, as with a "
                "tiled texture; give --onto an OBJ whose faces have a place each",
                path, most_layers));
    }
    return layout;
}

/// Refuses a layout on which nothing is drawn, and warns of one on which much is drawn twice.
void check_layout(const PixelLayout& layout, const std::string& path, int pixels) {
    const auto drawn = std::count_if(layout.on.begin(), layout.on.end(),
                                     [](const SurfacePoint& point) { return point.face >= 0; });
    if (drawn == 0)
        throw InputError(
            fmt::format("{}: its texture coordinates cover none of {} x {} pixels; give --onto an "
                        "OBJ with others, or leave out --bake to have the source's cut onto it",
                        path, pixels, pixels));
    const auto twice = std::count(layout.overlapped.begin(), layout.overlapped.end(), 1);
    const double share = double(twice) / double(drawn);
    if (share > few_overlaps)
        warn(
            "{}: faces overlap in its texture coordinates on {:.1f} % of the pixels they cover, where the "
            "first of them is drawn",
            path, 100 * share);
}

/// Pixels beside coloured ones get their mean, in one round.
void grow(TextureImage& image) {
    const TextureImage before = image;
    parallel_for_each_index(image.height, 16, [&](int y) {
        for (int x = 0; x < image.width; ++x) {
            if (before.pixel(x, y)[3] > 0) continue;
            Rgba sum = Rgba::Zero();
            int count = 0;
            for (int j = std::max(0, y - 1); j <= std::min(image.height - 1, y + 1); ++j)
                for (int i = std::max(0, x - 1); i <= std::min(image.width - 1, x + 1); ++i) {
                    const unsigned char* at = before.pixel(i, j);
                    if (at[3] == 0) continue;
                    sum += Rgba(at[0], at[1], at[2], at[3]);
                    ++count;
                }
            for (int k = 0; k < 4 && count > 0; ++k)
                image.pixel(x, y)[k] = static_cast<unsigned char>(std::lround(sum[k] / count));
        }
    });
}

void require_square(const ObjModel& target, const std::string& path) {
    for (const int uv : target.uv_of.reshaped()) {
        const Vec2& at = target.uv[std::size_t(uv)];
        if (at.minCoeff() < -square_tolerance || at.maxCoeff() > 1 + square_tolerance)
            throw InputError(
                fmt::format("{}: texture coordinates ({:.4g}, {:.4g}) lie outside the square "
                            "from 0 to 1, which is all that can be baked",
                            path, at[0], at[1]));
    }
}

}  // namespace

TextureImage bake(const Correspondence& map, const PointCarrier& back, const Texture& texture,
                  const ObjModel& target, const std::string& target_file, const BakeSize& size) {
    require_square(target, target_file);
    const Paint paint(map.from, texture);
    const PixelLayout layout = faces_on_pixels(target, target_file, size.pixels);
    check_layout(layout, target_file, size.pixels);
    const std::vector<SurfacePoint>& on = layout.on;
    TextureImage image(size.pixels, size.pixels);
    parallel_for_each_index(int(on.size()), 256, [&](int i) {
        const SurfacePoint source = back(on[std::size_t(i)]);
        if (source.face < 0) return;
        const Rgba colour = paint(source);
        for (int k = 0; k < 4; ++k)
            image.rgba[4 * std::size_t(i) + std::size_t(k)] =
                static_cast<unsigned char>(std::clamp(std::lround(colour[k]), k == 3 ? 1l : 0l, 255l));
    });
    for (int i = 0; i < (size.padding < 0 ? 8 : size.padding); ++i) grow(image);
    return image;
}

}  // namespace varimap
