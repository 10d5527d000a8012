#include "stages/render/render.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fixtures/shapes.h"
#include "fixtures/temporary_folder.h"
#include "stages/render/colour.h"
#include "stages/render/figure.h"
#include "stages/render/view.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

/// An egg that stands upright along y and has no symmetry but about y; open at the bottom.
TriangleMesh egg(int rings, int sectors) {
    TriangleMesh mesh{Points(rings * sectors + 1, 3), Faces((2 * rings - 1) * sectors, 3)};
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            const double u = .9 * std::numbers::pi * (i + 1) / rings, v = 2 * std::numbers::pi * j / sectors;
            mesh.vertices.row(i * sectors + j) << 1.1 * std::sin(u) * std::sin(v), 2 * std::cos(u),
                (1 + .2 * std::cos(u)) * std::sin(u) * std::cos(v);
        }
    mesh.vertices.row(rings * sectors) << 0, 2, 0;
    int f = 0;
    for (int j = 0; j < sectors; ++j) {
        const int next = (j + 1) % sectors;
        mesh.faces.row(f++) << rings * sectors, j, next;
        for (int i = 0; i + 1 < rings; ++i) {
            const int a = i * sectors + j, b = i * sectors + next;
            mesh.faces.row(f++) << a, a + sectors, b + sectors;
            mesh.faces.row(f++) << a, b + sectors, b;
        }
    }
    return mesh;
}

PointMap identity(const TriangleMesh& mesh) {
    PointMap map(size_t(mesh.vertex_count()));
    for (int f = 0; f < mesh.face_count(); ++f)
        for (int k = 0; k < 3; ++k) map[size_t(mesh.faces(f, k))] = {f, Vec3::Unit(k)};
    return map;
}

RenderParams small() {
    RenderParams params;
    params.width = 400;
    params.samples = 9;
    return params;
}

using Pixel = std::array<int, 3>;
Pixel pixel(const Image& image, int x, int y) {
    const unsigned char* p = &image.rgb[3 * size_t(y * image.width + x)];
    return {p[0], p[1], p[2]};
}
const Pixel white{255, 255, 255};
constexpr int strip = 2 * 7;  ///< height of the letters above and below, with their margins

int image_half(const Image& image) {
    return image.height / 2;
}

class Render : public testing::Test {
  protected:
    const TriangleMesh mesh_ = egg(20, 30);
    const PointMap map_ = identity(mesh_);
};

TEST_F(Render, HasTheWidthAskedForAndAWhiteBackground) {
    const Image image = render(mesh_, mesh_, map_, map_, small());
    ASSERT_EQ(image.width, 400);
    ASSERT_EQ(image.rgb.size(), 3 * size_t(image.width) * size_t(image.height));
    for (int x : {0, 100, 200, 300, 399}) {
        EXPECT_EQ(pixel(image, x, 0), white);
        EXPECT_EQ(pixel(image, x, image.height - 1), white);
    }
    // Tall figures stand in a row of four, each in the middle of its panel.
    for (int panel = 0; panel < 4; ++panel)
        EXPECT_NE(pixel(image, 100 * panel + 50, image.height / 2), white);
}

TEST_F(Render, CarriesTheSourcesColoursThroughTheMap) {
    const Image image = render(mesh_, mesh_, map_, map_, small());
    int different = 0, coloured = 0;
    for (int y = strip; y < image.height - strip; ++y)
        for (int x = 0; x < 200; ++x) {
            coloured += pixel(image, x, y) != white;
            different += pixel(image, x, y) != pixel(image, x + 200, y);
        }
    EXPECT_GT(coloured, 10000);
    EXPECT_LT(different, coloured / 500);  // rounding at the edges of cells
}

