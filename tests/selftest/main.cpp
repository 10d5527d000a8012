// Writes a generated shape and a bent, scaled, turned, renumbered and differently tessellated copy of it:
//   selftest-shapes SEED FOLDER
// leaves FOLDER/source.ply, target.ply, and their true map as two lists of vertices, source.txt and
// target.txt; prints what kind of shape it is.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "selftest/body.h"
#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/mesh/io/mesh_file.h"

namespace {

using namespace varimap;

/// Source vertices and the target vertices at their true images; only the fifth of the source's vertices
/// whose images are nearest to a vertex, so that the target's tessellation hardly counts as an error.
void write_truth(const std::string& folder, const Points& images, const TriangleMesh& target) {
    struct Row {
        double distance;
        int source, target;
    };
    std::vector<Row> rows(static_cast<size_t>(images.rows()));
    for (int v = 0; v < int(rows.size()); ++v) {
        int nearest;
        const double squared =
            (target.vertices.rowwise() - images.row(v)).rowwise().squaredNorm().minCoeff(&nearest);
        rows[size_t(v)] = {squared, v, nearest};
    }
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.distance < b.distance; });
    rows.resize(rows.size() / 5);
    std::string source_list, target_list;
    for (const Row& row : rows) {
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

void write_pair(unsigned seed, const std::string& folder) {
    const auto [kind, body] = shapes::selftest_shape(seed);
    shapes::Random random(seed + 1000);
    const auto mesh = [&] {
        const int vertices = int(random.between(2000, 6000));
        return body.mesh(vertices, random.rotation());
    };
    const TriangleMesh source = mesh(), other = mesh();
    const double scale = random.between(0.1, 10), angle = random.between(0, 3);
    const auto placed = [&](const TriangleMesh& rest) {
        return shapes::moved(posed(body, rest), scale, angle, {1, -2, 3});
    };
    const TriangleMesh target = shapes::shuffled(placed(other), seed);
    write_truth(folder, placed(source).vertices, target);
    write_file_atomically(folder + "/source.ply", to_ply(source));
    write_file_atomically(folder + "/target.ply", to_ply(target));
    fmt::print("{}\n", kind);
}

unsigned seed_from(std::string_view text) {
    unsigned seed = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, seed);
    if (error != std::errc() || stop != end)
        throw UsageError(fmt::format("SEED '{}': give a number, 0 or more", text));
    return seed;
}

int report(ExitCode code, const std::string& message) {
    fmt::print(stderr, "selftest-shapes: error: {}\n", message);
    return int(code);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        fmt::print(stderr, "usage: selftest-shapes SEED FOLDER\n");
        return int(ExitCode::usage);
    }
    try {
        write_pair(seed_from(argv[1]), argv[2]);
        return int(ExitCode::ok);
    } catch (const Error& error) {
        return report(error.code(), error.what());
    } catch (const std::exception& error) {
        return report(ExitCode::internal, std::string("internal: ") + error.what());
    }
}
