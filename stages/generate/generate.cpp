#include "stages/generate/generate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "stages/generate/assembly.h"
#include "stages/generate/families.h"
#include "stages/generate/isometric.h"
#include "stages/generate/merged.h"
#include "stages/generate/meshes.h"
#include "stages/generate/partner.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/index_set.h"
#include "varimap/core/printable.h"
#include "varimap/mesh/coarsening.h"
#include "varimap/mesh_files/mesh_file.h"

namespace varimap {

namespace {

using TruePair = GeneratedPair::TruePair;

constexpr const char *any = "any", *assembly = "assembly";

/// A shape and its mesh at rest.
struct Shape {
    shapes::Body body;
    TriangleMesh rest;

    TriangleMesh posed() const {
        TriangleMesh mesh = rest;
        for (int v = 0; v < mesh.vertex_count(); ++v)
            mesh.vertices.row(v) = body.posed(mesh.vertex(v)).transpose();
        return mesh;
    }
};

/// `vertices`, or some number by the seed.
int vertices_of(const GenerateParams& params, shapes::Random& random) {
    const int by_seed = int(random.between(2000, 6000));
    return params.vertices > 0 ? params.vertices : by_seed;
}

void sort_by_distance(std::vector<TruePair>& rows) {
    std::sort(rows.begin(), rows.end(),
              [](const TruePair& a, const TruePair& b) { return a.squared_distance < b.squared_distance; });
}

/// Pairs of these source vertices and the vertices, of those of the target, at their true images; only the
/// fifth of them whose images are nearest to a vertex, so that the target's tessellation hardly counts as an
/// error. Of many vertices, some thousands are asked.
std::vector<TruePair> true_pairs(const std::vector<int>& vertices, const Points& images,
                                 const Points& target) {
    std::vector<TruePair> rows;
    const std::size_t step = std::max<std::size_t>(1, vertices.size() / 6000);
    for (std::size_t i = 0; i < vertices.size(); i += step) {
        int nearest;
        const double squared =
            (target.rowwise() - images.row(Eigen::Index(i))).rowwise().squaredNorm().minCoeff(&nearest);
        rows.push_back({squared, vertices[i], nearest});
    }
    sort_by_distance(rows);
    rows.resize(rows.size() / 5);
    return rows;
}

/// Where the target is put in space.
class Placement {
  public:
    explicit Placement(shapes::Random& random)
        : scale_(random.between(0.1, 10)), angle_(random.between(0, 3)) {}
    TriangleMesh operator()(TriangleMesh mesh) const {
        return shapes::moved(std::move(mesh), scale_, angle_, {1, -2, 3});
    }