TEST_F(Render, NamesTheSurfacesAndTellsTheSizeOfTheSquares) {
    const Image image = render(mesh_, mesh_, map_, map_, small());
    const auto letters = [&](int left, int right, int top) {
        int black = 0;
        for (int y = top; y < top + strip; ++y)
            for (int x = left; x < right; ++x) black += pixel(image, x, y) == Pixel{0, 0, 0};
        return black;
    };
    EXPECT_GT(letters(0, 200, 0), 40);
    EXPECT_GT(letters(200, 400, 0), 40);
    EXPECT_GT(letters(0, 400, image.height - strip), 200);
    EXPECT_NE(letters(0, 200, 0), letters(200, 400, 0));  // other words
}

TEST_F(Render, MarksLandmarksWhereTheyAreSeen) {
    // Vertex 600 is the top; one low in front is hidden from behind.
    const int front = 12 * 30;
    const PointPairs landmarks{{map_[600], map_[600]}, {map_[front], map_[front]}};
    const Image plain = render(mesh_, mesh_, map_, map_, small()),
                marked = render(mesh_, mesh_, map_, map_, small(), landmarks);
    const auto changed = [&](int panel, bool top) {
        int count = 0;
        for (int y = 0; y < image_half(plain); ++y)
            for (int x = 100 * panel; x < 100 * (panel + 1); ++x) {
                const int row = top ? y : y + image_half(plain);
                count += pixel(plain, x, row) != pixel(marked, x, row);
            }
        return count;
    };
    for (int panel = 0; panel < 4; ++panel) EXPECT_GT(changed(panel, true), 15);
    EXPECT_GT(changed(0, false), 15);
    EXPECT_EQ(changed(1, false), 0);
    EXPECT_GT(changed(2, false), 15);
    EXPECT_EQ(changed(3, false), 0);
}

TEST_F(Render, CountsReversedTriangles) {
    EXPECT_EQ(reversed_text({true, false, true}, {false}),
              "reversed, in magenta: 2 triangles of the source, 0 of the target");
    RenderParams params = small();
    params.flips = true;
    EXPECT_EQ(render(mesh_, mesh_, map_, map_, params).height,
              render(mesh_, mesh_, map_, map_, small()).height + strip);
}

TEST_F(Render, TurnsTheTargetsViewWithTheMap) {
    TriangleMesh turned = mesh_;  // y up becomes z up
    turned.vertices.col(1) = -mesh_.vertices.col(2);
    turned.vertices.col(2) = mesh_.vertices.col(1);
    const Image straight = render(mesh_, mesh_, map_, map_, small()),
                image = render(mesh_, turned, map_, map_, small());
    ASSERT_EQ(straight.rgb.size(), image.rgb.size());
    int different = 0;
    for (size_t i = 0; i < image.rgb.size(); ++i) different += std::abs(image.rgb[i] - straight.rgb[i]) > 8;
    EXPECT_LT(different, int(image.rgb.size()) / 500);
}

TEST_F(Render, IsTheSameForAnyNumberOfThreads) {
    using tbb::global_control;
    const Image image = render(mesh_, mesh_, map_, map_, small());
    const global_control one(global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(render(mesh_, mesh_, map_, map_, small()).rgb, image.rgb);
}

TEST_F(Render, ShowsWhatHasNoImageInGrey) {
    const Image image = render(mesh_, mesh_, map_, PointMap(map_.size()), small());
    const Pixel p = pixel(image, 250, image.height / 2);
    EXPECT_EQ(p[0], p[1]);
    EXPECT_EQ(p[1], p[2]);
    EXPECT_NE(p, white);
}

TEST_F(Render, ShowsCandidatesBesideEachOther) {
    PointMap other = map_;
    std::reverse(other.begin(), other.end());
    const Image image = render_candidates(mesh_, mesh_, {map_, other}, {}, small());
    const int column = image.width / 3;
    const auto difference = [&](int first, int second) {
        int count = 0;
        for (int y = strip; y < image.height; ++y)
            for (int x = 0; x < column; ++x) {
                const Pixel p = pixel(image, first * column + x, y), q = pixel(image, second * column + x, y);
                for (int k = 0; k < 3; ++k) count += std::abs(p[k] - q[k]) > 40;
            }
        return count;
    };
    EXPECT_GT(difference(1, 2), 5 * difference(0, 1));
    for (int panel : {0, 1, 2}) {
        int black = 0;
        for (int y = 0; y < strip; ++y)
            for (int x = 0; x < column; ++x) black += pixel(image, panel * column + x, y) == Pixel{0, 0, 0};
        EXPECT_GT(black, 50) << panel;
    }
    EXPECT_THROW(render_candidates(mesh_, mesh_, {PointMap(3)}, {}, small()), InputError);
    const Image marked = render_candidates(mesh_, mesh_, {map_, other}, {0, {0, 0}}, small());
    for (int panel : {0, 1, 2}) {
        int changed = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = panel * column; x < (panel + 1) * column; ++x)
                changed += pixel(image, x, y) != pixel(marked, x, y);
        EXPECT_GT(changed, 20) << panel;
    }
}

