#include <algorithm>

#include "fixtures/map_shapes.h"
#include "fixtures/shapes.h"
#include "fuzz/scratch_file.h"
#include "fuzz/target.h"
#include "stages/domain/make_domain.h"
#include "stages/preprocess/preprocess.h"
#include "varimap/artifact/npy.h"
#include "varimap/core/error.h"
#include "varimap/geodesics/geodesic_graph.h"
#include "varimap/mesh/closest_point.h"
#include "varimap/results/candidates.h"
#include "varimap/results/diffusion.h"
#include "varimap/results/map_arrays.h"
#include "varimap/results/map_file.h"
#include "varimap/results/map_table.h"
#include "varimap/results/plan.h"
#include "varimap/results/quality_numbers.h"
#include "varimap/results/surface_map.h"
#include "varimap/spectral/eigenbasis.h"
#include "varimap/spectral/hierarchy.h"
#include "varimap/spectral/laplacian.h"
#include "varimap/surface/input_locator.h"
#include "varimap/surface/part_region.h"

namespace varimap::fuzz {
namespace {

const Surface& surface() {
    static const Surface made = [] {
        PreprocessParams params;
        params.target_edge_length = .6;
        return preprocess(shapes::ellipsoid(1, {1, 1.2, 1.5}), params);
    }();
    return made;
}

const Basis& basis() {
    static const Basis made = [] {
        EigenSolverOptions options;
        options.count = 12;
        return compute_eigenbasis(surface(), options);
    }();
    return made;
}

/// Whatever passed the check can be worked with.
void use(const Surface& read) {
    const ClosestPoint closest(read.input);
    const InputLocator locate(read);
    for (int f = 0; f < read.mesh.face_count(); ++f) {
        const Vec3 there = position(read.input, locate({f, Vec3(.2, .3, .5)}));
        if (!there.allFinite() || closest(there).point.face < 0) throw std::logic_error("a point is nowhere");
    }
    if (!cotangent_laplacian(read.mesh).coeffs().isFinite().all()) throw std::logic_error("a bad Laplacian");
}

void use(const Domain& read) {
    if (!laplacian(read).coeffs().isFinite().all()) throw std::logic_error("a bad Laplacian");
    if (GeodesicGraph(read).vertex_count() != read.mass.size()) throw std::logic_error("a bad graph");
}

void use(const Basis& read) {
    if (!diffusion_embedding(read, coarsest_time(read)).allFinite())
        throw std::logic_error("a bad embedding");
}

void use(const Hierarchy& read) {
    const auto vertices = std::ptrdiff_t(read.levels.front().cell.size());
    for (std::size_t l = 0; l < read.levels.size(); ++l) {
        const Level& level = read.levels[l];
        if (*std::max_element(level.samples.begin(), level.samples.end()) >= vertices)
            throw std::logic_error("a sample is no vertex");
        if (l > 0) parents(level, read.levels[l - 1]);
    }
}

void use_pair(const SolvedPair& read) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(Eigen::Index(read.plan.samples_A.size()));
    for (Eigen::Index row = 0; row < read.plan.entries.outerSize(); ++row)
        for (SparseMatrix::InnerIterator entry(read.plan.entries, row); entry; ++entry)
            sums[row] += entry.value() * read.plan.mass_B[entry.col()];
    if (!sums.allFinite() || read.trace.back().level < 0) throw std::logic_error("a bad plan");
}

void use(const Diffusion& read) {
    use_pair(read);
}

void use(const Plan& read) {
    use_pair(read);
}

void use(const Candidates& read) {
    if (read.list.size() != read.maps.size()) throw std::logic_error("bad candidates");
}

void use(const PartRegion& read) {
    if (read.faces.back() >= read.face_count) throw std::logic_error("a face is none of the whole's");
    if (read.face_count != surface().input.face_count()) return;
    const RepairedMesh cut = cropped({surface().input, {}, {}}, read);
    if (cut.link.face != read.faces) throw std::logic_error("other faces are cut out");
}

void use(const QualityNumbers& read) {
    if (read.json.empty()) throw std::logic_error("no numbers");
}

void use(const SurfaceMap& read) {
    to_csv(read.A_to_B);
}

template <class T>
Target artifact(const T& seed) {
    return {ArtifactType<T>::kind, {encode(seed)}, {}, [](const std::string& bytes) {
                T value;
                decode(bytes, value);
                use(value);
                if (encode(value).empty()) throw std::logic_error("nothing is written");
            }};
}

Domain domain() {
    const std::string text = "0 0\n1 0\n1 2\n0 2\n-3 2\n";
    const ScratchFile file(text, ".xyz");
    return make_domain(read_domain_file(file.path(), DomainKind::polyline), {}, file.path());
}

/// Rows of points, edges and matrices; each is read as each.
Target domain_file() {
    return {"domain_file",
            {"x,y\n0,0\n1,0\n1,2\n0,2\n", "0 1 2\n1 2 .5\n2 3 1e-3\n",
             "%%MatrixMarket matrix coordinate real symmetric\n4 4 3\n2 1 1\n3 2 1\n4 3 2\n",
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 2 0 0\nl 1 2 3 4\n"},
            {"%%MatrixMarket", "pattern", "general", "l ", "v ", "nan", "-1"},
            [](const std::string& bytes) {
                for (const char* ending : {".xyz", ".edges", ".mtx", ".obj"}) {
                    const ScratchFile file(bytes, ending);
                    try {
                        const Domain made = make_domain(read_domain_file(file.path(), DomainKind::automatic),
                                                        {}, file.path());
                        Domain back;
                        decode(encode(made), back);
                    } catch (const InputError&) {
                    }
                }
            }};
}

SolvedPair solved_pair() {
    SolvedPair pair;
    SamplePlan& plan = pair.plan;
    plan.samples_A = {3, 1, 7}, plan.samples_B = {2, 0};
    plan.mass_A = plan.transported_A = Eigen::Vector3d(.5, .25, .25);
    plan.mass_B = plan.transported_B = Eigen::Vector2d(.5, .5);
    plan.entries.resize(3, 2);
    plan.entries.insert(0, 0) = .5;
    plan.entries.insert(1, 1) = plan.entries.insert(2, 1) = .25;
    plan.entries.makeCompressed();
    pair.trace = {{0, 0, 0, 3, 2, 10, 3, .1, 1, 1e-9}, {1, 1, 0, 3, 2, 10, 3, .1, 1, 1e-9}};
    pair.record.landmarks = {{MeshVertex{3}, MeshVertex{2}}};
    pair.record.landmark_checks.resize(1);
    pair.record.landmark_points = {{{0, Vec3::UnitX()}, {1, Vec3::UnitY()}}};
    return pair;
}

Diffusion diffusion() {
    Diffusion made{solved_pair(), std::vector<int>(8, 1), std::vector<int>(9, 2)};
    return made;
}

Plan plan() {
    return {solved_pair(), Points::Constant(8, 3, .1), Points::Constant(9, 3, .2)};
}

Candidates candidates() {
    const SurfacePoint a{3, Vec3::UnitX()}, b{0, Vec3(.2, .3, .5)};
    Candidates made;
    made.list.resize(2);
    made.maps = {{{{a, b}, {b, a}}, {{b, b}}}, {{{b, a}}, {{a, a}, {a, b}}}};
    made.previews = {PointMap(5, {0, Vec3::UnitZ()})};
    return made;
}

PointMap point_map() {
    return {{0, Vec3::UnitX()}, {-1, Vec3::Zero()}, {2, Vec3(.2, .3, .5)}};
}

/// A whole file, of which the header is hostile too.
Target whole_file() {
    const ScratchFile file("", ".artifact");
    Header header;
    header.kind = ArtifactType<Basis>::kind;
    header.schema = ArtifactType<Basis>::schema;
    header.stage = ArtifactType<Basis>::stage;
    header.parameters = {{"count", "12"}};
    header.inputs = {{"surface", "surface", content_hash("")}};
    write_payload(file.path(), header, encode(basis()));
    return {"artifact_file",
            {read_file(file.path())},
            {"kind", "schema", "payload", "header", "input", "parameter"},
            [](const std::string& bytes) {
                const ScratchFile scratch(bytes, ".artifact");
                read_artifact<Basis>(scratch.path());
            }};
}

Target csv_map() {
    return {"csv_map", {to_csv(point_map())}, {"vertex,face,b0,b1,b2", ","}, [](const std::string& bytes) {
                const ScratchFile scratch(bytes, ".csv");
                read_csv_map(scratch.path());
            }};
}

/// Maps of other programs.
Target map_file() {
    static const TriangleMesh mesh = shapes::ellipsoid(0);
    const PointMap map = shapes::at_vertices(mesh);
    std::string list = "target\n";
    for (int v = 0; v < mesh.vertex_count(); ++v) list += std::to_string(v) + "\n";
    const std::string npy =
        to_npy("<i4", {mesh.vertex_count()}, std::vector<int>(std::size_t(mesh.vertex_count()), 3));
    return {"map_file",
            {to_csv(map), list, npy, to_npz(map, mesh), to_zip({{"p2p.npy", npy}})},
            {"face.npy", "p2p.npy", "nan", "-1", "12", "vertex,face,b0,b1,b2", "PK\x05\x06"},
            [](const std::string& bytes) {
                const ScratchFile scratch(bytes, ".map");
                for (const auto base : {IndexBase::zero, IndexBase::automatic})
                    read_map_file(scratch.path(), base, mesh, &mesh);
            }};
}

}  // namespace

std::vector<Target> artifact_targets() {
    return {artifact(surface()),
            artifact(domain()),
            domain_file(),
            artifact(basis()),
            artifact(build_hierarchy(surface(), basis(), {})),
            artifact(diffusion()),
            artifact(plan()),
            artifact(candidates()),
            artifact(PartRegion{surface().input.face_count(), {1, 2, 5, 8}, true, point_map(), .1}),
            artifact(SurfaceMap{point_map(), point_map(), {}}),
            artifact(QualityNumbers{
                R"({"energy": 0.5, "landmarks": [0, 1e-3], "levels": [{"kind": "diffusion"}]})"}),
            whole_file(),
            csv_map(),
            map_file()};
}

}  // namespace varimap::fuzz