  private:
    double scale_, angle_;
};

/// Of vertices that shapes::shuffled took from these.
std::vector<int> new_numbers(const std::vector<int>& old_vertex) {
    std::vector<int> numbers(old_vertex.size());
    for (std::size_t v = 0; v < old_vertex.size(); ++v) numbers[std::size_t(old_vertex[v])] = int(v);
    return numbers;
}

GeneratedPair isometric_pair(unsigned seed, const GenerateParams& params) {
    const auto [kind, body] = shapes::isometric_shape(seed);
    shapes::Random random(seed + 1000);
    const auto draw = [&, &body = body] {
        const int vertices = vertices_of(params, random);
        return Shape{body, body.mesh(vertices, random.rotation())};
    };
    const Shape source = draw(), target = draw();
    const Placement placed(random);
    GeneratedPair pair{kind, source.rest, shapes::shuffled(placed(target.posed()), seed), {}};
    pair.truth = true_pairs(all_indices(source.rest.vertex_count()), placed(source.posed()).vertices,
                            pair.target.vertices);
    return pair;
}

/// A member with the surface of a ball. Where limbs touch that were drawn too close, another is drawn.
Shape draw_member(int family, const GenerateParams& params, shapes::Random& random) {
    for (int attempt = 0; attempt < 100; ++attempt) {
        shapes::Body body = shapes::family_member(family, params, random);
        const int vertices = vertices_of(params, random);
        if (auto mesh = body.sphere_mesh(vertices, random.rotation())) return {std::move(body), *mesh};
    }
    throw InputError("limbs touch in every member that was drawn: take less variation or relief");
}

/// What is known of the way from one posed body to another with the same limbs.
GeneratedPair pair_of(const std::string& name, const Shape& source, const Shape& target, unsigned seed,
                      const Placement& placed) {
    GeneratedPair pair{name, source.posed(), shapes::shuffled(placed(target.posed()), seed), {}};
    const shapes::Partner partner(source.body, target.body);
    std::vector<int> vertices;
    std::vector<Vec3> partners;  // at rest
    for (int v = 0; v < source.rest.vertex_count(); ++v)
        if (const auto image = partner(source.rest.vertex(v))) {
            vertices.push_back(v);
            partners.push_back(*image);
        }
    const Shape images{target.body, shapes::make_mesh(partners, {})};
    pair.truth = true_pairs(vertices, placed(images.posed()).vertices, pair.target.vertices);
    return pair;
}

/// Of points of the first body at rest, those that all others have, as the nearest vertices of all posed
/// meshes.
std::vector<std::vector<int>> common_vertices(const std::vector<Shape>& members) {
    const Shape& first = members.front();
    std::vector<shapes::Partner> partners;
    std::vector<TriangleMesh> posed;
    for (const Shape& member : members) {
        partners.emplace_back(first.body, member.body);
        posed.push_back(member.posed());
    }
    std::vector<std::vector<int>> rows(members.size());
    const int step = std::max(1, first.rest.vertex_count() / 1000);
    for (int v = 0; v < first.rest.vertex_count(); v += step) {
        std::vector<int> row;
        for (std::size_t m = 0; m < members.size(); ++m) {
            const auto image = partners[m](first.rest.vertex(v));
            if (!image) break;
            row.emplace_back();
            (posed[m].vertices.rowwise() - members[m].body.posed(*image).transpose())
                .rowwise()
                .squaredNorm()
                .minCoeff(&row.back());
        }
        if (row.size() < members.size()) continue;
        for (std::size_t m = 0; m < members.size(); ++m) rows[m].push_back(row[m]);
    }
    return rows;
}

GeneratedPair family_pair(int family, unsigned seed, const GenerateParams& params) {
    shapes::Random random(16 * seed + unsigned(family));
    const Shape source = draw_member(family, params, random), target = draw_member(family, params, random);
    return pair_of(shapes::family_names()[std::size_t(family)], source, target, seed, Placement(random));
}

/// The same bodies for every seed, differently tessellated.
GeneratedPair merged_pair(const std::string& name, std::pair<shapes::Body, shapes::Body> bodies,
                          unsigned seed, const GenerateParams& params) {
    shapes::Random random(seed);
    const auto meshed = [&](shapes::Body& body) {
        const int vertices = vertices_of(params, random);
        const TriangleMesh fine = body.mesh(3 * vertices, random.rotation());
        return Shape{std::move(body), coarsen(fine, vertices).mesh};
    };
    const Shape source = meshed(bodies.first), target = meshed(bodies.second);
    return pair_of(name, source, target, seed, Placement(random));
}

GeneratedPair assembly_pair(unsigned seed, const GenerateParams& params) {
    shapes::Random random(seed);
    const auto [source, target] = shapes::assemblies(seed, params.variation, random);
    const auto meshed = [&](const shapes::Assembly& one) {
        return shapes::assembled(one, vertices_of(params, random));
    };
    const TriangleMesh here = meshed(source), there = meshed(target);
    const Placement placed(random);
    const TriangleMesh there_placed = placed(there);
    std::vector<int> old_vertex;
    GeneratedPair pair{source.kind, here, shapes::shuffled(there_placed, seed, &old_vertex), {}};
    const std::vector<int> renumbered = new_numbers(old_vertex);
    const Points images = placed({shapes::partners(here, source, target), here.faces}).vertices;
    // Part by part: where parts touch, the nearest vertex of all may be another's.
    const int parts = int(source.parts.size()), of_each = here.vertex_count() / parts,
              there_of_each = there.vertex_count() / parts;
    for (int part = 0; part < parts; ++part) {
        std::vector<int> vertices = all_indices(of_each);
        for (int& v : vertices) v += part * of_each;
        for (const TruePair& row :
             true_pairs(vertices, images.middleRows(part * of_each, of_each),
                        there_placed.vertices.middleRows(part * there_of_each, there_of_each)))
            pair.truth.push_back({row.squared_distance, row.source,
                                  renumbered[std::size_t(part * there_of_each + row.target)]});
    }
    sort_by_distance(pair.truth);
    return pair;
}

/// Throws UsageError where what only families take is given to another.
void require_defaults(const GenerateParams& params, const char* why) {
    const GenerateParams usual;
    const auto require = [&](const char* name, double value, double usual_value) {
        if (value != usual_value) throw UsageError(fmt::format("--{} is for families; {}", name, why));
    };
    require("variation", params.variation, usual.variation);
    require("build", params.build, usual.build);
    require("bending", params.bending, usual.bending);
    require("asymmetry", params.asymmetry, usual.asymmetry);
    require("missing", params.missing, usual.missing);
    require("relief", params.relief, usual.relief);
}

/// Six pairs, each next one farthest from those before.
std::string landmarks(const GeneratedPair& pair) {
    const std::vector<TruePair>& rows = pair.truth;
    std::vector<double> nearest(rows.size(), std::numeric_limits<double>::infinity());
    std::string list;
    std::size_t next = 0;
    for (int i = 0; i < std::min(6, int(rows.size())); ++i) {
        list += fmt::format("{} {}\n", rows[next].source, rows[next].target);
        for (std::size_t k = 0; k < rows.size(); ++k)
            nearest[k] = std::min(
                nearest[k],
                (pair.source.vertex(rows[k].source) - pair.source.vertex(rows[next].source)).squaredNorm());
        next = std::size_t(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    }
    return list;
}

/// The number of a family of family_names().
int family_number(const std::string& family) {
    const auto& names = shapes::family_names();
    const auto found = std::find(names.begin(), names.end(), family);
    if (found == names.end())
        throw UsageError(fmt::format("no family '{}'; there are {}", printable(family),
                                     fmt::join(generated_families(), ", ")));
    return int(found - names.begin());
}

/// A family and its parameters, drawn so that pairs differ about as real ones do; animals and people are
/// drawn most often. Ranges were chosen by hand.
GeneratedPair any_pair(unsigned seed, GenerateParams params) {
    shapes::Random random(seed);
    const std::vector<const char*> drawn{"biped",     "biped",     "biped",     "quadruped",
                                         "quadruped", "quadruped", "quadruped", "quadruped",
                                         "hand",      "bone",      "tool",      "chair"};
    const int family = family_number(drawn[std::size_t(random.between(0, double(drawn.size())))]);
    const auto often = [&](double most) { return std::max(0.0, random.between(-most, most)); };
    params.variation = random.between(0.3, 1.4);
    params.bending = random.between(0, 1.6);
    params.relief = random.between(0.003, 0.025);
    params.asymmetry = often(0.6);
    params.missing = often(0.4);
    params.build = often(1.2);
    return family_pair(family, seed, params);
}

void require_vertices(const GenerateParams& params) {
    if (params.vertices != 0 && params.vertices < 500)
        throw UsageError(fmt::format("--vertices {}: give 500 or more, or 0", params.vertices));
}

std::string lines_of(const std::vector<int>& numbers) {
    return fmt::format("{}\n", fmt::join(numbers, "\n"));
}

}  // namespace

std::vector<std::string> generated_families() {
    std::vector<std::string> names{"isometric", any, assembly};
    for (const auto& others : {shapes::family_names(), shapes::merged_names()})
        names.insert(names.end(), others.begin(), others.end());
    return names;
}

GeneratedPair generate(const std::string& family, unsigned seed, const GenerateParams& params) {
    require_vertices(params);
    if (family == "isometric") {
        require_defaults(params, "shapes of isometric are copies, bent");
        return isometric_pair(seed, params);
    }
    if (family == any) {
        require_defaults(params, "the seed draws it for any");
        return any_pair(seed, params);
    }
    if (family == assembly) {
        GenerateParams others = params;
        others.variation = GenerateParams().variation;  // which assemblies have, too
        require_defaults(others, "parts of an assembly are stiff");
        return assembly_pair(seed, params);
    }
    if (auto bodies = shapes::merged_pair(family, params))
        return merged_pair(family, std::move(*bodies), seed, params);
    return family_pair(family_number(family), seed, params);
}

GeneratedCollection generate_collection(const std::string& family, unsigned seed,
                                        const GenerateParams& params) {
    require_vertices(params);
    const auto& names = generated_families();
    if (std::count(names.begin(), names.end(), family) > 0 &&
        std::count(shapes::family_names().begin(), shapes::family_names().end(), family) == 0)
        throw UsageError(fmt::format("--members is for families whose members differ: {}",
                                     fmt::join(shapes::family_names(), ", ")));
    const int number = family_number(family);
    shapes::Random random(16 * seed + unsigned(number));
    std::vector<Shape> members;
    for (int m = 0; m < params.members; ++m) members.push_back(draw_member(number, params, random));
    GeneratedCollection collection{family, {}, {}};
    const auto rows = common_vertices(members);
    for (std::size_t m = 0; m < members.size(); ++m) {
        std::vector<int> old_vertex;
        collection.meshes.push_back(
            shapes::shuffled(Placement(random)(members[m].posed()), seed + unsigned(m), &old_vertex));
        const std::vector<int> renumbered = new_numbers(old_vertex);
        collection.vertices.emplace_back();
        for (const int v : rows[m]) collection.vertices.back().push_back(renumbered[std::size_t(v)]);
    }
    return collection;
}

void write_collection(const GeneratedCollection& collection, const std::string& folder) {
    for (std::size_t m = 0; m < collection.meshes.size(); ++m) {
        const std::string name = fmt::format("{}/{}_{:03}", folder, collection.kind, m);
        write_file_atomically(name + ".txt", lines_of(collection.vertices[m]));
        write_file_atomically(name + ".ply", to_ply(collection.meshes[m]));
    }
}

void write_pair(const GeneratedPair& pair, const std::string& folder) {
    std::string source_list, target_list;
    for (const TruePair& row : pair.truth) {
        source_list += fmt::format("{}\n", row.source);
        target_list += fmt::format("{}\n", row.target);
    }
    write_file_atomically(folder + "/source.txt", source_list);
    write_file_atomically(folder + "/target.txt", target_list);
    write_file_atomically(folder + "/landmarks.txt", landmarks(pair));
    write_file_atomically(folder + "/source.ply", to_ply(pair.source));
    write_file_atomically(folder + "/target.ply", to_ply(pair.target));
}

}  // namespace varimap