TEST_F(Render, MarksReversedTrianglesOnDemand) {
    PointMap back = map_;  // the target's middle rings exchange their images
    for (int j = 0; j < 30; ++j) std::swap(back[size_t(9 * 30 + j)], back[size_t(10 * 30 + j)]);
    RenderParams flips = small();
    flips.flips = true;
    const auto marked = [&](const PointMap& map) {
        const Image plain = render(mesh_, mesh_, map_, map, small()),
                    image = render(mesh_, mesh_, map_, map, flips);
        int count = 0;
        for (int y = 0; y < plain.height - strip; ++y)
            for (int x = 0; x < image.width; ++x) count += pixel(image, x, y) != pixel(plain, x, y);
        return count;
    };
    EXPECT_EQ(marked(map_), 0);
    EXPECT_GT(marked(back), 100);
}

TEST_F(Render, MarksTrianglesThatKeepOrientationOfAMirror) {
    TriangleMesh left = mesh_;  // the outside stays outside
    left.vertices.col(2) *= -1;
    left.faces.col(1).swap(left.faces.col(2));
    PointMap map = map_;
    for (SurfacePoint& point : map) std::swap(point.barycentric[1], point.barycentric[2]);
    const auto with_flips = [&](bool flips, bool mirror) {
        RenderParams params = small();
        params.flips = flips, params.mirror = mirror;
        const Image image = render(mesh_, left, map, map_, params);
        const int caption = (flips ? 2 : 1) * strip;
        return std::vector(image.rgb.begin(), image.rgb.end() - 3 * image.width * caption);
    };
    EXPECT_EQ(with_flips(true, true), with_flips(false, true));
    EXPECT_NE(with_flips(true, false), with_flips(false, false));
}

/// Red minus blue of the pixel in the middle of one of three columns, on the source (row 0) or the target
/// (row 1).
int redness(const Image& image, int column, int row) {
    const Pixel p =
        pixel(image, image.width / 6 * (2 * column + 1), image.height * 4 / 10 * row + image.height / 5);
    return p[0] - p[2];
}

TEST_F(Render, ShowsChangesOfMassAreaAndAngle) {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(mesh_.vertex_count());
    const Image image = render_distortion(mesh_, mesh_, map_, map_, 3 * ones, ones / 3, small());
    EXPECT_EQ(image.width, 400);
    EXPECT_GT(redness(image, 0, 0), 50);
    EXPECT_LT(redness(image, 0, 1), -50);
    for (int row : {0, 1}) EXPECT_LT(std::abs(redness(image, 1, row)), 15);  // area is kept: grey
    // The scales: blue to red, and black numbers below.
    const auto of_scale = [&](int x, int k) {
        int y = image.height - 1;
        while (pixel(image, x, y) == white || pixel(image, x, y) == Pixel{0, 0, 0}) --y;
        return pixel(image, x, y)[size_t(k)];
    };
    EXPECT_GT(of_scale(30, 2), of_scale(30, 0));
    EXPECT_GT(of_scale(100, 0), of_scale(100, 2));
    int black = 0;
    for (int y = image.height - 40; y < image.height; ++y)
        for (int x = 0; x < 400; ++x) black += pixel(image, x, y) == Pixel{0, 0, 0};
    EXPECT_GT(black, 200);
}

