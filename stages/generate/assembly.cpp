#include "stages/generate/assembly.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "stages/generate/meshes.h"

namespace varimap::shapes {

namespace {

using Form = AssemblyPart::Form;

/// Draws proportions.
class DrawnSizes {
  public:
    DrawnSizes(Random& random, double variation) : random_(random), variation_(variation) {}
    /// About the middle of the range, of which variation 1 takes all; never less than the tenth of `low`.
    double operator()(double low, double high) {
        const double middle = (low + high) / 2, drawn = random_.between(low, high);
        return std::max(middle + variation_ * (drawn - middle), low / 10);
    }

  private:
    Random& random_;
    double variation_;
};

using Parts = std::vector<AssemblyPart>;

void add_legs(Parts& parts, double width, double depth, double height, double thick) {
    for (const double x : {0., width - thick})
        for (const double y : {0., depth - thick})
            parts.push_back({Form::box, {x, y, 0}, {x + thick, y + thick, height}});
}

Parts chair_parts(DrawnSizes& draw, bool with_arms) {
    const double width = draw(.8, 1.5), depth = draw(.8, 1.2), height = draw(.5, 1.1), thick = draw(.08, .2),
                 back = draw(.6, 1.3), leg = draw(.07, .14), arm = draw(.2, .45) * back,
                 seat = height + thick;
    Parts parts{{Form::box, {0, 0, height}, {width, depth, seat}}};
    add_legs(parts, width, depth, height, leg);
    parts.push_back({Form::box, {0, depth - thick, seat}, {width, depth, seat + back}});
    if (!with_arms) return parts;
    for (const double x : {0., width - leg}) {
        parts.push_back({Form::box, {x, .1 * depth, seat}, {x + leg, .1 * depth + leg, seat + arm}});
        parts.push_back({Form::box, {x, 0, seat + arm}, {x + leg, depth - thick, seat + arm + leg}});
    }
    return parts;
}

Parts table_parts(DrawnSizes& draw) {
    const double width = draw(1.2, 2.2), depth = draw(.8, 1.1), height = draw(.6, 1.1),
                 thick = draw(.06, .15), leg = draw(.06, .14), shelf = draw(.2, .5) * height,
                 top = height + thick;
    Parts parts{{Form::box, {0, 0, height}, {width, depth, top}}};
    add_legs(parts, width, depth, height, leg);
    parts.push_back({Form::box, {leg, leg, shelf}, {width - leg, depth - leg, shelf + thick}});
    const Vec3 box(.1 * width, .1 * depth, top);
    parts.push_back({Form::box, box, box + Vec3(.3, .2, .25)});
    return parts;
}

Parts car_parts(DrawnSizes& draw) {
    const double width = draw(.8, 1.1), length = draw(2, 3), height = draw(.35, .6), wheel = draw(.18, .3),
                 cabin = draw(.3, .5), begin = draw(.25, .4) * length, end = begin + draw(.35, .5) * length,
                 top = wheel + height;
    Parts parts{{Form::box, {0, 0, wheel}, {length, width, top}},
                {Form::box, {begin, .05, top}, {end, width - .05, top + cabin}}};
    for (const double x : {.2 * length, .8 * length})
        for (const double y : {-.15, width})
            parts.push_back({Form::along_y, {x - wheel, y, 0}, {x + wheel, y + .15, 2 * wheel}});
    parts.push_back({Form::box, {-.12, .1, wheel}, {0, width - .1, wheel + .5 * height}});
    parts.push_back({Form::box, {.9 * length, .1, top}, {.95 * length, width - .1, top + draw(.15, .3)}});
    return parts;
}

Parts robot_parts(DrawnSizes& draw) {
    const double width = draw(.6, .9), depth = draw(.35, .5), height = draw(.8, 1.2), leg = draw(.6, 1),
                 thick = draw(.12, .2), head = draw(.2, .32), arm = draw(.6, 1), neck = leg + height;
    Parts parts{{Form::box, {-width / 2, -depth / 2, leg}, {width / 2, depth / 2, neck}},
                {Form::ball, {-head, -1.2 * head, neck}, {head, 1.2 * head, neck + 2 * head}}};
    for (const double side : {-1., 1.}) {
        const double hip = side * std::max(width / 4, thick), shoulder = side * (width / 2 + thick);
        parts.push_back({Form::along_z, {hip - thick, -thick, 0}, {hip + thick, thick, leg}});
        parts.push_back({Form::box, {hip - thick, -.45, 0}, {hip + thick, -thick, .15}});
        parts.push_back(
            {Form::along_z, {shoulder - thick, -thick, neck - arm}, {shoulder + thick, thick, neck}});
    }
    return parts;
}

Assembly draw_assembly(unsigned kind, DrawnSizes& draw) {
    switch (kind) {
        case 0:
            return {"chair of parts", chair_parts(draw, false)};
        case 1:
            return {"armchair of parts", chair_parts(draw, true)};
        case 2:
            return {"table of parts", table_parts(draw)};
        case 3:
            return {"car of parts", car_parts(draw)};
        default:
            return {"robot of parts", robot_parts(draw)};
    }
}

/// A point of the cube from -1 to 1, which becomes one of the part.
Vec3 place_on(const AssemblyPart& part, Vec3 p) {
    const auto round_off = [&](std::array<int, 2> axes) {
        const double norm = std::hypot(p[axes[0]], p[axes[1]]);
        const double factor = norm > 0 ? std::max(std::abs(p[axes[0]]), std::abs(p[axes[1]])) / norm : 1;
        for (const int axis : axes) p[axis] *= factor;
    };
    switch (part.form) {
        case Form::along_y:
            round_off({0, 2});
            break;
        case Form::along_z:
            round_off({0, 1});
            break;
        case Form::ball:
            p.normalize();
            break;
        case Form::box:
            break;
    }
    return (part.low + part.high) / 2 + p.cwiseProduct(part.high - part.low) / 2;
}

/// The cube from -1 to 1, each of its sides of cells x cells squares; outwards.
TriangleMesh cube(int cells) {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> faces;
    std::map<std::array<int, 3>, int> numbers;
    const auto number_of = [&](const std::array<int, 3>& at) {
        const auto [entry, is_new] = numbers.try_emplace(at, int(points.size()));
        if (is_new) points.push_back(2. / cells * Vec3(at[0], at[1], at[2]) - Vec3::Ones());
        return entry->second;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const int end : {0, cells})
            for (int i = 0; i < cells; ++i)
                for (int j = 0; j < cells; ++j) {
                    const auto corner = [&](int u, int v) {
                        std::array<int, 3> at{};
                        at[std::size_t(axis)] = end;
                        at[std::size_t((axis + 1) % 3)] = i + u;
                        at[std::size_t((axis + 2) % 3)] = j + v;
                        return number_of(at);
                    };
                    int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
                    if (end == 0) std::swap(b, d);
                    faces.push_back({a, b, c});
                    faces.push_back({a, c, d});
                }
    return make_mesh(points, faces);
}

}  // namespace

std::array<Assembly, 2> assemblies(unsigned seed, double variation, Random& random) {
    constexpr unsigned kinds = 5;
    DrawnSizes draw(random, variation);
    Assembly first = draw_assembly(seed % kinds, draw);
    return {std::move(first), draw_assembly(seed % kinds, draw)};
}

TriangleMesh assembled(const Assembly& assembly, int vertices) {
    // A cube of n x n squares a side has 6 n n + 2 vertices.
    const double of_each = double(vertices) / double(assembly.parts.size());
    const TriangleMesh one = cube(std::max(2, int(std::lround(std::sqrt(of_each / 6)))));
    const int count = int(assembly.parts.size()), n = one.vertex_count(), m = one.face_count();
    TriangleMesh mesh;
    mesh.vertices.resize(count * n, 3);
    mesh.faces.resize(count * m, 3);
    for (int part = 0; part < count; ++part) {
        for (int v = 0; v < n; ++v)
            mesh.vertices.row(part * n + v) =
                place_on(assembly.parts[std::size_t(part)], one.vertex(v)).transpose();
        mesh.faces.middleRows(part * m, m) = one.faces.array() + part * n;
    }
    return mesh;
}

Points partners(const TriangleMesh& mesh, const Assembly& from, const Assembly& to) {
    const int of_each = mesh.vertex_count() / int(from.parts.size());
    Points images(mesh.vertex_count(), 3);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const AssemblyPart &here = from.parts[std::size_t(v / of_each)],
                           &there = to.parts[std::size_t(v / of_each)];
        const Vec3 within = (mesh.vertex(v) - here.low).cwiseQuotient(here.high - here.low);
        images.row(v) = (there.low + within.cwiseProduct(there.high - there.low)).transpose();
    }
    return images;
}

}  // namespace varimap::shapes
