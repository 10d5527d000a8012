// Writes a generated shape and a bent, scaled, turned, renumbered and differently tessellated copy of it:
//   selftest-shapes SEED FOLDER [VERTICES]
// leaves FOLDER/source.ply, target.ply, and their true map as two lists of vertices, source.txt and
// target.txt; prints what kind of shape it is. VERTICES: about so many each, instead of 2000 to 6000; then
// six pairs of the lists, far from each other, go to FOLDER/landmarks.txt.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

#include "selftest/body.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/mesh/io/mesh_file.h"

namespace {

using namespace varimap;

struct TruePair {
    double distance;
    int source, target;
};

/// Source vertices and the target vertices at their true images; only the fifth of the source's vertices
/// whose images are nearest to a vertex, so that the target's tessellation hardly counts as an error. Of many
/// vertices, some thousands are asked.
std::vector<TruePair> true_pairs(const Points& images, const TriangleMesh& target) {
    std::vector<TruePair> rows;
    const int step = std::max(1, int(images.rows()) / 6000);
    for (int v = 0; v < int(images.rows()); v += step) {
        int nearest;
        const double squared =
            (target.vertices.rowwise() - images.row(v)).rowwise().squaredNorm().minCoeff(&nearest);
        rows.push_back({squared, v, nearest});
    }
    std::sort(rows.begin(), rows.end(),
              [](const TruePair& a, const TruePair& b) { return a.distance < b.distance; });
    rows.resize(rows.size() / 5);
    return rows;
}

/// Six pairs, each next one farthest from those before.
void write_landmarks(const std::string& folder, const std::vector<TruePair>& rows,
                     const TriangleMesh& source) {
    std::vector<double> nearest(rows.size(), std::numeric_limits<double>::infinity());
    std::string list;
    size_t next = 0;
    for (int i = 0; i < 6; ++i) {
        list += fmt::format("{} {}\n", rows[next].source, rows[next].target);
        for (size_t k = 0; k < rows.size(); ++k)
            nearest[k] = std::min(
                nearest[k], (source.vertex(rows[k].source) - source.vertex(rows[next].source)).squaredNorm());
        next = size_t(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    }
    write_file_atomically(folder + "/landmarks.txt", list);
}

void write_truth(const std::string& folder, const std::vector<TruePair>& rows) {
    std::string source_list, target_list;
    for (const TruePair& row : rows) {
        source_list += fmt::format("{}\n", row.source);
        target_list += fmt::format("{}\n", row.target);
    }
    write_file_atomically(folder + "/source.txt", source_list);
    write_file_atomically(folder + "/target.txt", target_list);
}

TriangleMesh posed(const shapes::Body& body, TriangleMesh mesh) {
    for (int v = 0; v < mesh.vertex_count(); ++v)
        mesh.vertices.row(v) = body.posed(mesh.vertex(v)).transpose();
    return mesh;
}

/// `vertices`: 0 for some number by the seed.
void write_pair(unsigned seed, const std::string& folder, unsigned vertices) {
    const auto [kind, body] = shapes::selftest_shape(seed);
    shapes::Random random(seed + 1000);
    const auto mesh = [&] {
        const int by_seed = int(random.between(2000, 6000));
        return body.mesh(vertices > 0 ? int(vertices) : by_seed, random.rotation());
    };
    const TriangleMesh source = mesh(), other = mesh();
    const double scale = random.between(0.1, 10), angle = random.between(0, 3);
    const auto placed = [&](const TriangleMesh& rest) {
        return shapes::moved(posed(body, rest), scale, angle, {1, -2, 3});
    };
    const TriangleMesh target = shapes::shuffled(placed(other), seed);
    const std::vector<TruePair> pairs = true_pairs(placed(source).vertices, target);
    write_truth(folder, pairs);
    if (vertices > 0) write_landmarks(folder, pairs, source);
    write_file_atomically(folder + "/source.ply", to_ply(source));
    write_file_atomically(folder + "/target.ply", to_ply(target));
    fmt::print("{}\n", kind);
}

unsigned number_from(std::string_view text, const char* what) {
    unsigned number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end)
        throw UsageError(fmt::format("{} '{}': give a number, 0 or more", what, text));
    return number;
}

int report(ExitCode code, const std::string& message) {
    fmt::print(stderr, "selftest-shapes: error: {}\n", message);
    return int(code);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3 && argc != 4) {
        fmt::print(stderr, "usage: selftest-shapes SEED FOLDER [VERTICES]\n");
        return int(ExitCode::usage);
    }
    try {
        write_pair(number_from(argv[1], "SEED"), argv[2], argc == 4 ? number_from(argv[3], "VERTICES") : 0);
        return int(ExitCode::ok);
    } catch (const Error& error) {
        return report(error.code(), error.what());
    } catch (const std::exception& error) {
        return report(ExitCode::internal, std::string("internal: ") + error.what());
    }
}