TEST_F(Render, StretchedTrianglesAreShownAsSuch) {
    TriangleMesh stretched = mesh_;
    stretched.vertices.col(1) *= 4;  // along the axis that points up
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(mesh_.vertex_count());
    const Image same = render_distortion(mesh_, mesh_, map_, map_, ones, ones, small());
    const Image image = render_distortion(mesh_, stretched, map_, map_, ones, ones, small());
    EXPECT_GT(redness(same, 2, 0), 20);  // yellow
    EXPECT_LT(redness(image, 2, 0), 0);  // violet
}

TEST_F(Render, ReadsMassesAndRefusesOthers) {
    const TemporaryFolder folder;
    const auto read = [&](const std::string& text) {
        write_file_atomically(folder / "masses.csv", text);
        return read_csv_masses(folder / "masses.csv", 3);
    };
    const Eigen::VectorXd masses = read("vertex,ratio\n2,0.5\n0,1.25\n");
    EXPECT_EQ(masses[0], 1.25);
    EXPECT_TRUE(std::isnan(masses[1]));
    EXPECT_EQ(masses[2], .5);
    EXPECT_EQ(read("vertex,ratio\r\n1,2\r\n")[1], 2);
    for (const char* bad :
         {"vertex,face\n", "vertex,ratio\n3,1\n", "vertex,ratio\n-1,1\n", "vertex,ratio\n1\n",
          "vertex,ratio\n1,\n", "vertex,ratio\n1,x\n", "vertex,ratio\n1,2,3\n"})
        EXPECT_THROW(read(bad), InputError) << bad;
}

TEST_F(Render, RefusesMapsThatDoNotFit) {
    const PointMap shorter(map_.begin(), map_.end() - 1);
    EXPECT_THROW(render(mesh_, mesh_, shorter, map_, small()), InputError);
    EXPECT_THROW(render(mesh_, mesh_, map_, shorter, small()), InputError);
    TriangleMesh flat = mesh_;
    flat.vertices.setZero();
    EXPECT_THROW(render(mesh_, flat, map_, map_, small()), InputError);
    PointMap beyond = map_;
    beyond[3].face = mesh_.face_count();
    EXPECT_THROW(render(mesh_, mesh_, map_, beyond, small()), InputError);
}

TEST_F(Render, DoesNotShrinkFiguresForVerticesThatNoFaceUses) {
    TriangleMesh stray = mesh_;
    stray.vertices.conservativeResize(mesh_.vertex_count() + 1, 3);
    stray.vertices.bottomRows(1) << 50, 0, 0;
    PointMap map = map_;
    map.emplace_back();
    const Image image = render(stray, stray, map, map, small());
    EXPECT_EQ(image.height, render(mesh_, mesh_, map_, map_, small()).height);
    EXPECT_NE(pixel(image, 50, image.height / 2), white);
}

TEST_F(Render, WritesAPngThatReadsBack) {
    const Image image = render(mesh_, mesh_, map_, map_, small());
    const std::string bytes = to_png(image);
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()));
    header.format = PNG_FORMAT_RGB;
    ASSERT_EQ(int(header.width), image.width);
    ASSERT_EQ(int(header.height), image.height);
    std::vector<unsigned char> rgb(image.rgb.size());
    ASSERT_TRUE(png_image_finish_read(&header, nullptr, rgb.data(), 0, nullptr));
    EXPECT_EQ(rgb, image.rgb);
}

