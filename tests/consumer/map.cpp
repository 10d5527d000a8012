#include <varimap/artifact/artifact.h>
#include <varimap/map_surfaces.h>
#include <varimap/mesh_files/mesh_file.h>
#include <varimap/results/map_table.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <tuple>

namespace {

using namespace varimap;

/// A subdivided octahedron on the unit sphere with n vertices along each edge's half; the order does not
/// depend on where they go.
TriangleMesh sphere(int n) {
    std::map<std::tuple<int, int, int>, int> index_of;
    std::vector<Vec3> vertices;
    std::vector<Eigen::RowVector3i> faces;
    const auto vertex = [&](int x, int y, int z) {
        const auto [place, is_new] = index_of.try_emplace({x, y, z}, int(vertices.size()));
        if (is_new) vertices.push_back(Vec3(x, y, z).normalized());
        return place->second;
    };
    const auto octant = [&](int sx, int sy, int sz) {
        const auto face = [&](int a, int b, int c) {
            faces.push_back(sx * sy * sz > 0 ? Eigen::RowVector3i(a, b, c) : Eigen::RowVector3i(a, c, b));
        };
        const auto at = [&](int i, int j) { return vertex(sx * i, sy * j, sz * (n - i - j)); };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                face(at(i, j), at(i + 1, j), at(i, j + 1));
                if (i + j + 1 < n) face(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
    };
    for (int sx : {1, -1})
        for (int sy : {1, -1})
            for (int sz : {1, -1}) octant(sx, sy, sz);
    TriangleMesh mesh{Points(vertices.size(), 3), Faces(faces.size(), 3)};
    for (int v = 0; v < mesh.vertex_count(); ++v) mesh.vertices.row(v) = vertices[v].transpose();
    for (int f = 0; f < mesh.face_count(); ++f) mesh.faces.row(f) = faces[f];
    return mesh;
}

/// Four limbs of different lengths at the corners of a tetrahedron.
const Vec3 limbs[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
const double lengths[] = {1.0, 0.8, 0.6, 0.4};

/// The body, turned about its long axis by `twist` radians per unit length.
TriangleMesh body(int n, double twist) {
    TriangleMesh mesh = sphere(n);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 direction = mesh.vertex(v);
        double radius = 1;
        for (int k = 0; k < 4; ++k)
            radius += lengths[k] * std::exp((direction.dot(limbs[k].normalized()) - 1) / .1);
        const Vec3 p = radius * direction.cwiseProduct(Vec3(.7, .6, 1.2));
        const double c = std::cos(twist * p.z()), s = std::sin(twist * p.z());
        mesh.vertices.row(v) << p.x() * c - p.y() * s, p.x() * s + p.y() * c, p.z();
    }
    return mesh;
}

/// A ball beside the body, which preprocessing joins to it.
TriangleMesh with_ball(const TriangleMesh& body) {
    const TriangleMesh ball = sphere(4);
    const Eigen::Index vertices = body.vertices.rows(), faces = body.faces.rows();
    TriangleMesh both{Points(vertices + ball.vertices.rows(), 3), Faces(faces + ball.faces.rows(), 3)};
    both.vertices << body.vertices, (.3 * ball.vertices).rowwise() + Eigen::RowVector3d(1.6, 0, 0);
    both.faces << body.faces, ball.faces.array() + int(vertices);
    return both;
}

int tip(const TriangleMesh& mesh, const Vec3& limb) {
    Eigen::Index v;
    (mesh.vertices * limb).maxCoeff(&v);
    return int(v);
}

}  // namespace

/// map FOLDER landmarks|explore|parts: maps two bodies in memory and writes them, their landmarks and the
/// map's tables; prints coverage, round trip and how many triangles are reversed.
int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const std::string folder = argv[1];
    const std::string how = argv[2];
    TriangleMesh A = body(9, 0), B = body(9, .5);
    if (how == "parts") A = with_ball(A), B = with_ball(B);
    MapOptions options;
    std::string lines;
    if (how != "explore")
        for (const Vec3& limb : limbs) {
            options.landmarks.emplace_back(InputVertex{tip(A, limb)}, InputVertex{tip(A, limb)});
            lines += std::to_string(tip(A, limb)) + " " + std::to_string(tip(A, limb)) + "\n";
        }
    const MappedSurfaces mapped = map_surfaces(A, B, options);
    write_file_atomically(folder + "/A.ply", to_ply(A));
    write_file_atomically(folder + "/B.ply", to_ply(B));
    write_file_atomically(folder + "/landmarks.txt", lines);
    write_file_atomically(folder + "/A_to_B.csv", to_csv(mapped.A_to_B));
    write_file_atomically(folder + "/B_to_A.csv", to_csv(mapped.B_to_A));
    std::printf("%.12g %.12g %d\n", mapped.A_to_B_quality.coverage, mapped.round_trip.mean,
                mapped.A_to_B_quality.distortion.flipped_count);
    if (how == "parts") return 0;  // the ball has no landmark, and may go elsewhere
    return mapped.A_to_B_quality.coverage > 0.9 && mapped.round_trip.mean < 0.05 ? 0 : 1;
}