TEST(SourceColour, IsACheckerboardOverASmoothFunction) {
    const TriangleMesh mesh = egg(10, 10);
    const SourceColour colour(mesh, .05);
    const Vec3 p = mesh.vertices.colwise().mean();
    const Vec3 step(.05, 0, 0);  // into the next cell
    EXPECT_LT((colour(p) - colour(p + 2 * step)).norm(), .8 * (colour(p) - colour(p + step)).norm());
    EXPECT_LT((colour(p) - colour(p + .001 * step)).norm(), .01);
}

/// What eyes without cones for middle wavelengths see (Machado, Oliveira and Fernandes 2009), its luminance.
double luminance_to_deuteranopes(const Colour& rgb) {
    const Vec3 seen(.367322 * rgb[0] + .860646 * rgb[1] - .227968 * rgb[2],
                    .280085 * rgb[0] + .672501 * rgb[1] + .047413 * rgb[2],
                    -.011820 * rgb[0] + .042940 * rgb[1] + .968881 * rgb[2]);
    return Vec3(.2126, .7152, .0722).dot(seen);
}

TEST(SourceColour, TellsHalvesApartByLightnessAlone) {
    const TriangleMesh mesh = shapes::ellipsoid(3, Vec3(1, .7, .4));
    const double cell = .2;
    const SourceColour colour(mesh, cell);
    // How much lightness changes within half a square: by the stripes of one half only.
    double change[2] = {0, 0};
    int count[2] = {0, 0};
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.vertex(v), q = p + Vec3(.25 * cell, 0, 0);
        change[p[2] > 0] +=
            std::abs(luminance_to_deuteranopes(colour(p)) - luminance_to_deuteranopes(colour(q)));
        ++count[p[2] > 0];
    }
    EXPECT_GT(change[1] / count[1], 1.5 * change[0] / count[0]);
    // And along the longest axis it grows.
    double before = 0;
    for (double x = -.9; x < 1; x += .2) {
        const double here = luminance_to_deuteranopes(colour(Vec3(x, .01, -.05))) +
                            luminance_to_deuteranopes(colour(Vec3(x, .01 + cell, -.05)));
        EXPECT_GT(here, before);
        before = here;
    }
}

TEST(SourceColour, KnowsOkLab) {
    EXPECT_LT((from_oklch(1, 0, 0) - Colour::Ones()).norm(), 1e-6);
    const Colour red = from_oklch(.627955, .257683, 29.2339 * std::numbers::pi / 180);
    EXPECT_LT((red - Colour(1, 0, 0)).norm(), 1e-3);
    EXPECT_EQ(encode_channel(0), 0);
    EXPECT_EQ(encode_channel(1), 255);
    EXPECT_EQ(encode_channel(.2140411), 127);  // middle of the encoding
}

TEST(View, IsARotationThatKeepsUpUp) {
    const TriangleMesh mesh = egg(10, 10);
    for (const char* up : {"auto", "x", "y", "z"}) {
        const View view = moved(natural_view(mesh, up), 0, 0);
        EXPECT_LT((view * view.transpose() - View::Identity()).norm(), 1e-12) << up;
        EXPECT_NEAR(view.determinant(), 1, 1e-12) << up;
    }
    EXPECT_EQ(Vec3(natural_view(mesh, "z").row(1)), Vec3::UnitZ());
    EXPECT_EQ(Vec3(natural_view(mesh, "-z").row(1)), Vec3(-Vec3::UnitZ()));
    EXPECT_EQ(natural_view(mesh, "-y").row(2), natural_view(mesh, "y").row(2));
    EXPECT_GT(natural_view(mesh, "-y").determinant(), 0);
    EXPECT_EQ(Vec3(natural_view(mesh, "auto").row(1)), Vec3::UnitY());
    EXPECT_LT((moved(natural_view(mesh, "y"), 180, 0).row(2) + natural_view(mesh, "y").row(2)).norm(), 1e-12);
}

}  // namespace
}  // namespace varimap
